#!/bin/bash
# Adds a family of methods as HOUSE.md describes: a text in step/, its two lines in step/families.def, a row in core/methods.c, and nothing else. The
# family adapts its steps (test/family/doubling.h). A copy of the sources with it is built, and has to give the same bits on every machine.
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
cp test/family/doubling.h "$copy/step/doubling.h"
sed -i 's|^    X(TAYLOR, .*)$|& \\\n    X(DOUBLING, doubling, "", SWINGS)|; s|^#include "step/taylor.h"$|&\n#include "step/doubling.h"|' "$copy/step/families.def"
card() { echo "    { .card = { CARD(\"$1\", \"\", \"test\", 2, 1, 6, XVT, 0, 0, 0.0), .title = \"$1\", .cite = \"\", .formula = \"\", .use = \"\"$2 },\\"; }
row="$(card doubling ', .adaptive = 1')
      .family = DOUBLING, .adaptive = true },\\
$(card doubling-fixed '')
      .family = DOUBLING },"
sed -i "/CARD(\"exact\"/i $row" "$copy/core/methods.c"
check "a family touches a text, the list and the rows" \
    "$(for folder in step core machine lang api; do diff -rq $folder "$copy/$folder"; done | sed "s|$copy/||g" | tr '\n' ';')" \
    "Only in step: doubling.h;Files step/families.def and step/families.def differ;Files core/methods.c and core/methods.c differ;"

(cd "$copy" && cmake --preset release >/dev/null && cmake --build build --target motus_program) >"$copy/log" 2>&1
check "it builds without a warning" "$?" 0
motus=$copy/build/motus model=models/kepler.motus
value() { sed -n "s/.*\"$1\": \([^,}]*\).*/\1/p"; }

slow=$("$motus" run $model --method doubling --until 3 --machine interpreter --json 2>&1)
fast=$("$motus" run $model --method doubling --until 3 --machine compiled --json 2>&1)
state() { sed -n 's/.*\("state": {[^}]*}\).*/\1/p'; }
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
echo "$passed passed, $failed failed"
[ $failed = 0 ]
