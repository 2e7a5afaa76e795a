#!/bin/bash
# The Python module: builds it as `make python` does, and runs python/test with Debian's Python, or the one in PATH that has cffi.
set -u
cd "$(dirname "$0")/.." || exit 1
build=${BUILD:-build}
if ! cmake --preset release -DMOTUS_PYTHON=ON >"$build/python.log" 2>&1 || ! cmake --build "$build" --target motus_python >>"$build/python.log" 2>&1; then
    echo "not ok - the module is built"
    tail -n 20 "$build/python.log"
    exit 1
fi
echo "ok - the module is built"
python=$(sed -n 's/^MOTUS_PYTHON_FOUND:INTERNAL=//p' "$build/CMakeCache.txt")
export PYTHONPATH=$PWD/$build/python PYTHONDONTWRITEBYTECODE=1 MOTUS=${MOTUS:-$PWD/build/motus}
exec "$python" python/test/run.py
