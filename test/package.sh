#!/bin/bash
# The installed package: moved after installation, found by pkg-config and by find_package, shared and static, from C and from C++,
# without the source tree.
set -u
cd "$(dirname "$0")/.." || exit 1
source=$PWD
build=${BUILD:-build}
passed=0 failed=0
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
# name, command ...: the case passes if the command does
try() {
    local name=$1
    shift
    if "$@" >"$place/log" 2>&1; then passed=$((passed + 1)); echo "ok - $name"
    else failed=$((failed + 1)); echo "not ok - $name"; sed 's/^/    /' "$place/log" | tail -n 25
    fi
}

# A blank in the prefix, and a move after the installation: neither the .pc file nor the CMake files may hold a path.
cmake --install "$build" --prefix "$place/first" >"$place/log" 2>&1 || cat "$place/log"
mkdir "$place/a place" && mv "$place/first" "$place/a place/prefix"
prefix="$place/a place/prefix"
lib=$(dirname "$(find "$prefix" -name 'libmotus.a')")
export PKG_CONFIG_PATH="$lib/pkgconfig" LD_LIBRARY_PATH=
version=$(sed -n 's/^#define MOTUS_VERSION "\(.*\)"/\1/p' include/motus.h)

# The same text is C17 and C++17. It checks the version, and a quarter turn of an oscillator from text and from a callback.
cat >"$place/use.c" <<'C'
#include <motus.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static int pull(void *context, double t, const double *x, const double *v, double *a)
{
    (void)context; (void)t; (void)v;
    a[0] = -x[0];
    return 0;
}

static int quarter(motus_system *system, const char *what)
{
    motus_error error = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *run = NULL;
    double x = 7, v = 7;
    def.method = "kahan-li8";
    def.step = 0.05;
    def.until = 1.5707963267948966;
    if (motus_run_create(system, &def, &run, &error) || motus_run_finish(run, &error) || motus_run_state(run, &x, &v, &error)) {
        printf("%s: %s\n", what, error.message);
        return 1;
    }
    motus_run_destroy(run);
    printf("%s: x = %.3g, v = %.17g\n", what, x, v);
    return !(fabs(x) < 1e-12 && fabs(v + 1) < 1e-12);
}

int main(void)
{
    motus_error error = motus_default_error();
    motus_text_def text = motus_default_text();
    motus_callback_def call = motus_default_callback();
    motus_system *system = NULL;
    double x = 1, v = 0;
    int bad = 0;
    if (strcmp(motus_version(), MOTUS_VERSION) || strcmp(MOTUS_VERSION, EXPECTED)) { printf("version\n"); bad = 1; }
    text.text = "x'' = -x\nx(0) = 1\nx'(0) = 0\n";
    if (motus_system_from_text(&text, &system, &error)) { printf("%s\n", error.message); return 1; }
    bad |= quarter(system, "text");
    motus_system_destroy(system);
    call.positions = 1;
    call.x = &x;
    call.v = &v;
    call.acceleration = pull;
    call.depends_on_velocity = call.depends_on_time = 0;
    if (motus_system_from_callback(&call, &system, &error)) { printf("%s\n", error.message); return 1; }
    bad |= quarter(system, "callback");
    motus_system_destroy(system);
    return bad;
}
C
cp "$place/use.c" "$place/use.cc"
warnings=(-Wall -Wextra -Wpedantic -Werror "-DEXPECTED=\"$version\"")

# compiler, standard, file, how: by pkg-config. $(...) is split by eval, since pkg-config quotes what has blanks.
by_pkg_config() {
    local out="$place/pc-$4-${3##*.}" flags
    if [ "$4" = static ]; then
        flags="$(pkg-config --cflags motus) $(pkg-config --static --libs motus | sed 's/-lmotus/-l:libmotus.a/')"
    else
        flags="$(pkg-config --cflags --libs motus)"
    fi || return 1
    eval "\"$1\" -std=$2 \"\${warnings[@]}\" \"$3\" $flags -lm -o \"$out\"" || return 1
    if [ "$4" = static ]; then ! readelf -d "$out" | grep -q libmotus || return 1
    else readelf -d "$out" | grep -q 'libmotus\.so\.' || return 1; fi
    LD_LIBRARY_PATH=$lib "$out"
}
# A folder of libraries outside of the prefix.
elsewhere() {
    cmake -S . -B "$place/apart" "-DCMAKE_INSTALL_PREFIX=$place/there" -DCMAKE_INSTALL_LIBDIR=/opt/other/lib64 >/dev/null || return 1
    local words
    words=$(PKG_CONFIG_PATH="$place/apart" pkg-config --variable=libdir motus) && [ "$words" = /opt/other/lib64 ]
}
try "pkg-config, a folder of libraries outside of the prefix" elsewhere
try "pkg-config knows the version" test "$(pkg-config --modversion motus)" = "$version"
try "pkg-config, C, shared"   by_pkg_config cc c17 "$place/use.c" shared
try "pkg-config, C, static"   by_pkg_config cc c17 "$place/use.c" static
try "pkg-config, C++, shared" by_pkg_config c++ c++17 "$place/use.cc" shared
try "pkg-config, C++, static" by_pkg_config c++ c++17 "$place/use.cc" static

mkdir "$place/project"
cat >"$place/project/CMakeLists.txt" <<'C'
cmake_minimum_required(VERSION 3.22)
project(use LANGUAGES C CXX)
find_package(motus ${EXPECTED} REQUIRED)
add_compile_options(-Wall -Wextra -Wpedantic -Werror)
add_compile_definitions(EXPECTED="${EXPECTED}")
foreach(kind shared static motus)
  foreach(language c cc)
    add_executable(${kind}-${language} ../use.${language})
    target_link_libraries(${kind}-${language} motus::${kind} m)
  endforeach()
endforeach()
C
configure() { cmake -S "$place/project" -B "$place/project/build" "-DCMAKE_PREFIX_PATH=$prefix" "-DEXPECTED=$1"; }
try "find_package finds it" configure "$version"
try "find_package, built" cmake --build "$place/project/build"
for program in shared-c shared-cc static-c static-cc motus-c motus-cc; do
    try "find_package, $program runs" "$place/project/build/$program"
done
rm -rf "$place/project/build"
refuse() { ! configure "$1"; }
try "find_package refuses another minor version" refuse "0.$(( $(cut -d. -f2 <<<"$version") + 1 ))"

try "the program is installed and runs" "$prefix/bin/motus" run "$prefix/share/motus/models/spring.motus" --quiet
if [ -f "$build/lab/motus-lab.html" ]; then
    try "the page of the lab is installed, and the program finds it" cmp "$build/lab/motus-lab.html" <(env -u MOTUS_LAB_PAGE "$prefix/bin/motus" lab -o -)
fi
try "the program needs no libmotus beside it" sh -c '! readelf -d "$1" | grep -q libmotus' - "$prefix/bin/motus"
try "the manual page is installed" test -s "$prefix/share/man/man1/motus.1"
try "completions are installed" test -s "$prefix/share/bash-completion/completions/motus" \
    -a -s "$prefix/share/zsh/site-functions/_motus" -a -s "$prefix/share/fish/vendor_completions.d/motus.fish"
try "no file of the package names the place it was built in" sh -c '! grep -rIlF "$1" "$2"' - "$source" "$prefix"
staged() { DESTDIR="$place/stage" cmake --install "$build" && test -f "$place/stage/$(sed -n 's/^CMAKE_INSTALL_PREFIX:PATH=//p' "$build/CMakeCache.txt")/include/motus.h"; }
try "DESTDIR stages an installation" staged

echo "$passed passed, $failed failed"
[ $failed = 0 ]
