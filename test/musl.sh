#!/bin/bash
# The C library musl: library, program and tests build with it, the bits are those of golden.txt, and the program answers as that of this machine's own C
# library. Of the C tests it runs those that ask much of a C library: numbers as text, files, threads, compiled models.
set -u
cd "$(dirname "$0")/.." || exit 1
export LC_ALL=C SHARE=${SHARE:-50}
here=${MOTUS:-$PWD/build/motus} there=build/musl/motus passed=0 failed=0
ok() { passed=$((passed + 1)); echo "ok - $1"; }
not_ok() { failed=$((failed + 1)); echo "not ok - $1"; shift; [ $# -gt 0 ] && printf '    %s\n' "$@"; }
place=$(mktemp -d) || exit 1
trap 'rm -rf "$place"' EXIT
tests="golden machines api run language events restart decimal near parallel threads platform beside ensemble_block solver tape callback"

if cmake --preset musl >"$place/log" 2>&1 && cmake --build build/musl --target motus_program $(printf '%s_test ' $tests) >>"$place/log" 2>&1; then
    ok "it builds without a warning"
else
    not_ok "it builds without a warning" "$(grep -E -A3 '(error|warning): ' "$place/log" | head -n 20)"
    echo "$passed passed, $failed failed"
    exit 1
fi
for name in $tests; do
    build/musl/test/${name}_test >"$place/log" 2>&1
    status=$?
    passed=$((passed + $(grep -ac '^ok ' "$place/log")))
    [ $status = 0 ] || not_ok "$name" "$(grep -aE -B1 '^not ok' "$place/log" | head -n 6)" "exit status $status"
done
# Times and the machine's name differ.
answer() { "$@" --json 2>/dev/null | jq -c 'del(.seconds, .machine, .note)'; }
for model in kepler bouncing-ball chain double-pendulum; do
    for machine in interpreter compiled; do
        of_here=$(answer "$here" run models/$model.motus --machine $machine) of_there=$(answer "$there" run models/$model.motus --machine $machine)
        if [ -n "$of_here" ] && [ "$of_here" = "$of_there" ]; then ok "$model, $machine"; else not_ok "$model, $machine" "${of_here:0:400}" "${of_there:0:400}"; fi
    done
done
echo "$passed passed, $failed failed"
[ $failed = 0 ]
