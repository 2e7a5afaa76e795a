#!/bin/bash
# Adds two functions of the language as HOUSE.md describes. cube(x) is a formula: a row in lang/base/operations.def and its recurrence in
# step/series.h. root4(x) has an evaluation in step/functions/ besides. A copy of the sources with both is built: they are words, have slopes, bounds and
# Taylor series, and the same bits on every machine.
set -u
cd "$(dirname "$0")/.." || exit 1
export LC_ALL=C
passed=0 failed=0
check() { if [ "$2" = "$3" ]; then passed=$((passed + 1)); echo "ok - $1"; else failed=$((failed + 1)); printf 'not ok - %s\n    %s\n    %s\n' "$1" "$2" "$3"; fi; }
holds() { check "$1" "$(awk "BEGIN { print ($2) ? \"true\" : \"false: $2\" }")" true; }
copy=$(mktemp -d) || exit 1
trap 'rm -rf "$copy"' EXIT
export XDG_CACHE_HOME=$copy/cache

git ls-files -z --cached --others --exclude-standard | tar --null -T - -cf - 2>/dev/null | tar -xf - -C "$copy"
cat >"$copy/row" <<'END'
UNARY(CUBE, "cube", CURVED, RISES | IS_WORD, a * a * a, MUL(MUL(CONST(3), MUL(A, A)), DA),
       2, "aa1a", series_cube(r, length, a, n, in))
FUNC1(ROOT4, root4, "root", CURVED, STEEP_AT_0 | HAS_DOMAIN | IS_WORD, DIV(DA, MUL(CONST(4), MUL(R, MUL(R, R)))),
       2, "ra1a", series_root4(r, length, a, n, in))

END
cat >"$copy/evaluation" <<'END'
INLINE reals NAME(root4)(reals x) { return SQRT(SQRT(x)); }

END
cat >"$copy/recurrence" <<'END'
/* The square is a helper. */
SERIES_FUNCTION real series_cube(real *r, const int length, const series a, const int n, const real *in)
{
    real *const square = SERIES_HELPER(1);
    square[n] = n ? series_product(a, a, n, SERIES_GIVEN(0)) : a.at[0] * a.at[0];
    return n ? series_product(SERIES_FROM(square), a, n, SERIES_GIVEN(1)) : a.at[0] * a.at[0] * a.at[0];
}

END
cat >>"$copy/recurrence" <<'END'
SERIES_FUNCTION real series_root4(real *r, const int length, const series a, const int n, const real *in)
{
    const real start = n == 0 ? SERIES_OF(root4)(a.at[0]) : SERIES_NUMBER(0.0);
    return series_power(r, length, a, SERIES_NUMBER(0.25), start, n, in);
}

END
line() { grep -n "$1" "$2" | tail -n 1 | cut -d: -f1; }
sed -i "$(($(line '^#undef OF$' "$copy/lang/base/operations.def") - 1))r $copy/row" "$copy/lang/base/operations.def"
sed -i "$(($(line '^/\* Exponentials and angles' "$copy/step/series.h") - 1))r $copy/recurrence" "$copy/step/series.h"
sed -i "$(($(line '^INLINE reals NAME(hypot)' "$copy/step/functions/root.h") - 1))r $copy/evaluation" "$copy/step/functions/root.h"
check "a function touches its row, its series and its evaluation" \
    "$(for folder in step core machine lang api; do diff -rq $folder "$copy/$folder"; done | sed "s|Files .* and $copy/||; s/ differ//" | tr '\n' ' ')" \
    "step/functions/root.h step/series.h lang/base/operations.def "
(cd "$copy" && cmake --preset release >/dev/null && cmake --build build --target motus_program) >"$copy/log" 2>&1
check "it builds without a warning" "$?" 0
motus=$copy/build/motus

model() { printf "x'' = -%s - 0.1 x'\nx(0) = 1\nx'(0) = 0\nlevel = 0.5\nn = 0\nwhen %s > level: n = n + 1\n" "$1" "$1"; }
model 'cube(x)' >"$copy/cube.motus"
model 'x x x' >"$copy/product.motus"
printf "x'' = 1 - root4(x) - 0.1 x'\nx(0) = 3\nx'(0) = 0\n" >"$copy/root4.motus"
sed 's/root4(x)/sqrt(sqrt(x))/' "$copy/root4.motus" >"$copy/roots.motus"
run() { "$motus" run "$copy/$1.motus" --until 20 "${@:2}" --json 2>&1; }
state() { sed -n 's/.*\("state": {[^}]*}\).*/\1/p'; }
value() { sed -n "s/.*\"$1\": \([^,}]*\).*/\1/p"; }
for method in dop853 taylor 'gauss4 --step 0.01' 'leapfrog --step 0.01'; do
    while read -r model other; do
        slow=$(run "$model" --machine interpreter --method $method | state) fast=$(run "$model" --machine compiled --method $method | state)
        check "$model, ${method%% *}: the same bits on both machines" "$fast" "$slow"
        here=$(value x <<<"$slow") there=$(run "$other" --machine interpreter --method $method | state | value x)
        holds "$model, ${method%% *}: $here beside $there of $other" "length(\"$here\") > 5 && ($here - $there) ^ 2 < 1e-20"
    done <<<"cube product
root4 roots"
done
# Where cube is -1 there is a pulse that no step would meet: bounds of cube show that it is there.
pulse() { printf "u = 10 (t - 5)\nx'' = exp(-10000 (%s + 1)^2)\nx(0) = 0\nx'(0) = 0\n" "$1"; }
pulse 'cube(u)' >"$copy/cubed.motus"
pulse 'u^3' >"$copy/power.motus"
here=$(run cubed --method dop853 | state | value x) there=$(run power --method dop853 | state | value x)
holds "a narrow pulse of it, $here beside $there" "$here > 1e-6 && ($here / $there - 1) ^ 2 < 1e-12"
printf "x'' = -cub(x)\nx(0) = 1\nx'(0) = 0\n" >"$copy/near.motus"
check "a word that is nearly its name: cube is meant" "$("$motus" check "$copy/near.motus" 2>&1 | grep -c 'did you mean cube')" 1
printf "x'' = -cube(x, 2)\nx(0) = 1\nx'(0) = 0\n" >"$copy/many.motus"
check "it takes one operand" "$("$motus" check "$copy/many.motus" >/dev/null 2>&1; echo $?)" "$("$motus" check <(sed 's/cube/sin/' "$copy/many.motus") >/dev/null 2>&1; echo $?)"
sweep() { "$motus" sweep "$copy/$1.motus" --method dop853 --vary level=-0.9:0.9:16 --record n --error none --until 20 --quiet "${@:2}" 2>&1 | grep '^[0-9]'; }
along() { "$motus" sweep "$copy/$1.motus" --method dop853 --vary x=2:3:16 --record x --error none --until 5 --quiet "${@:2}" 2>&1 | grep '^[0-9]'; }
check "root4 in lanes as one by one" "$(along root4 --machine compiled --lanes 8)" "$(along root4 --machine interpreter)"
lanes=$(sweep cube --machine compiled --lanes 8)
check "events of it, in lanes as one by one" "$lanes" "$(sweep cube --machine interpreter)"
check "as many as of x x x" "$lanes" "$(sweep product --machine interpreter)"
holds "some happen" "$(awk -F, '{ n += $3 } END { print n + 0 }' <<<"$lanes") > 4"
echo "$passed passed, $failed failed"
[ $failed = 0 ]
