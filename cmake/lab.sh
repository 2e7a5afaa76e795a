#!/bin/sh
# Builds the page in build/lab: the core as WebAssembly, the npm packages of lab/package-lock.json, the page, unless it is newer than all that it is made of.
# `lab.sh core` leaves the page out.
set -eu
cd "$(dirname "$0")/.."
mkdir -p build/lab/core
log=build/lab/build.log
stop() { cat "$log" >&2; exit 1; }

cmake -S lab/core -B build/lab/core -DCMAKE_TOOLCHAIN_FILE=wasm.cmake >"$log" 2>&1 || stop
MAKEFLAGS='' cmake --build build/lab/core -j "${JOBS:-2}" >"$log" 2>&1 || stop

if [ ! -f lab/node_modules/.package-lock.json ] || [ lab/package-lock.json -nt lab/node_modules/.package-lock.json ]; then
    (cd lab && npm ci --ignore-scripts --no-audit --no-fund) >"$log" 2>&1 || stop
    touch lab/node_modules/.package-lock.json
fi
cp -p build/lab/core/motus.wasm build/lab/
[ "${1-}" != core ] || exit 0
page=build/lab/motus-lab.html
[ ! -e $page ] || [ -n "$(find lab models include build/lab/core/motus.wasm -name node_modules -prune -o -type f -newer $page -print | head -n 1)" ] || exit 0
(cd lab && npx --no-install tsc --noEmit) >"$log" 2>&1 || stop
node lab/build.mjs --out build/lab --core build/lab/core/motus.wasm
