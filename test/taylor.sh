#!/bin/bash
# Adaptive methods in ensembles, Taylor series and Gauss-Radau: every trajectory has its own steps, refusals and end, and lanes of any width give the bits that one
# trajectory has by itself.
set -u
cd "$(dirname "$0")/.." || exit 1
export LC_ALL=C
motus=${MOTUS:-build/motus}
passed=0 failed=0
check() { if [ "$2" = "$3" ]; then passed=$((passed + 1)); echo "ok - $1"; else failed=$((failed + 1)); printf 'not ok - %s\n    %s\n    %s\n' "$1" "$2" "$3"; fi; }
scratch=$(mktemp -d) || exit 1
trap 'rm -rf "$scratch"' EXIT
export XDG_CACHE_HOME=$scratch/cache

turn=0 method=taylor tolerance=(--tolerance 1e-15)
rows() { "$motus" sweep "$@" --method "$method" "${tolerance[@]}" --quiet 2>/dev/null | grep -E '^[0-9]' | awk '{ print } END { print NR }'; }
lanes_of() { rm -f "$scratch/rows"; "$motus" sweep "$@" --method "$method" "${tolerance[@]}" --json -o "$scratch/rows" 2>&1 | sed -n 's/.*"lanes": \([^,}]*\).*/\1/p'; }

# name, model, how many rows, what is swept and recorded
agree() {
    local name=$1 model=$2 count=$3
    shift 3
    alone=$(rows "$model" "$@" --machine interpreter)
    check "$name: trajectories one at a time" "$(tail -n 1 <<<"$alone")" "$count"
    # A text is compiled for each width, so a case has two of the four.
    turn=$((turn + 1))
    local widths=(1 8)
    [ $((turn % 2)) = 1 ] || widths=(2 16)
    for lanes in "${widths[@]}"; do
        check "$name: $lanes lanes, the same bits" "$(rows "$model" "$@" --machine compiled --lanes $lanes --threads 2)" "$alone"
    done
    check "$name: and it is lanes that computed them" "$(lanes_of "$model" "$@" --machine compiled --lanes $lanes)" $lanes
}

# Steps end at switches, so trajectories are computed one at a time; where they lead across, lanes compute them.
kinks() {
    agree "$@" --switches step
    local name=$1 model=$2 across=$alone
    shift 3
    alone=$(rows "$model" "$@" --machine interpreter --threads 1)
    for how in "interpreter --threads 2" "compiled --threads 1" "compiled --threads 2"; do
        check "$name, located: the same bits, $how" "$(rows "$model" "$@" --machine $how)" "$alone"
    done
    check "$name, located: not those of steps that lead across" "$([ "$alone" != "$across" ] && echo other)" other
}

agree "the eccentricity varies" models/kepler.motus 23 --vary e=0:0.9:23 --until 3 --record 'r.x,max(r.y),mean(t),time_of_min(r.x)'
tolerance=(--tolerance 1e-6)
agree "a tolerance that needs fewer orders" models/kepler.motus 23 --vary e=0:0.9:23 --until 3 --record 'r.x'
tolerance=(--tolerance 1e-15)
agree "and the end" models/kepler.motus 35 --vary e=0:0.9:5 --vary until=-1:5:7 --every '3 steps' --record 'r.x,max(r.y)'
printf "k = 1\nc = 0.1\nx'' = -k sin(x) - c x' |x'| + max(x, 0) + cos(2 t/3)\ns' = x^2 - s\nx(0) = 0\nx'(0) = 0\ns(0) = 0\n" >"$scratch/driven.motus"
kinks "kinks, a start at rest, time and a first-order variable" "$scratch/driven.motus" 20 --vary k=0.5:2:20 --until 9 --record "x,s,min(x')"
printf "w = 1\nx[i]'' = sum(j = 1..20, j != i: sin(x[j] - x[i])/20) - x[i] for i = 1..20\nx[0] = sin(w t)\nx[i](0) = i/9 for i = 1..20\nx[i]'(0) = 0 for i = 1..20\n" >"$scratch/family.motus"
agree "a family, sums of 20 terms with a condition" "$scratch/family.motus" 9 --vary w=0.5:2:9 --until 3 --record 'x[3],x[20]'
printf "w = 1\nx[i]'' = x[i-1] - 2 x[i] + x[i+1] for i = 1..5\nx[0] = sin(w t)\nx[6] = 0\nx[i](0) = 0 for i = 1..5\nx[i]'(0) = 0 for i = 1..5\n" >"$scratch/border.motus"
agree "a driven boundary" "$scratch/border.motus" 9 --vary w=0.5:2:9 --until 3 --record 'x[3],x[5]'
# A fall into the centre: no step is small enough, at a time that depends on where it begins.
printf "k = 1\nx'' = -k/x^2\nx(0) = 1\nx'(0) = 0\n" >"$scratch/fall.motus"
agree "a fall into the centre" "$scratch/fall.motus" 40 --vary k=0.1:9:40 --until 3 --record 'x,min(x)'
check "some fell" "$(rows "$scratch/fall.motus" --vary k=0.1:9:40 --until 3 --record 'x,min(x)' --machine compiled | grep -c ',[0-9.]*[1-9],[a-z]*$' | awk '{ print ($1 > 20) ? "true" : $1 }')" true

method=radau15 tolerance=(--tolerance 1e-12)
agree "radau15: the eccentricity varies" models/kepler.motus 23 --vary e=0:0.9:23 --until 3 --record 'r.x,max(r.y),mean(t),time_of_min(r.x)'
tolerance=(--tolerance 1e-9)
agree "radau15: neighbours that take more turns" models/kepler.motus 11 --vary e=0:0.9:11 --until 6 --record 'r.x,steps,rejected'
agree "radau15: and their companions" models/kepler.motus 11 --vary e=0:0.9:11 --until 6 --record 'r.x,steps' --errors
tolerance=(--tolerance 1e-12)
agree "radau15: and the end" models/kepler.motus 35 --vary e=0:0.9:5 --vary until=-1:5:7 --every '3 steps' --record 'r.x,max(r.y)'
kinks "radau15: kinks, a start at rest, time and a first-order variable" "$scratch/driven.motus" 20 --vary k=0.5:2:20 --until 9 --record "x,s,min(x')"
agree "radau15: a driven boundary" "$scratch/border.motus" 9 --vary w=0.5:2:9 --until 3 --record 'x[3],x[5]'
agree "radau15: a fall into the centre" "$scratch/fall.motus" 40 --vary k=0.1:9:40 --until 3 --record 'x,min(x)'
# A narrow bump that the steps of a trajectory miss, and its companion's meet: there the equation of a step is solved by shorter ones.
# The motions at the ends of what varies and in its middle come near none, so that lanes compute all of them.
printf "c = 0.5\nx'' = -x - 1e11 (x - c) exp(-((x - c)/1e-3)^2)\nx(0) = 1\nx'(0) = 0\n" >"$scratch/bump.motus"
tolerance=(--tolerance 1e-3)
bumps=$(seq -s, -0.9 0.12 0.9) meets=("$scratch/bump.motus" --vary "c=-2,$bumps,3,$bumps,2" --until 3 --record x,steps --errors)
agree "radau15: companions that meet a bump" "${meets[0]}" 35 "${meets[@]:1}"
check "every trajectory has an error" "$(rows "${meets[@]}" | grep -c nan)" 0

method=gragg tolerance=(--tolerance 1e-9)
agree "gragg: lanes that end at different lines" models/kepler.motus 23 --vary e=0:0.9:23 --until 6 --record 'r.x,max(r.y),steps,rejected'
agree "gragg: and their companions" models/kepler.motus 11 --vary e=0:0.9:11 --until 6 --record 'r.x,steps' --errors
agree "gragg: and the end" models/kepler.motus 35 --vary e=0:0.9:5 --vary until=-1:5:7 --every '3 steps' --record 'r.x,max(r.y)'
kinks "gragg: kinks, a start at rest, time and a first-order variable" "$scratch/driven.motus" 20 --vary k=0.5:2:20 --until 9 --record "x,s,min(x')"
method=gragg-stormer
agree "gragg-stormer: lanes that end at different lines, and their companions" models/kepler.motus 23 --vary e=0:0.9:23 --until 6 --record 'r.x,steps,rejected' --errors
agree "gragg-stormer: a driven boundary" "$scratch/border.motus" 9 --vary w=0.5:2:9 --until 3 --record 'x[3],x[5]'
agree "gragg-stormer: a fall into the centre" "$scratch/fall.motus" 40 --vary k=0.1:9:40 --until 3 --record 'x,min(x)'
echo "$passed passed, $failed failed"
[ $failed = 0 ]
