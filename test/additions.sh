#!/bin/bash
# Adds a family of methods and two functions of the language as HOUSE.md describes, to one copy of the sources, which has to give the same bits on every
# machine. The family is a text in step/, its two lines in step/families.def and its rows in core/methods.c; it adapts its steps
# (test/family/doubling.h). cube(x) is a formula: a row in lang/base/operations.def and its recurrence in step/series.h. root4(x) has an evaluation in
# step/functions/ besides. Nothing else is touched.
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
touched() { for folder in step core machine lang api; do diff -rq $folder "$copy/$folder"; done | sed "s|Files .* and $copy/||; s|Only in $copy/||; s/ differ//; s|: |/|" | sort | tr '\n' ' '; }
cp test/family/doubling.h "$copy/step/doubling.h"
sed -i 's|^    X(TAYLOR, .*)$|& \\\n    X(DOUBLING, doubling, "", SWINGS)|; s|^#include "step/taylor.h"$|&\n#include "step/doubling.h"|' "$copy/step/families.def"
card() { echo "    { .card = { CARD(\"$1\", \"\", \"test\", 2, 1, 6, XVT, 0, 0, 0.0), .title = \"$1\", .cite = \"\", .formula = \"\", .use = \"\"$2 },\\"; }
row="$(card doubling ', .adaptive = 1')
      .family = DOUBLING, .adaptive = true },\\
$(card doubling-fixed '')
      .family = DOUBLING },"
sed -i "/CARD(\"exact\"/i $row" "$copy/core/methods.c"
check "a family touches a text, the list and the rows" "$(touched)" "core/methods.c step/doubling.h step/families.def "

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
last() { grep -n "$1" "$2" | tail -n 1 | cut -d: -f1; }
sed -i "$(($(last '^#undef OF$' "$copy/lang/base/operations.def") - 1))r $copy/row" "$copy/lang/base/operations.def"
sed -i "$(($(last '^/\* Exponentials and angles' "$copy/step/series.h") - 1))r $copy/recurrence" "$copy/step/series.h"
sed -i "$(($(last '^INLINE reals NAME(hypot)' "$copy/step/functions/root.h") - 1))r $copy/evaluation" "$copy/step/functions/root.h"
check "a function touches its row, its series and its evaluation" "$(touched)" \
    "core/methods.c lang/base/operations.def step/doubling.h step/families.def step/functions/root.h step/series.h "
(cd "$copy" && cmake --preset release -DMOTUS_QUICK=ON -DMOTUS_HDF5=OFF >/dev/null && cmake --build build --target motus_program) >"$copy/log" 2>&1
built=$?
check "they build without a warning" "$built" 0
[ $built = 0 ] || { grep -E -A3 '(error|warning): ' "$copy/log" | head -n 20; echo "$passed passed, $failed failed"; exit 1; }
motus=$copy/build/motus
value() { sed -n "s/.*\"$1\": \([^,}]*\).*/\1/p"; }
state() { sed -n 's/.*\("state": {[^}]*}\).*/\1/p'; }

# --- the family ---
model=models/kepler.motus

slow=$("$motus" run $model --method doubling --until 3 --machine interpreter --json 2>&1)
fast=$("$motus" run $model --method doubling --until 3 --machine compiled --json 2>&1)
check "interpreter and compiled machine: the same bits" "$(state <<<"$fast")" "$(state <<<"$slow")"
holds "a run ends exactly at its end" "$(value time <<<"$slow") == 3"
steps=$(value steps <<<"$slow") work=$(value evaluations <<<"$slow")
holds "six evaluations a candidate, one for the first step, and some candidates were refused" "$work > 6 * $steps && $work % 6 == 1"
# The error of a step is below the tolerance; on a stable orbit errors add up and grow in proportion to time.
first() { sed -n 's/.*"r": \[\([^,]*\),.*/\1/p' | head -n 1; }
near=$("$motus" run $model --method kahan-li8 --step 0.001 --until 3 --json | first) here=$(first <<<"$slow")
holds "as far off as the errors of its steps allow: $here beside $near" "($here - $near) ^ 2 < (3 * $steps * 1e-9) ^ 2 * 100 && $here != $near"

# A restart state has the time, its rounding error and the next step size.
"$motus" run $model --method doubling --until 1.7 --save-state "$copy/state" >"$copy/log" 2>&1
for machine in interpreter compiled; do
    "$motus" run $model --method doubling --until 3 --machine $machine --restart "$copy/state" --json | state >"$copy/$machine"
done
check "a saved run goes on, on both machines alike" "$(cat "$copy/compiled")" "$(cat "$copy/interpreter")"
holds "and gets there" "$(grep -c state "$copy/compiled") == 1"
check "rows at times between steps whose sizes nobody knows beforehand" \
    "$("$motus" run $model --method doubling --until 1.7 --every 0.1 -o "$copy/rows.csv" >/dev/null 2>&1; grep -c '^[0-9]' "$copy/rows.csv")" 18

# In lanes: every trajectory has its own steps, refusals, observations and end.
sweep() { "$motus" sweep $model --method doubling --vary e=0:0.9:23 "$@" 2>&1; }
rows() { sweep --quiet "$@" | grep -E '^[0-9]' | awk '{ print } END { print NR }'; }
what=(--until 3 --record 'r.x,max(r.y),mean(t),time_of_min(r.x)')
alone=$(rows "${what[@]}" --machine interpreter)
check "23 trajectories one at a time" "$(tail -n 1 <<<"$alone")" 23
for lanes in 1 4 16; do
    check "in $lanes lanes: the same bits" "$(rows "${what[@]}" --machine compiled --lanes $lanes --threads 2)" "$alone"
done
what=(--vary until=-1:5:7 --every '3 steps' --record 'r.x,max(r.y)')
check "with ends that differ, observed at every third step" "$(rows "${what[@]}" --machine compiled --lanes 8)" \
    "$(rows "${what[@]}" --machine interpreter)"
check "of all" "$(rows "${what[@]}" --machine compiled --lanes 8 | tail -n 1)" 161
# A fall into the centre: no step is small enough, at a time that depends on where it begins.
printf "k = 1\nx'' = -k/x^2\nx(0) = 1\nx'(0) = 0\n" >"$copy/fall.motus"
fall() { "$motus" sweep "$copy/fall.motus" --method doubling --vary k=0.1:9:40 --until 3 --record 'x,min(x)' --quiet "$@" 2>/dev/null | grep '^[0-9]'; }
check "40 of them" "$(fall --machine interpreter | wc -l)" 40
check "trajectories that cannot go on stop when they would stop alone" "$(fall --machine compiled --lanes 8)" "$(fall --machine interpreter)"
holds "some of them do" "$(fall --machine compiled | grep -c ',[0-9.]*[1-9],[a-z]*$') > 20"
check "and it is lanes that computed them" \
    "$(sweep --until 3 --record r.x --machine compiled --lanes 16 --json -o "$copy/rows" | value lanes)" 16

# Its dense output is its own. A force by which every step of one size ends where it began: between the ends x is above 0.03 once, and only dense output
# tells so. Steps that adapt are watched in lanes, since the family says so: maxima that pass a level within one step are found.
cat >"$copy/bump.motus" <<'END'
K = 1
w = 2 pi
x'' = K (sin(w t) - (1 - cos(w t)) + (1 - cos(2 w t))/2)
x(0) = 0
x'(0) = 0
n = 0
when x > 0.03 as hit: n = n + 1
END
cat >"$copy/level.motus" <<'END'
level = 1
x'' = -x
x(0) = 0
x'(0) = 1
n = 0
when x > level as hit: n = n + 1
END
counts() { "$motus" sweep "$copy/$1.motus" --record n --error none "${@:2}" 2>&1; }
numbers() { counts "$@" --quiet | grep '^[0-9]'; }
bump=(bump --method doubling-fixed --step 1 --until 9.5 --vary K=0.9:1.1:16)
check "events of steps of one size: one in every step" "$(numbers "${bump[@]}" --machine interpreter | cut -d, -f3 | sort -u)" 10
check "in lanes, which the family does not claim to bound by the ends of steps" "$(numbers "${bump[@]}" --machine compiled --lanes 8)" \
    "$(numbers "${bump[@]}" --machine interpreter)"
level=(level --method doubling --tolerance 1e-2 --until 100 --vary level=0.9:0.999:64)
check "events of watched steps, in lanes" "$(numbers "${level[@]}" --machine compiled --lanes 8)" "$(numbers "${level[@]}" --machine interpreter)"
check "one at every maximum, also where both ends of the step are below the level" "$(numbers "${level[@]}" --machine interpreter | cut -d, -f3 | sort -u)" 16
check "and it is lanes that followed them" "$(counts "${level[@]}" --machine compiled --lanes 8 --json -o "$copy/levels" | value lanes)" 8

# --- the functions ---
model() { printf "x'' = -%s - 0.1 x'\nx(0) = 1\nx'(0) = 0\nlevel = 0.5\nn = 0\nwhen %s > level: n = n + 1\n" "$1" "$1"; }
model 'cube(x)' >"$copy/cube.motus"
model 'x x x' >"$copy/product.motus"
printf "x'' = 1 - root4(x) - 0.1 x'\nx(0) = 3\nx'(0) = 0\n" >"$copy/root4.motus"
sed 's/root4(x)/sqrt(sqrt(x))/' "$copy/root4.motus" >"$copy/roots.motus"
run_function() { "$motus" run "$copy/$1.motus" --until 20 "${@:2}" --json 2>&1; }
for method in dop853 taylor 'gauss4 --step 0.01' 'leapfrog --step 0.01'; do
    while read -r model other; do
        slow=$(run_function "$model" --machine interpreter --method $method | state) fast=$(run_function "$model" --machine compiled --method $method | state)
        check "$model, ${method%% *}: the same bits on both machines" "$fast" "$slow"
        here=$(value x <<<"$slow") there=$(run_function "$other" --machine interpreter --method $method | state | value x)
        holds "$model, ${method%% *}: $here beside $there of $other" "length(\"$here\") > 5 && ($here - $there) ^ 2 < 1e-20"
    done <<<"cube product
root4 roots"
done
# Where cube is -1 there is a pulse that no step would meet: bounds of cube show that it is there.
pulse() { printf "u = 10 (t - 5)\nx'' = exp(-10000 (%s + 1)^2)\nx(0) = 0\nx'(0) = 0\n" "$1"; }
pulse 'cube(u)' >"$copy/cubed.motus"
pulse 'u^3' >"$copy/power.motus"
here=$(run_function cubed --method dop853 | state | value x) there=$(run_function power --method dop853 | state | value x)
holds "a narrow pulse of it, $here beside $there" "$here > 1e-6 && ($here / $there - 1) ^ 2 < 1e-12"
printf "x'' = -cub(x)\nx(0) = 1\nx'(0) = 0\n" >"$copy/near.motus"
check "a word that is nearly its name: cube is meant" "$("$motus" check "$copy/near.motus" 2>&1 | grep -c 'did you mean cube')" 1
printf "x'' = -cube(x, 2)\nx(0) = 1\nx'(0) = 0\n" >"$copy/many.motus"
check "it takes one operand" "$("$motus" check "$copy/many.motus" >/dev/null 2>&1; echo $?)" "$("$motus" check <(sed 's/cube/sin/' "$copy/many.motus") >/dev/null 2>&1; echo $?)"
levels() { "$motus" sweep "$copy/$1.motus" --method dop853 --vary level=-0.9:0.9:16 --record n --error none --until 20 --quiet "${@:2}" 2>&1 | grep '^[0-9]'; }
along() { "$motus" sweep "$copy/$1.motus" --method dop853 --vary x=2:3:16 --record x --error none --until 5 --quiet "${@:2}" 2>&1 | grep '^[0-9]'; }
check "root4 in lanes as one by one" "$(along root4 --machine compiled --lanes 8)" "$(along root4 --machine interpreter)"
lanes=$(levels cube --machine compiled --lanes 8)
check "events of it, in lanes as one by one" "$lanes" "$(levels cube --machine interpreter)"
check "as many as of x x x" "$lanes" "$(levels product --machine interpreter)"
holds "some happen" "$(awk -F, '{ n += $3 } END { print n + 0 }' <<<"$lanes") > 4"
echo "$passed passed, $failed failed"
[ $failed = 0 ]
