#!/bin/bash
# Every model of models/ is read, runs, and behaves as its comments say; some are compared with reference values.
#
# The reference values were computed in more than 25 digits, by Taylor series of order 60 and, independently, by extrapolation. `shift` is
# how much a value moves when the literals of the model are rounded to doubles: the model's own sensitivity to one rounding. The
# margin of a case is computed: twice the truncation error, estimated by halving the step, and the sum of the roundings, which
# grows with the square root of the number of steps.
set -u
cd "$(dirname "$0")/.." || exit 1
motus=${MOTUS:-$PWD/build/motus}
root=$PWD
passed=0 failed=0
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
ok() { passed=$((passed + 1)); echo "ok - $1"; }
not_ok() { failed=$((failed + 1)); echo "not ok - $1"; shift; [ $# -gt 0 ] && printf '    %s\n' "$@"; }

# --- the models of the issue are all there, are read, and run with their own settings --------------------------------------------
for file in models/*.motus; do
    name=${file#models/}
    if "$motus" check "$file" --quiet >"$place/log" 2>&1; then ok "$name is read"; else not_ok "$name is read" "$(cat "$place/log")"; continue; fi
    if "$motus" run "$file" --json >"$place/run.json" 2>"$place/log" && jq -e . "$place/run.json" >"$place/log" 2>&1; then ok "$name runs"
    else not_ok "$name runs" "$(cat "$place/log" "$place/run.json")"; continue; fi
    # By a method of order 4, a correct invariant changes with the fourth power of the step, down to round-off; the change of a wrong
    # one does not depend on the step. Round-off is that of terms as large as the squares of the state.
    step=$(jq -r .step "$place/run.json")
    half=$(awk -v h="$step" 'BEGIN { printf "%.17g", h / 2 }')
    for h in "$step" "$half"; do
        "$motus" run "$file" --method gauss4 --step "$h" --json 2>/dev/null | jq -r '.steps as $n | ([.state[], (.invariants[] | .initial)] | flatten | map(fabs) | max | . * . + 1) as $size |
            .invariants | to_entries[] |
            [.key, $size, ([.value.max_drift] | flatten | max), $n] | @tsv'
    done >"$place/drifts"
    loose=$(awk '{ if (!($1 in first)) { first[$1] = $3; next }
        if (!($3 <= first[$1] / 8 || $3 <= 16 * sqrt($4) * 2.2e-16 * $2)) print $1 " drifts by " first[$1] " and by " $3 " at half the step" }' "$place/drifts")
    if [ -z "$loose" ] && [ "$(wc -l <"$place/drifts")" = $((2 * $(jq '.invariants | length' "$place/run.json"))) ]; then
        ok "$name keeps its invariants"
    else
        not_ok "$name keeps its invariants" "$loose"
    fi
done

# --- reference values -------------------------------------------------------------------------------------------------------------
# model, method, step, until, options, then lines of: path into the state, value, shift
value() { jq -r ".state$1" "$2"; }
reference() {
    local model=$1 method=$2 step=$3 until=$4 half path want shift
    shift 4
    half=$(awk -v h="$step" 'BEGIN { printf "%.17g", h / 2 }')
    if ! "$motus" run "models/$model.motus" --method "$method" --step "$step" --until "$until" "$@" --json >"$place/whole" 2>"$place/log" ||
        ! "$motus" run "models/$model.motus" --method "$method" --step "$half" --until "$until" "$@" --json >"$place/half" 2>"$place/log"; then
        not_ok "$model at $until" "$(cat "$place/log" "$place/whole")"
        return
    fi
    while read -r path want shift; do
        [ -n "$path" ] || continue
        local got coarse
        got=$(value "$path" "$place/half") coarse=$(value "$path" "$place/whole")
        local verdict
        verdict=$(awk -v got="$got" -v coarse="$coarse" -v want="$want" -v shift="$shift" -v n="$(jq -r .steps "$place/half")" 'BEGIN {
            if (got !~ /^-?[0-9]/) { print "no value"; exit }
            truncation = got - coarse; if (truncation < 0) truncation = -truncation
            size = want < 0 ? -want : want + 0; if (size < 1) size = 1
            margin = 2 * truncation + 4 * sqrt(n) * (shift + 1.1e-16 * size)
            error = got - want; if (error < 0) error = -error
            # The margin must be small enough to detect an error.
            if (margin > 1e-6 * size) { printf "the margin is only %.3g\n", margin; exit }
            if (error > margin) printf "%s is off by %.3g, more than %.3g\n", got, error, margin }')
        if [ -z "$verdict" ]; then ok "$model, $method: x$path at $until"
        else not_ok "$model, $method: x$path at $until" "$verdict"; fi
    done
}

reference driven-oscillator kahan-li8 0.1 100 <<'R'
.x        0.04778309565760846604243   3.6e-16
["x'"]   -0.1828561957230886593135    3.6e-16
R
reference damped-cubic gauss8 0.005 3 <<'R'
.x       -3.489418164528281725538     1e-16
["x'"]    5.481332827158467425440     1e-16
R
reference projectile-drag gauss8 0.05 4 <<'R'
.r[0]        71.19950096636553408419  3.4e-15
.r[1]        34.15358119821233069882  3.4e-15
["r'"][0]    12.08304460308637064419  3.4e-15
["r'"][1]   -12.13748519972333888675  3.4e-15
R
reference kepler kahan-li8 0.02 50 <<'R'
.r[0]        0.2205459568745545251826 6.2e-17
.r[1]       -0.4572644452615640347445 6.2e-17
["r'"][0]    1.125884581167679341599  6.2e-17
["r'"][1]    1.293032144434267600433  6.2e-17
R
reference kepler kahan-li8 0.02 65.97344572538566 <<'R'
.r[0]       -1.6                      1e-16
.r[1]        0                        1e-14
["r'"][1]   -0.5                      1e-16
R
# Closed forms: Kepler's equation, and the exact lines of the models at 24 digits.
reference comet kahan-li8 0.01 38 <<'R'
.r[0]       -1.141484611672995651224  4.7e-15
.r[1]        1.952208105928866472987  3.6e-15
["r'"][0]   -5.041243649175732710244  5.1e-15
["r'"][1]    2.699376480379948024918  6.3e-15
R
reference thrown-ball midpoint 0.2 2 <<'R'
.r[0]       12                        0
.r[1]        2.08                     8.9e-16
["r'"][1]   -9.62                     8.9e-16
R
reference resonance gauss8 0.1 60 <<'R'
.x          -0.1828863726613300233754 3.9e-18
["x'"]      -0.5744958944601159426725 1.2e-17
R
reference crossed-fields gauss8 1 150 <<'R'
.r[0]      136.513040025375056065     6.3e-15
.r[1]       -9.726108257878949847447  2.1e-14
["r'"][0]    0.2106473726122654570686 3.8e-15
["r'"][1]   -2.372113494256984389192  1.3e-15
R
reference thrown-ball-air gauss8 0.05 2 <<'R'
.r[0]       10.54541444579971108060   8.7e-17
.r[1]        1.093548248594809951716  8.9e-16
["r'"][0]    4.622781573370243411538  5.1e-17
["r'"][1]   -9.575401285809529597914  8.4e-16
R
reference ueda gauss8 0.01 50 <<'R'
.x           1.221946638567541957814  6.5e-17
["x'"]       5.565479787665348879708  1.7e-16
R
reference henon-heiles kahan-li8 0.1 100 <<'R'
.x        0.1132261910536318961748    1e-15
.y       -0.1529948828958447728533    1e-15
["x'"]    0.3731643270693806223622    1e-15
["y'"]    0.2745410891308792493579    1e-15
R
reference duffing gauss8 0.02 20 <<'R'
.x        0.9665753623614434423144    2.4e-14
["x'"]    0.05202975542839312499369   2.4e-14
R
reference duffing gauss8 0.02 50 --set a=0 --set d=0.05 --set F=7.5 --set omega=1 <<'R'
.x        2.034968672564077591346     3.3e-16
["x'"]    1.071675599986617887439     3.3e-16
R
reference van-der-pol gauss8 0.02 50 <<'R'
.x        1.376925153972392488522     1e-16
["x'"]   -0.2774307817925188244318    1e-16
R
reference double-pendulum gauss8 0.01 10 <<'R'
["θ1"]    0.9704843513669353033729    6.7e-15
["θ2"]   -6.675878447204944192122     6.7e-15
["θ1'"]   4.503407473111158969661     6.7e-15
["θ2'"]   1.586162479362916254237     6.7e-15
R
reference charged-particle gauss8 0.1 10 <<'R'
.r[0]        0.5304623676371398289303 1e-16
.r[1]       -2.681840812752350550172  1e-16
.r[2]        2.5                      1e-16
["r'"][0]    0.6363183744952988996563 1e-16
["r'"][1]   -1.060924735274279657861  1e-16
R
reference charged-particle exact 0.1 10 <<'R'
.r[0]        0.5304623676371398289303 1e-16
.r[1]       -2.681840812752350550172  1e-16
["r'"][1]   -1.060924735274279657861  1e-16
R
reference pendulum kahan-li8 0.2 100 <<'R'
.theta       1.982325653157030515983  1e-16
["theta'"]   0.1796407425909401978725 1e-16
R
reference damped-spring gauss8 0.1 50 --set F=1 <<'R'
.x        0.4773531622458217142355    5.1e-18
["x'"]    0.4573394954357195746286    5.1e-18
R
reference damped-spring exact 0.1 50 --set F=1 <<'R'
.x        0.4773531622458217142355    5.1e-18
["x'"]    0.4573394954357195746286    5.1e-18
R
reference arenstorf gauss8 0.0005 1 <<'R'
.x        0.3132845955561022429873    2.2e-14
.y        0.3480089746751416745726    2.2e-14
R
reference arenstorf gauss8 0.0005 10 <<'R'
.x       -0.8398071663389864715358 2.0e-14
.y        0.4468314170984720563724    2.0e-14
["x'"]    0.3737425356143938339511    2.0e-14
["y'"]   -0.1496696446668951772536    2.0e-14
R
reference outer-solar-system kahan-li8 50 200000 <<'R'
.r[0][0]      1.235842542354608727366   2.6e-13
.r[1][0]      2.611079570112863360081   2.6e-13
.r[1][1]     -5.079525496787986963777   2.6e-13
.r[1][2]     -2.244720677853057244531   2.6e-13
.r[2][0]     -7.669136247391309258823   2.6e-13
.r[4][1]     20.58295604245986474511    2.6e-13
.r[5][0]     36.56695069882260437984    2.6e-13
["r'"][1][0]  7.178878928375933095736e-3 2.6e-13
["r'"][5][2]  1.685048429944169340473e-4 2.6e-13
R

# --- the commands in the comments work -----------------------------------------------------------------------------------
mkdir "$place/try" && ln -s "$root/models" "$place/try/models"
motus() { "$motus" "$@"; }
while IFS= read -r line; do
    command=$(sed -E 's/^# (Try:)? *//; s/  +\(.*$//' <<<"$line")
    if (cd "$place/try" && rm -f ./*.svg && eval "$command" >"$place/log" 2>&1 </dev/null); then ok "$command"
    else not_ok "$command" "exit status $?" "$(tail -n 8 "$place/log")"; fi
done < <(grep -hE '^# (Try:)? +motus ' models/*.motus)

echo "$passed passed, $failed failed"
[ $failed = 0 ]
