#!/bin/bash
# Adds a function of the language as HOUSE.md describes: a row in lang/base/operations.def and its recurrence in step/series.h, and nothing else. A copy
# of the sources with cube(x) is built: it is a word, has slopes, bounds and a Taylor series, and the same bits on every machine.
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
line() { grep -n "$1" "$2" | tail -n 1 | cut -d: -f1; }
sed -i "$(($(line '^#undef OF$' "$copy/lang/base/operations.def") - 1))r $copy/row" "$copy/lang/base/operations.def"
sed -i "$(($(line '^/\* Exponentials and angles' "$copy/step/series.h") - 1))r $copy/recurrence" "$copy/step/series.h"
check "a function touches its row and its series" "$(for folder in step core machine lang api; do diff -rq $folder "$copy/$folder"; done | sed "s|$copy/||g" | tr '\n' ';')" \
    "Files step/series.h and step/series.h differ;Files lang/base/operations.def and lang/base/operations.def differ;"
(cd "$copy" && cmake --preset release >/dev/null && cmake --build build --target motus_program) >"$copy/log" 2>&1
check "it builds without a warning" "$?" 0
motus=$copy/build/motus

model() { printf "x'' = -%s - 0.1 x'\nx(0) = 1\nx'(0) = 0\nlevel = 0.5\nn = 0\nwhen %s > level: n = n + 1\n" "$1" "$1"; }
model 'cube(x)' >"$copy/cube.motus"
model 'x x x' >"$copy/product.motus"
run() { "$motus" run "$copy/$1.motus" --until 20 "${@:2}" --json 2>&1; }
state() { sed -n 's/.*\("state": {[^}]*}\).*/\1/p'; }
value() { sed -n "s/.*\"$1\": \([^,}]*\).*/\1/p"; }
for method in dop853 taylor 'gauss4 --step 0.01' 'leapfrog --step 0.01'; do
    slow=$(run cube --machine interpreter --method $method | state) fast=$(run cube --machine compiled --method $method | state)
    check "${method%% *}: the same bits on both machines" "$fast" "$slow"
    here=$(value x <<<"$slow") there=$(run product --machine interpreter --method $method | state | value x)
    holds "${method%% *}: the motion of x x x, $here beside $there" "length(\"$here\") > 5 && ($here - $there) ^ 2 < 1e-20"
done
printf "x'' = -cub(x)\nx(0) = 1\nx'(0) = 0\n" >"$copy/near.motus"
check "a word that is nearly its name: cube is meant" "$("$motus" check "$copy/near.motus" 2>&1 | grep -c 'did you mean cube')" 1
printf "x'' = -cube(x, 2)\nx(0) = 1\nx'(0) = 0\n" >"$copy/many.motus"
check "it takes one operand" "$("$motus" check "$copy/many.motus" >/dev/null 2>&1; echo $?)" "$("$motus" check <(sed 's/cube/sin/' "$copy/many.motus") >/dev/null 2>&1; echo $?)"
sweep() { "$motus" sweep "$copy/$1.motus" --method dop853 --vary level=0.1:0.9:16 --record n --error none --until 20 --quiet "${@:2}" 2>&1 | grep '^[0-9]'; }
lanes=$(sweep cube --machine compiled --lanes 8)
check "events of it, in lanes as one by one" "$lanes" "$(sweep cube --machine interpreter)"
check "as many as of x x x" "$lanes" "$(sweep product --machine interpreter)"
holds "some happen" "$(awk -F, '{ n += $3 } END { print n + 0 }' <<<"$lanes") > 4"
echo "$passed passed, $failed failed"
[ $failed = 0 ]
