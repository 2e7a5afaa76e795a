#!/bin/bash
# Why runs fail or crawl: a model with each cause, what is said of it, and that the command it names does what it says; and
# models that are near to a cause without having it, of which none may be said.
#
# Each case is one line `ok` or `not ok`; the last line counts them. MOTUS is the program (build/motus).
cd "$(dirname "$0")/.." || exit 1
. test/cli/cases.sh

# A model from its lines.
model() {
    local name=$1
    shift
    printf '%s\n' "$@" >"$place/$name.motus"
}

# NAME, CAUSE, then the arguments of the run: it ends with exit status 1 and one sentence, which JSON repeats. Each takes under half
# a second; the limit of a minute ends one that crawls, also on a machine that is busy.
ends_by() {
    local name=$1 cause=$2
    shift 2
    gives "$name" 1 timeout 60 "$motus" run "$@"
    command=$(sed -n 's/.*hint: [^-]*\(--.*\)$/\1/p' "$err" | sed 's/; or .*//; s/ with / /')
    gives "... in JSON" 1 "$motus" run "$@" --json
    that "... names its cause, $cause" eval "jq -se '.[-1].diagnosis.cause == \"$cause\"' '$out' >/dev/null"
}

# The diagnosis in JSON fulfils this.
diagnosed() { jq -se ".[-1].diagnosis | $1" "$out" >/dev/null; }

# The command of the hint, in place of the options that follow the model.
obeyed() {
    local name=$1
    shift
    gives "$name" 0 eval "'$motus' run $* $command"
}

# --- singular -------------------------------------------------------------------------------------------------------------------
model weierstrass "x'' = 6*x^2" "x(0) = 1" "x'(0) = 2"
model cubic "x'' = 2*x^3" "x(0) = 1" "x'(0) = 1"
model falls "x'' = -1/x^2" "x(0) = 1" "x'(0) = 0"
model blows "s' = s^2" "s(0) = 1"
model logarithm "x'' = -1/x" "x(0) = 1" "x'(0) = 0"
model of-time "x'' = 1/(1-t)" "x(0) = 0" "x'(0) = 0"
model driven "x'' = 6*x^2 + cos(t)/10" "x(0) = 1" "x'(0) = 2"

for how in "" "--method dop853" "--method taylor" "--method dopri5" "--method rk4 --step 0.01" "--method verlet --step 0.01"; do
    ends_by "a pole of order 2${how:+, $how}" singular "$place/weierstrass.motus" --until 3 $how
    that "... at 1, with the power -2" diagnosed '(.singular - 1 | fabs) <= .singular_error and .singular_error < 1e-7 and (.exponent + 2 | fabs) <= .exponent_error and .exponent_error < 1e-3 and .variable == "x"'
    obeyed "... and a run that ends before succeeds" "'$place/weierstrass.motus'" "$how"
done
ends_by "a pole of order 1" singular "$place/cubic.motus" --until 3 --method dop853
that "... with the power -1" diagnosed '(.exponent + 1 | fabs) <= .exponent_error and (.singular - 1 | fabs) <= .singular_error'
ends_by "a body that falls into the centre" singular "$place/falls.motus" --until 3 --method dop853
that "... after pi/sqrt(8), with the power 2/3" diagnosed '(.singular - 1.1107207345395915 | fabs) <= .singular_error and (.exponent - 2/3 | fabs) <= .exponent_error and .exponent_error < 1e-3'
ends_by "... by steps that pass it" singular "$place/falls.motus" --until 3 --method rk4 --step 0.01
that "... with the same power" diagnosed '(.exponent - 2/3 | fabs) <= .exponent_error and (.singular - 1.1107207345395915 | fabs) <= .singular_error'
ends_by "a first-order variable" singular "$place/blows.motus" --until 3 --method dop853
that "... with the power -1" diagnosed '(.exponent + 1 | fabs) <= .exponent_error and .variable == "s"'
ends_by "a logarithm beside the power" singular "$place/logarithm.motus" --until 3 --method dop853
that "... widens its error" diagnosed '(.exponent - 1 | fabs) <= .exponent_error and .exponent_error > 0.005 and (.singular - 1.2533141373155003 | fabs) <= .singular_error'
model exponential "x'' = exp(x)" "x(0) = 1" "x'(0) = 1"
ends_by "a logarithm" singular "$place/exponential.motus" --until 9 --method dop853
that "... is told as one" grep -qF 'grows as the logarithm of the time left' "$out"
ends_by "a pole of the time" singular "$place/of-time.motus" --until 5 --method dop853
that "... at 1" diagnosed '(.singular - 1 | fabs) <= .singular_error'
ends_by "a pole of a driven motion" singular "$place/driven.motus" --until 3 --method dop853
that "... with the power -2" diagnosed '(.exponent + 2 | fabs) <= .exponent_error'

# An encounter, after which the motion goes on, is none, however near: its own time is shorter than the rounding of t.
model encounter "x'' = -x/r^3" "y'' = -y/r^3" "r = sqrt(x^2+y^2)" "x(0) = 1" "y(0) = 0" "x'(0) = 0" "y'(0) = 1e-7"
gives "an encounter at 5e-15" 1 "$motus" run "$place/encounter.motus" --until 3 --method dop853 --json
that "... is no singularity" eval "! diagnosed '.cause == \"singular\"'"
model near "x'' = -x/r^3" "y'' = -y/r^3" "r = sqrt(x^2+y^2)" "x(0) = 1" "y(0) = 0" "x'(0) = 0" "y'(0) = 1e-3"
gives "an encounter at 5e-7" 0 "$motus" run "$place/near.motus" --until 3 --method dop853
gives "... that ends amidst it" 1 "$motus" run "$place/near.motus" --until 3 --method dop853 --most-steps 60 --json
that "... is no singularity either" eval "! diagnosed '.cause == \"singular\"'"

# --- stiff ----------------------------------------------------------------------------------------------------------------------
model relaxes "x'' = -1e10*(x' - cos(t))" "x(0) = 1" "x'(0) = 1"
model pol "x'' = 1000*(1 - x^2)*x' - x" "x(0) = 2" "x'(0) = 0"
ends_by "a stiff model by an explicit method" stiff "$place/relaxes.motus" --until 1000 --method dopri5
that "... of which x' decays" diagnosed ".variable == \"x'\""
obeyed "... and the implicit one succeeds" "'$place/relaxes.motus'" --until 1000
ends_by "... by one that iterates" stiff "$place/relaxes.motus" --until 1000 --method radau15
that "... whose steps do not converge" eval "jq -r .error.message '$out' | grep -q 'steps of radau15 do not converge much above 1e-10'"
obeyed "... and the implicit one succeeds" "'$place/relaxes.motus'" --until 1000
ends_by "steps of one size that are too long for it" stiff "$place/pol.motus" --until 20 --method rk4 --step 0.01
obeyed "... and the implicit ones succeed" "'$place/pol.motus'" --until 20
ends_by "a stiff model with too few steps" stiff "$place/pol.motus" --until 100 --method dopri5 --most-steps 1000
model oscillates "x'' = -1e4*x" "x(0) = 1" "x'(0) = 0"
ends_by "an oscillation that steps do not resolve" infinite "$place/oscillates.motus" --until 500 --method verlet --step 0.03
that "... is not stiff: the motion goes on" eval "jq -r .error.message '$out' | grep -q 'the motion itself goes on'"
obeyed "... with a smaller step" "'$place/oscillates.motus'" --until 500 --method verlet
# Errors carry the run over the hill of the potential, beyond which x becomes infinite; the motion itself has no singularity.
model hill "x'' = -x + x^3 + 0.1*cos(t)" "x(0) = 0" "x'(0) = 0"
for how in "explicit-euler --step 0.03" "explicit-euler --step 0.02" "heun --step 0.6"; do
    ends_by "steps that carry the run over a hill, $how" infinite "$place/hill.motus" --until 100 --method $how
    that "... the motion itself goes on" eval "jq -r .error.message '$out' | grep -q 'the motion itself goes on'"
    that "... what to take was tried" diagnosed '.verified == true'
    obeyed "... and leads to the end" "'$place/hill.motus'" --until 100 --method "${how%% *}"
done
model transient "x'' = -1e6*(x' - cos(t))" "x(0) = 1" "x'(0) = 0"
gives "a fast transient that ends" 0 "$motus" run "$place/transient.motus" --until 1e-4 --method dopri5
model fast "x'' = -x + sin(1e8*t)" "x(0) = 1" "x'(0) = 0"
gives "a fast driving" 1 "$motus" run "$place/fast.motus" --until 1e6 --method dopri5 --most-steps 1000 --json
that "... has no cause" eval "jq -e '.diagnosis == null' '$out' >/dev/null"

# --- discontinuous --------------------------------------------------------------------------------------------------------------
model rubs "x'' = -x - 0.5*sign(x')" "x(0) = 3" "x'(0) = 0"
model switched "x'' = if(t > 5, 1, 0)" "x(0) = 0" "x'(0) = 0"
ends_by "dry friction that sticks" discontinuous "$place/rubs.motus" --until 30 --method dop853 --switches step
obeyed "... and a run that ends before succeeds" "'$place/rubs.motus'" --method dop853
gives "a force that is switched on" 0 "$motus" run "$place/switched.motus" --until 10 --method dop853 --switches step --json
that "... is passed in steps as short as the rounding of the time allows, with its error" holds '(.state.x - 12.5 | fabs) <= .error.x and .error.x < 1e-12'
ends_by "dry friction that holds, by equal steps of a method that solves" discontinuous "$place/rubs.motus" --until 30 --method verlet --step 0.05
obeyed "... and steps that end there succeed" "'$place/rubs.motus' --until 30 --step 0.05" --method verlet
model steep "x'' = -x - 0.5*tanh(x'/1e-9)" "x(0) = 3" "x'(0) = 0"
gives "a steep force" 1 "$motus" run "$place/steep.motus" --until 30 --method dopri5 --most-steps 2000 --json
that "... does not jump" eval "! diagnosed '.cause == \"discontinuous\"'"

# --- events, Newton, rounding, the finite numbers ---------------------------------------------------------------------------------
model pushes "y'' = -9.81" "y(0) = 1" "y'(0) = 0" "when y = 0 falling as bounce: y' = -y', record" "when y' > 0 as back: y' = -y'"
ends_by "actions that answer one another without end" events "$place/pushes.motus" --until 3
that "... bounce" diagnosed '.variable == "bounce" and (.time - 0.4515236409857309 | fabs) < 1e-9'
model solves "x'' = -x^3" "x(0) = 10" "x'(0) = 0"
ends_by "an equation that Newton's method does not solve" newton "$place/solves.motus" --until 30 --method gauss4 --step 2
obeyed "... and smaller steps are solved" "'$place/solves.motus'" --until 30 --method gauss4
# Half the step is solved up to t = 16 alone.
model late "x'' = -exp(4.984*x) + 2.506" "x(0) = -2.748" "x'(0) = -1.528"
ends_by "a step that is solved for a while" newton "$place/late.motus" --until 47 --method gauss4 --step 1.1
obeyed "... and the one that is named, to the end" "'$place/late.motus'" --until 47 --method gauss4
# The motion is singular long after the step has failed.
ends_by "a step that is not solved, before a singularity" singular "$place/cubic.motus" --until 3 --method gauss4 --step 0.9
obeyed "... by smaller steps, to an end before it" "'$place/cubic.motus'" --method gauss4
model noise "x'' = -x" "e' = x'*((x+0.3)-0.3-x)" "x(0) = 1" "x'(0) = 0" "e(0) = 0"
ends_by "a variable that is rounding" rounding "$place/noise.motus" --until 30 --method dopri5
that "... e" diagnosed '.variable == "e" and .verified'
obeyed "... and an absolute tolerance suffices" "'$place/noise.motus'" --until 30 --method dopri5
ends_by "... by auto" rounding "$place/noise.motus" --until 30
model grows "x'' = x" "x(0) = 1" "x'(0) = 1"
for how in "" "--method dop853" "--method rk4 --step 0.1"; do
    ends_by "a number beyond the largest${how:+, $how}" infinite "$place/grows.motus" --until 800 $how
    obeyed "... and a run that ends before succeeds" "'$place/grows.motus'" "$how"
done
model root "x'' = sqrt(1-t)" "x(0) = 0" "x'(0) = 0"
ends_by "a force that ends" infinite "$place/root.motus" --until 5 --method dop853
obeyed "... and a run that ends before succeeds" "'$place/root.motus'" --method dop853

# A bump drives the motion ever faster, and steps become too short: beyond its edge the force is 0, and nothing is singular.
model bump "c = 4.13; w = 1.9e-4; z = (x - c)/w" "x'' = 9.93e9*max(0, 1 - z^2)^2*x' - x^3" "x(0) = 0" "x'(0) = 75"
for how in "--tolerance 1e-12" "--tolerance 1e-9 --error none"; do
    gives "a bump that is smooth at its edge, $how" 1 "$motus" run "$place/bump.motus" --until 3 --method dop853 $how
    that "... is no singularity, and no jump" eval '! says "is singular" "$err" && ! says "discontinuous" "$err"'
done

# The term that has no value at the start, and what can be written in its place, which succeeds.
for case in "sin(x)/x|x|1|sin(x)/x is 0/0 there, since x is 0" "x'^2/x'|x'|0|x'^2/x' is 0/0 there, since x' is 0" "x/sin(x)|sin(x)|1|x/sin(x) is 0/0 there, since sin(x) is 0"; do
    IFS='|' read -r term divisor value sentence <<<"$case"
    for how in "" "--method rk4 --step 0.01" "--method taylor"; do
        model undefined "x'' = 2 - $term" "x(0) = 0" "x'(0) = 0"
        gives "$term at the start${how:+, $how}" 1 "$motus" run "$place/undefined.motus" --until 1 $how
        that "... is named" says "$sentence" "$err"
        instead=$(sed -n 's/.*hint: write the value that it has there, `\(.*\)`.*/\1/p' "$err")
        that "... with its value there" eval '[[ $instead == "if($divisor == 0, $value, "* ]]'
        model undefined "x'' = 2 - $instead" "x(0) = 0" "x'(0) = 0"
        gives "... which succeeds" 0 "$motus" run "$place/undefined.motus" --until 1 $how
    done
done
# TERM, what is said of it, and the value that the hint names, if any: y(0) = 0, z(0) = 2 and u(0) = 1e9 do not rest.
while IFS='|' read -r term sentence divisor value; do
    model undefined "x'' = 2 - $term" "y'' = 1; z'' = 1; u'' = 1" "x(0) = 0; y(0) = 0; z(0) = 2; u(0) = 1e9" \
        "x'(0) = 0; y'(0) = 1; z'(0) = 1; u'(0) = 1"
    gives "$term at the start" 1 "$motus" run "$place/undefined.motus" --until 1
    that "... $sentence" says " $sentence" "$err"
    if [ -z "$divisor" ]; then
        that "... and has no value to be named" eval '! says "that it has there" "$err"'
    else
        that "... and goes to $value" says "that it has there, \`if($divisor == 0, $value, " "$err"
    fi
done <<'CASES'
1e-5 sin(x)/x|is 0/0 there, since x is 0|x|1e-05
1/3 sin(x/3)/x|is 0/0 there|x|0.1111111111111111
(1 - cos(x))/x^2|is 0/0 there|x^2|0.5
sin(1000 x)/x|is 0/0 there|x|1000
sin(u - 1e9)/(u - 1e9)|is 0/0 there|u - 1000000000|1
sin(t)/t|is 0/0 there, since t is 0|t|1
sin(hypot(x, y))/hypot(x, y)|is 0/0 there|hypot(x, y)|1
x y/(x^2 + y^2)|is 0/0 there
x^2 y/(x^4 + y^2)|is 0/0 there
(4 y^2 - x^2)/(2 y - x)|is 0/0 there
z sin(x)/x|is 0/0 there
sin(x + 1e-9)/x|is a division by 0 there, since x is 0
if(x == 0, 1, sin(x)/x) + 1/y|1/y is a division by 0 there, since y is 0
if(x != 0, sin(x)/x, 1) + 1/y|1/y is a division by 0 there, since y is 0
exp(1000 + x)|exp(1000 + x) is infinite there
log(x)|log(x) is infinite there
sqrt(x - 1)|sqrt(x - 1) is not a number there
CASES
model undefined "x'' = 1/x" "x(0) = 0" "x'(0) = 0"
gives "a division by 0 at the start" 1 "$motus" run "$place/undefined.motus" --until 2
that "... is named" eval 'says "1/x is a division by 0 there, since x is 0" "$err" && says "begin elsewhere" "$err"'

# --- what is not a failure ------------------------------------------------------------------------------------------------------
gives "a run that succeeds" 0 "$motus" run models/kepler.motus --json
that "... has no diagnosis" eval "jq -e '.diagnosis == null and has(\"switches\")' '$out' >/dev/null"

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
