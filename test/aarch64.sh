#!/bin/bash
# The same bits on aarch64: the program, cross-compiled, run by qemu, beside the program of this machine. Every model by several methods,
# interpreted and compiled; sweeps in lanes of NEON; the elementary functions over many arguments.
#
#   test/aarch64.sh         what `make test-all` runs
#   test/aarch64.sh all     `make test-aarch64`: besides, more methods, and every test program of the release build (cmocka and MPFR for aarch64)
set -u
cd "$(dirname "$0")/.." || exit 1
export LC_ALL=C
here=${MOTUS:-$PWD/build/motus} tools=$PWD/test/aarch64 passed=0 failed=0
ok() { passed=$((passed + 1)); echo "ok - $1"; }
not_ok() { failed=$((failed + 1)); echo "not ok - $1"; shift; [ $# -gt 0 ] && printf '    %s\n' "$@"; }
place=$(mktemp -d) || exit 1
trap 'rm -rf "$place"' EXIT
export XDG_CACHE_HOME=$place/cache
there() { PATH=$tools:$PATH CC=$tools/cc qemu-aarch64 -L /usr/aarch64-linux-gnu -E LD_LIBRARY_PATH=/usr/lib/aarch64-linux-gnu "$@"; }
arm() { there build/aarch64/motus "$@"; }

if [ "$(uname -m)" = aarch64 ]; then
    ok "this machine is an aarch64: all its tests are"
    echo "1 passed, 0 failed"
    exit 0
fi
targets=motus_program tests=OFF methods=gauss6
[ "${1-}" = all ] && targets=all tests=ON methods="rk4 gauss6 kahan-li8"
if cmake --preset aarch64 -DMOTUS_TESTS=$tests >"$place/log" 2>&1 && cmake --build build/aarch64 --target $targets -j "$(nproc)" >>"$place/log" 2>&1; then
    ok "it builds without a warning"
else
    not_ok "it builds without a warning" "$(grep -E -A3 '(error|warning): ' "$place/log" | head -n 20)"
    echo "$passed passed, $failed failed"
    exit 1
fi

# name, arguments of the program: the same output of both, which must not be empty
same() {
    local name=$1
    shift
    "$here" "$@" >"$place/x86" 2>"$place/x86.err"
    arm "$@" >"$place/arm" 2>"$place/arm.err"
    if [ -s "$place/x86" ] && cmp -s "$place/x86" "$place/arm"; then ok "$name"; else
        not_ok "$name" "$(diff "$place/x86" "$place/arm" | head -n 4)" "$(head -n 2 "$place/arm.err")"
    fi
}
# Times and the machine's name differ.
state() { jq -c 'del(.seconds, .machine, .note)'; }
same_run() {
    local name=$1
    shift
    "$here" run "$@" --json 2>/dev/null | state >"$place/x86"
    arm run "$@" --json 2>"$place/arm.err" | state >"$place/arm"
    if [ -s "$place/x86" ] && cmp -s "$place/x86" "$place/arm"; then ok "$name"; else
        not_ok "$name" "$(diff "$place/x86" "$place/arm" | cut -c1-200)" "$(head -n 2 "$place/arm.err")"
    fi
}

for model in models/*.motus; do
    name=$(basename "$model" .motus)
    same_run "$name, interpreted" "$model" --machine interpreter
    same_run "$name, compiled" "$model" --machine compiled
    for method in $methods; do
        same_run "$name by $method" "$model" --method $method --machine interpreter
    done
done

for lanes in 1 2 4 8; do
    for job in "pendulum theta(0)=0:3:37 max(theta)" "duffing x(0)=-1:1:21 final" "damped-cubic x(0)=1:9:19 final(x)" \
        "henon-heiles x(0)=0:0.3:23 max(y)"; do
        read -r model vary record <<<"$job"
        same "sweep of $model, lanes $lanes" sweep models/"$model".motus --vary "$vary" --record "$record" --lanes $lanes --machine compiled --threads 1
    done
done

# Every function of the language over many arguments, as quantities along x = t.
functions="sin cos tan atan sinh cosh tanh exp cbrt abs sign floor erf"
{
    printf "x'' = 0\nx(0) = -20\nx'(0) = 1\nuntil 40\nstep 0.01\nmethod symplectic-euler\n"
    for f in $functions; do printf "q_%s = %s(1.7 x + 0.013)\n" "$f" "$f"; done
    printf "q_asin = asin(x/20.5)\nq_acos = acos(x/20.5)\nq_log = log(20.5 + x)\nq_sqrt = sqrt(20.5 + x)\nq_pow = (20.5 + x)^1.37\n"
    printf "q_atan2 = atan2(x, 0.7 - x)\nq_hypot = hypot(x, 1.3)\nq_mod = mod(x, 0.77)\nq_min = min(x, -x, 3)\nq_max = max(x, 1)\nq_huge = sin(1e15 x)\n"
} >"$place/functions.motus"
same "the elementary functions at 4000 arguments" run "$place/functions.motus" --every "1 steps" -o -

if [ "${1-}" = all ]; then
    for program in $(find build/aarch64/test -maxdepth 1 -type f -perm -u+x | sort); do
        name=$(basename "$program")
        if CMOCKA_MESSAGE_OUTPUT=TAP there "$program" >"$place/log" 2>&1; then
            passed=$((passed + $(grep -acE '^ok |passed' "$place/log")))
            echo "ok - $name"
        else
            not_ok "$name" "$(grep -aE -A3 '^not ok|ERROR|FAIL' "$place/log" | head -n 6)"
        fi
    done
fi
echo "$passed passed, $failed failed"
[ $failed = 0 ]
