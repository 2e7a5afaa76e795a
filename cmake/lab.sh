#!/bin/sh
# Builds the page in build/lab: the core's module, the libraries that the page and its build use (as lab/package-lock.json has them), the page.
set -eu
cd "$(dirname "$0")/.."
mkdir -p build/lab/core
log=build/lab/build.log
say() { cat "$log" >&2; exit 1; }

cmake -S lab/core -B build/lab/core -DCMAKE_TOOLCHAIN_FILE=wasm.cmake >"$log" 2>&1 || say
MAKEFLAGS='' cmake --build build/lab/core -j "${JOBS:-2}" >"$log" 2>&1 || say

if [ ! -f lab/node_modules/.package-lock.json ] || [ lab/package-lock.json -nt lab/node_modules/.package-lock.json ]; then
    (cd lab && npm ci --ignore-scripts --no-audit --no-fund) >"$log" 2>&1 || say
    touch lab/node_modules/.package-lock.json
fi
(cd lab && npx --no-install tsc --noEmit) >"$log" 2>&1 || say
node lab/build.mjs --out build/lab --core build/lab/core/motus.wasm
