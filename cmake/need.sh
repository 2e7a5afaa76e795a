#!/bin/sh
# Checks that the packages which a target needs are installed. Missing ones are installed by apt-get if this user may do so (root, or
# sudo without a password); otherwise the script prints the command that installs them, and the exit status is 1.
#
#   cmake/need.sh [--check | --where-possible] build|demo|test|archives|cluster|cross|musl|aarch64|lab|page|python|bench|fuzz|format|tidy ...
#
# --check installs nothing. --where-possible installs what can be had here, names the rest in a line, and the exit status is 0.
set -eu
check_only=no possible=no
case "${1-}" in
--check) check_only=yes; shift ;;
--where-possible) possible=yes; shift ;;
esac

missing=
add() { case " $missing " in *" $1 "*) ;; *) missing="$missing $1" ;; esac; }
# command, package
tool() { command -v "$1" >/dev/null 2>&1 || [ -x "/usr/sbin/$1" ] || add "$2"; }
# header, package: the compiler searches its own include path
header() { command -v cc >/dev/null 2>&1 && echo "#include <$1>" | cc -E - >/dev/null 2>&1 || add "$2"; }
# module, package; Debian's Python may not be the first in PATH
module() { for python in python3 /usr/bin/python3; do "$python" -c "import $1" 2>/dev/null && return; done; add "$2"; }
fuzzer_runs() {
    echo '#include <stddef.h>
    int LLVMFuzzerTestOneInput(const unsigned char *p, size_t n); int LLVMFuzzerTestOneInput(const unsigned char *p, size_t n)
    { (void)p; (void)n; return 0; }' | clang -fsanitize=fuzzer,address,undefined -x c - -o /dev/null 2>/dev/null
}

# Links a program for WebAssembly, which needs clang, lld, a C library and the compiler's runtime for it.
wasm_links() {
    echo '#include <stdlib.h>
    long double take(const char *p) { return strtold(p, NULL); }' |
        clang --target=wasm32-wasi -nostartfiles -Wl,--no-entry,--export=take -x c - -o /dev/null 2>/dev/null
}

for what; do
    case $what in
    build) tool cmake cmake; tool make make; tool cc build-essential; header math.h build-essential ;;
    demo)  tool gnuplot gnuplot-nox ;;
    test)  header cmocka.h libcmocka-dev; header mpfr.h libmpfr-dev; tool python3 python3; tool jq jq ;;
    archives) pkg-config --exists hdf5-serial 2>/dev/null || add libhdf5-dev; tool pkg-config pkg-config; tool h5dump hdf5-tools
           module h5py python3-h5py; module netCDF4 python3-netcdf4; module xarray python3-xarray; tool g++ build-essential ;;
    cluster) tool mpicc.openmpi libopenmpi-dev; tool mpirun.openmpi openmpi-bin; tool mpicc.mpich libmpich-dev; tool mpirun.mpich mpich
           tool parallel parallel; tool snakemake snakemake
           tool slurmctld slurmctld; tool slurmd slurmd; tool sbatch slurm-client; tool munged munge ;;
    # a cross compiler with its C library, and what runs its programs
    cross) [ "$(uname -m)" = aarch64 ] || { tool aarch64-linux-gnu-gcc gcc-aarch64-linux-gnu
           [ -e /usr/aarch64-linux-gnu/include/stdio.h ] || add libc6-dev-arm64-cross; tool qemu-aarch64 qemu-user; } ;;
    musl)  tool musl-gcc musl-tools ;;
    # the libraries of the tests for aarch64, besides
    aarch64) for library in cmocka mpfr; do
             [ -e /usr/lib/aarch64-linux-gnu/lib$library.so ] || add lib$library-dev:arm64
           done ;;
    lab)   tool node nodejs; tool npm npm; tool wasm-opt binaryen; tool clang clang; tool wasm-ld lld; wasm_links || add wasi ;;
    python) module cffi python3-cffi; module numpy python3-numpy; [ -e /usr/include/python3*/Python.h ] || header Python.h python3-dev ;;
    page)  tool chromium chromium; tool firefox-esr firefox-esr ;;
    bench) tool g++ build-essential; header gsl/gsl_odeiv2.h libgsl-dev; header arkode/arkode_erkstep.h libsundials-dev
           header boost/version.hpp libboost-dev
           module numpy python3-numpy; module scipy python3-scipy; module numba python3-numba ;;
    fuzz)  tool clang clang; fuzzer_runs || add clang-runtime ;;
    format) tool clang-format clang-format ;;
    tidy)  tool run-clang-tidy clang-tidy ;;
    *)     echo "need.sh: unknown target $what" >&2; exit 2 ;;
    esac
done
[ -n "$missing" ] || exit 0

# What stays missing is no failure.
without() { echo "motus: not here, and not to be had: $*" >&2; exit 0; }

if ! command -v apt-get >/dev/null 2>&1; then
    # shellcheck disable=SC2086
    [ $possible = no ] || without $missing
    echo "motus needs these packages (Debian's names):$(echo "$missing" | sed 's/clang-runtime/libclang-rt-dev/; s/wasi/wasi-libc libclang-rt-dev-wasm32/'); install it, then run this again." >&2
    exit 1
fi
# The package with clang's sanitizer and fuzzer runtimes: clang itself on Ubuntu 22.04, else one of its own. Without package lists, apt
# knows neither.
runtime() {
    if apt-cache show libclang-rt-dev >/dev/null 2>&1; then echo libclang-rt-dev
    elif apt-cache show clang >/dev/null 2>&1 || grep -q '^VERSION_ID="22.04"' /etc/os-release 2>/dev/null; then echo clang
    else echo libclang-rt-dev; fi
}
packages() {
    for name in $missing; do
        case $name in
        clang-runtime) runtime ;;
        wasi) echo wasi-libc; echo libclang-rt-dev-wasm32 ;;
        *) echo "$name" ;;
        esac
    done | sort -u | tr '\n' ' ' | sed 's/ $//'
}

as=none
if [ "$(id -u)" = 0 ]; then as=
elif command -v sudo >/dev/null 2>&1 && sudo -n true 2>/dev/null; then as='sudo -n'
fi
if [ $possible = yes ] && [ "$as" = none ]; then without "$(packages)"; fi
if [ $check_only = yes ] || [ "$as" = none ]; then
    sudo=sudo; [ "$(id -u)" = 0 ] && sudo=
    echo "motus needs packages that are not installed. Run this, then the same command again:" >&2
    echo "    ${sudo:+$sudo }apt-get update && ${sudo:+$sudo }apt-get install -y $(packages)" >&2
    exit 1
fi
echo "motus: installing what is missing ($(packages))" >&2
log=$(mktemp)
trap 'rm -f "$log"' EXIT
case "$missing" in *:arm64*) $as dpkg --add-architecture arm64 ;; esac
install() { $as env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$@" >>"$log" 2>&1; }
# The package lists may be old or absent.
$as env DEBIAN_FRONTEND=noninteractive apt-get update >"$log" 2>&1 || [ $possible = yes ] || { cat "$log" >&2; exit 1; }
# shellcheck disable=SC2046
install $(packages) && exit 0
[ $possible = yes ] || { cat "$log" >&2; exit 1; }
# One that there is not keeps apt from all.
rest=
for package in $(packages); do install "$package" || rest="$rest $package"; done
# shellcheck disable=SC2086
[ -z "$rest" ] || without $rest
