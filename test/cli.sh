#!/bin/bash
# The program: every verb, option and error, its output and its files.
#
# Each case is one line `ok` or `not ok`; the last line counts them. MOTUS is the program (build/motus).
cd "$(dirname "$0")/.." || exit 1
. test/cli/cases.sh

oscillator=models/driven-oscillator.motus
cat >"$place/osc.motus" <<'M'
F = 0.1
x'' = -x + x^3 + F cos(t)
x(0) = 0
x'(0) = 0
energy = x'^2/2 + x^2/2
method verlet
step 0.01
until 2
M
cat >"$place/field.motus" <<'M'
u[i,j]'' = u[i+1,j] + u[i-1,j] + u[i,j+1] + u[i,j-1] - 4 u[i,j]   for i = 1..8, j = 1..9
u[0,j] = 0   for j = 1..9
u[9,j] = 0   for j = 1..9
u[i,0] = 0   for i = 1..8
u[i,10] = 0  for i = 1..8
u[i,j](0) = sin(pi i/9) sin(pi j/10)   for i = 1..8, j = 1..9
u[i,j]'(0) = 0   for i = 1..8, j = 1..9
step 0.05
until 1
M
osc=$place/osc.motus

# --- the program itself -----------------------------------------------------------------------------------------------------------
gives "--version" 0 "$motus" --version
that "--version says the version of the header" says "motus $(sed -n 's/^#define MOTUS_VERSION "\(.*\)"/\1/p' include/motus.h)"
gives "--version --json" 0 "$motus" --version --json
that "... is JSON" json "$out"
gives "--help" 0 "$motus" --help
that "--help shows the verbs that work" says "motus converge MODEL"
that "... archive among them" says "motus archive"
for verb in $("$motus" --options | sed -n 's/^verb\t//p' | cut -f 1); do
    gives "$verb --help" 0 "$motus" $verb --help
    that "$verb --help lists --json" says "--json"
    that "$verb --help has examples" says "examples:"
    cp "$out" "$place/help-$verb"
    gives "help $verb" 0 "$motus" help $verb
    that "help $verb is the same" cmp -s "$out" "$place/help-$verb"
done
# No line is wider than the terminal, or than 80 columns where that is not known.
fits() { "$motus" "$@" >"$place/wide" 2>/dev/null; [ -s "$place/wide" ] && [ "$(wc -L <"$place/wide")" -le 80 ] || { echo "$*: $(wc -L <"$place/wide")"; return 1; }; }
that "help and cards fit 80 columns" eval "fits --help && fits methods && fits methods auto && fits methods boris && fits methods taylor &&
    for verb in run compare converge sweep merge archive check methods lab cache; do fits \$verb --help || exit 1; done"
that "what is printed of models fits 80 columns" eval "for model in billiard double-pendulum comet stick-slip van-der-pol three-body-figure-eight; do
        fits check models/\$model.motus && fits run models/\$model.motus --until 3 || exit 1; done
    fits run models/three-body-figure-eight.motus --method kahan-li8-reversible --accuracy 1e-6 && fits compare models/spring.motus --all &&
    fits compare models/kepler.motus --accuracies 1e-3:1e-12 --methods verlet,dop853,taylor && fits converge models/damped-spring.motus --points"
if command -v script >/dev/null; then
    for columns in 50 120; do
        script -qec "stty cols $columns; '$motus' check models/van-der-pol.motus; '$motus' run models/comet.motus; '$motus' run models/comet.motus --stpe 1 --every" /dev/null </dev/null |
            tr -d '\r' | sed 's/\x1b\[[0-9;]*m//g' >"$place/wide"
        that "lines fit a terminal of $columns columns" eval "[ \$(wc -L <'$place/wide') -le $columns ] && [ \$(wc -L <'$place/wide') -gt $((columns * 3 / 4)) ]"
    done
fi
# The examples of --help work; slow ones are tested below.
mkdir "$place/examples" && ln -s "$root/models" "$place/examples/models"
"$motus" run models/spring.motus --until 1 -q -o "$place/examples/one.h5" 2>/dev/null && archives=yes || archives= # without HDF5 none
for verb in run sweep check methods; do
    sed -n '/^examples:/,$p' "$place/help-$verb" | sed -e 1d -e ':a; /\\$/N; s/\\\n *//; ta' | while read -r line; do
        [[ $line == *.h5* && -z $archives ]] && continue
        (cd "$place/examples" && PATH=$(dirname "$motus"):$PATH bash -c "set -o pipefail; $line" >/dev/null 2>"$err") &&
            echo "ok $line" || echo "not $line: $(cat "$err")"
    done >"$place/ran"
    that "the examples of $verb work" eval "grep -q ^ok '$place/ran' && ! grep ^not '$place/ran'"
done

refuses "no verb" 2 "a verb is missing" "$motus"
refuses "an unknown verb" 2 "unknown verb frobnicate" "$motus" frobnicate
refuses "a verb with a slip" 2 "did you mean motus compare?" "$motus" comapre x.motus
refuses "a model where the verb should be" 2 "motus run x.motus" "$motus" x.motus
refuses "a verb that there is not" 2 "unknown verb bench" "$motus" bench
for verb in run compare converge sweep check; do refuses "$verb without a model" 2 "motus $verb needs a model" "$motus" $verb; done
refuses "two models" 2 "motus takes one model" "$motus" run $oscillator $osc
refuses "an unknown option" 2 "unknown option --frobnicate" "$motus" run $osc --frobnicate
refuses "an option with a slip" 2 "did you mean --step?" "$motus" run $osc --stpe 0.1
refuses "an option of another verb" 2 "motus check takes no --step" "$motus" check $osc --step 0.1
refuses "a value missing" 2 "--step: its value is missing" "$motus" run $osc --step
refuses "a flag with a value" 2 "--json takes no value" "$motus" run $osc --json=yes --quiet
refuses "--tolerance of a study" 2 "belongs to: run, sweep" "$motus" compare $osc --tolerance 1e-9
refuses "--tolerance with steps of one size" 2 "steps of verlet have one size" "$motus" run $osc --tolerance 1e-9
refuses "--step with an adaptive method" 2 "dopri5 chooses its steps by a tolerance" "$motus" run $osc --method dopri5 --step 0.1
refuses "--tolerance 0" 2 "not a number above 0" "$motus" run $osc --method dopri5 --tolerance 0
refuses "--tolerance beyond rounding" 2 "below the rounding of the numbers" "$motus" run $osc --method dopri5 --tolerance 1e-17
refuses "--tolerance in an unknown sense" 2 "1e-6 absolute" "$motus" run $osc --method dopri5 --tolerance "1e-6 relatively"
refuses "a shortest step that is needed" 1 "needs a step shorter than 0.1" "$motus" run $osc --method bs32 --tolerance 1e-10 --shortest-step 0.1
printf "x'' = 6 x^2\nx(0) = 1\nx'(0) = 2\n" >"$place/pole.motus"
for machine in interpreter compiled; do
    refuses "an accuracy beyond a pole, $machine" 1 "too small to change t = 1" "$motus" run "$place/pole.motus" --method bs32 --accuracy 1e-6 --until 3 --machine $machine
    refuses "... beyond a shortest step" 1 "at t = 0.938143 the tolerance needs a step shorter than 1e-06" "$motus" run "$place/pole.motus" --method bs32 --accuracy 1e-5 --shortest-step 1e-6 --until 3 --machine $machine
done
refuses "a shortest step beyond the longest" 2 "longer than the longest" "$motus" run $osc --method bs32 --shortest-step 0.1 --longest-step 0.01
refuses "a run of more steps than allowed" 1 "after 20 steps, the most that it may take" "$motus" run $osc --method bs32 --most-steps 20
refuses "... with the option in its hint" 1 "--most-steps 200" "$motus" run $osc --method bs32 --most-steps 20
refuses "a limit of steps of one size" 2 "steps of verlet have one size" "$motus" run $osc --method verlet --most-steps 20
refuses "--most-steps 0" 2 "an integer above 0" "$motus" run $osc --method bs32 --most-steps 0
refuses "compare with an adaptive method" 2 "accuracies 1e-3:1e-12" "$motus" compare $osc --methods dopri5,verlet
for bad in "" x 0 -1:1e-3 1e-3:0 nan 1e-3: 1e-3:x 1e-3:1e-4:1e-5 1e-3,1e-4 "1e-3:1e-4 apples"; do
    refuses "--accuracies '$bad'" 2 "--accuracies" "$motus" compare $osc --accuracies "$bad"; done
for bad in 1 2:1e-3 1e-3:1e-17; do refuses "--accuracies $bad" 2 "a relative one is at least 1e-15 and below 1" "$motus" compare $osc --accuracies "$bad"; done
refuses "--accuracies with --step" 2 "--accuracies and --step exclude each other" "$motus" compare $osc --accuracies 1e-3 --step 0.1
refuses "--accuracies with --evaluations" 2 "--accuracies and --evaluations exclude" "$motus" compare $osc --accuracies 1e-3 --evaluations 100
refuses "--accuracies with --share" 2 "--share and --accuracies exclude" "$motus" compare $osc --accuracies 1e-3 --share
refuses "--accuracies of a run" 2 "belongs to: compare" "$motus" run $osc --accuracies 1e-3
refuses "--machine of a plain comparison" 2 "--machine needs --accuracies" "$motus" compare $osc --machine compiled
gives "--tolerance" 0 "$motus" run $osc --method dop853 --tolerance "1e-6 absolute" --longest-step 0.5 --json
that "... is told, with what it led to" holds '.tolerance == 1e-6 and .absolute and .rejected >= 0 and .h_min > 0 and .h_min <= .h_max and .h_max <= 0.5 and (has("step") | not)'
adaptive=$("$motus" run models/driven-oscillator.motus --method dop853 --tolerance 1e-12 --json | jq '.state.x')
that "dop853 at 1e-12 gives the notebook's motion" eval "awk 'BEGIN { d = $adaptive - 0.04778309565760847; exit !(d < 1e-11 && d > -1e-11) }'"
refuses "--from" 2 "x(c)" "$motus" run $osc --from 1
run_compiled=$(XDG_CACHE_HOME=$place/cache "$motus" run $osc --machine compiled --json) run_interpreted=$("$motus" run $osc --machine interpreter --json)
that "--machine compiled: the same bits" [ "$(jq -c .state <<<"$run_interpreted")" = "$(jq -c .state <<<"$run_compiled")" ]
that "--machine compiled is named" [ "$(jq -r .machine <<<"$run_compiled")" = compiled ]
that "motus cache --clear" [ "$(XDG_CACHE_HOME=$place/cache "$motus" cache --clear --json | jq .removed)" = 1 ]
gives "--emit-c" 0 "$motus" run $osc --emit-c
that "--emit-c prints the loop" says advance_run
gives "--emit-c of Taylor series" 0 "$motus" run $osc --emit-c --method taylor --tolerance 1e-6
that "... of the order that the tolerance asks for" says "#define FACT_expands 12"
that "... with their recurrences in one place, so that a compiler reads them once" [ "$("$motus" run $osc --emit-c --method taylor | grep -c 'series_order(w, .*);$')" = 1 ]
gives "--emit-c of Taylor series at round-off" 0 "$motus" run $osc --emit-c --method taylor --tolerance 1e-15
that "... has as many orders as there are" says "#define FACT_expands 26"
refuses "--emit-c with a tolerance where steps have one size" 2 "a tolerance is given, and the steps of verlet have one size" "$motus" run $osc --emit-c --method verlet --tolerance 1e-6
refuses "motus cache alone" 2 "motus cache needs --clear" "$motus" cache
refuses "--set of a parameter to the time" 2 "cannot depend on a state" "$motus" run $oscillator --set F=t
refuses "--machine abacus" 2 "unknown value" "$motus" run $osc --machine abacus
for bad in 0 -1 nan inf 1e999 0,1 0x10 1/0 abc '' 1e-2x; do refuses "--step '$bad'" 2 "--step" "$motus" run $osc --step "$bad"; done
for bad in nan inf abc 1/x pi2 ''; do refuses "--until '$bad'" 2 "--until" "$motus" run $osc --until "$bad"; done
for bad in 0 -1 x '0 steps' '1.5 steps' '10 stops' '-3 steps'; do refuses "--every '$bad'" 2 "--every" "$motus" run $osc -o - --every "$bad"; done
refuses "--evaluations beyond what is counted" 2 "at most 9e+18" "$motus" compare $osc --evaluations 1e30
refuses "a negative argument of a method" 2 "between 0 and 1" "$motus" run $osc --method "newmark(-1, 7)"
refuses "one argument too few" 2 "two numbers between 0 and 1" "$motus" run $osc --method "newmark(1/4)"
for bad in 0 -5 1.5 x 99999999999999999999; do refuses "--evaluations '$bad'" 2 "--evaluations" "$motus" compare $osc --evaluations "$bad"; done
for bad in F '=3' ''; do refuses "--set '$bad'" 2 "--set" "$motus" run $osc --set "$bad"; done
refuses "--set of an unknown name" 2 "G" "$motus" run $osc --set G=1
refuses "--set of the end" 2 "until is a setting" "$motus" run $osc --set until=3
that "... names the option" says "hint: give --until 3" "$err"
refuses "--set of the method" 2 "method is a setting" "$motus" run $osc --set "method = rk4"
that "... names the option too" says "hint: give --method rk4" "$err"
refuses "--set of a component that is not there" 2 "no such component" "$motus" run models/kepler.motus --set "r.z(0)=1"
refuses "--set of a component at another time" 2 "no such component" "$motus" run models/kepler.motus --set "r.x(1)=1"
refuses "--set of a component to what is no number" 2 "is not a constant" "$motus" run models/kepler.motus --set "r.x(0)=q"
refuses "--set of a component, in a link" 2 "r.x(0)=2" "$motus" run models/kepler.motus --set "r.x(0)=2" --share
mkdir "$place/tools"
printf '#!/bin/sh\ncase "$*" in *--eh-frame-hdr*) exec "%s" "$@" ;; esac\necho no >&2\nexit 1\n' "$(command -v ld)" >"$place/tools/ld"
chmod +x "$place/tools/ld"
printf "x'' = -mod(x, 3)\nx(0) = 1\nx'(0) = 0\nstep 0.01\nuntil 2\n" >"$place/mod.motus"
"$motus" sweep "$place/mod.motus" --vary "x(0)=0:1:9" --machine compiled --json -o /dev/null >"$place/linked" 2>"$err"
that "the linker by itself links functions of the C library" eval "holds '.machine == \"compiled\"' '$place/linked' && empty '$err'"
PATH=$place/tools:$PATH XDG_CACHE_HOME=$place/tools "$motus" sweep "$place/mod.motus" --vary "x(0)=0:1:9" --machine compiled --json -o /dev/null >"$out" 2>"$err"
that "where the linker fails by itself, the compiler links" eval "holds '.machine == \"compiled\"' && empty '$err'"
CC=gcc "$motus" sweep $osc --vary F=0:1:9 --machine compiled >/dev/null 2>"$err"
that "CC that is one is not spoken of" lacks CC "$err"
refuses "CC that is no program" 1 'CC is "nosuchcc"' env CC=nosuchcc "$motus" run $osc --machine compiled
that "... what to do without" says "give --machine interpreter" "$err"
refuses "--set of a quantity" 2 "energy" "$motus" run $osc --set energy=1
refuses "--methods with a hole" 2 "a name is missing" "$motus" compare $osc --methods verlet,,rk4
refuses "--columns without -o" 2 "needs -o" "$motus" run $osc --columns x
refuses "--every without -o" 2 "needs -o" "$motus" run $osc --every 0.1
refuses "--plot-of without --plot" 2 "needs --plot" "$motus" run $osc --plot-of "x,x'"
gives "--json and -o -" 2 "$motus" run $osc -o - --json
that "... is an error object" holds '.error.kind == "argument" and (.error.message | length > 9) and .error.line == 0 and .error.column == 0'
that "an error object has these keys and no others" holds '(keys == ["diagnosis","error"]) and (.error | keys == ["column","kind","line","message"])'

# --- run --------------------------------------------------------------------------------------------------------------------------
gives "run --json" 0 "$motus" run $oscillator --json
that "... is JSON" json "$out"
that "... prints nothing else" empty "$err"
for key in model method machine compiled_from step steps evaluations time state quantities invariants seconds singularity; do
    that "run: key $key" holds "has(\"$key\")"
done
that "run: what it says of itself" holds ".model == \"$oscillator\" and .method == \"verlet\" and .step == 0.001 and .steps == 100000 and .time == 100"
that "run: one evaluation a step, and those of the start and the end" holds '.evaluations >= 100000 and .evaluations <= 100002'
that "the notebook's oscillator: the exact recursion's value" near "$(jq .state.x "$out")" 0.04778239807187258 1e-13
gives "verlet-literal" 0 "$motus" run $oscillator --method verlet-literal --json
that "the notebook's own float64 loop" near "$(jq .state.x "$out")" 0.04778239807006475 1e-11
gives "the damped cubic" 0 "$motus" run models/damped-cubic.motus --json
that "the notebook's second recursion" near "$(jq .state.x "$out")" -3.489442177206087865 1e-12
gives "run for people" 0 "$motus" run models/projectile.motus
that "... shows the exact motion" says exact
that "... and the drift of the energy" says energy
that "... has no colour outside a terminal" eval "! grep -q $'\033' '$out'"
# --- the error of the answer: the exact motion has x(100) = 0.04778309565760847
gives "the error of x" 0 "$motus" run $oscillator --json
that "... has its keys" holds 'has("error") and has("significant_until") and .error_reason == ""'
that "... covers the exact motion" holds '((.state.x - 0.04778309565760847) | fabs) as $e | .error.x >= $e and .error.x <= 4 * $e'
that "... at twice the work" holds '.error_work >= 2 and .error_work < 2.02'
"$motus" run $oscillator --json --error none >"$place/none" 2>&1
that "--error none: the same numbers, and no key" [ "$(jq -c '[.state, has("error")]' "$place/none")" = "$(jq -c '[.state, false]' "$out")" ]
gives "run for people says its error" 0 "$motus" run $oscillator
that "... behind the number" says "0.0477824 ± 1.5e-6"
that "... that it is the error of the step" says "± is the error of h = 0.001"
that "... and what it cost" says "finding the errors took 2 × the work of the run"
gives "--error none for people" 0 "$motus" run $oscillator --error none
that "... prints all digits" says "0.047782398071872206"
that "... and no error" lacks "±"
gives "--error full" 0 "$motus" run $oscillator --error full
that "... costs three times" says "finding the errors took 3 × the work of the run"
gives "chaos" 0 "$motus" run models/henon-heiles.motus --until 900
that "... has an end" says "no digit is known to be significant after t = 3"
that "... and a rate" says "errors grow as e^{0.04"
that "... and prints no digit beyond it" says "x      —"
gives "chaos in JSON" 0 "$motus" run models/henon-heiles.motus --until 900 --json
that "... has numbers, and no errors" holds '.significant_until > 200 and .error.x == null and (.state.x | type == "number")'
gives "a restarted run" 0 "$motus" run $osc --until 1 --save-state "$place/half.state"
gives "... says where it goes on" 0 "$motus" run $osc --until 2 --restart "$place/half.state"
that "... at the last full step" says "goes on from the state at t = 1 in $place/half.state"
gives "... knows its error" 0 "$motus" run $osc --until 2 --restart "$place/half.state" --json
cp "$out" "$place/restarted"
gives "... which is" 0 "$motus" run $osc --until 2 --json
that "... nearly that of the whole run" [ "$(jq -s '(.[0].error.x / .[1].error.x - 1) | fabs < 0.1' "$out" "$place/restarted")" = true ]
gives "a state without errors" 0 "$motus" run $osc --until 1 --error none --save-state "$place/half.state" --force
gives "... does not know them" 0 "$motus" run $osc --restart "$place/half.state"
that "... and says why" says "error: not known, because the run was restored"
that "... behind the number too" says " ±?"
gives "--errors" 0 "$motus" run $oscillator -o - --errors --every 10 --columns "t,x" --quiet
that "... adds columns" says "t,x,x.error,significant"
that "... that cover the exact motion" eval "awk -F, '\$1 == 100 { e = \$2 - 0.04778309565760847; if (e < 0) e = -e; good = \$3 >= e && \$4 == 1 } END { exit !good }' '$out'"
gives "--errors beyond the end of significance" 0 "$motus" run models/henon-heiles.motus --until 900 -o - --errors --every 100 --columns "x" --quiet
that "... keeps the numbers, marked" eval "tail -n 1 '$out' | grep -qE '^-?0\.[0-9]+,inf,0$'"
refuses "--errors without -o" 2 "needs -o" "$motus" run $osc --errors
refuses "--errors with --error none" 2 "exclude each other" "$motus" run $osc --errors --error none -o e.csv
refuses "--error of another kind" 2 "unknown value" "$motus" run $osc --error some

gives "run --quiet" 0 "$motus" run $osc --quiet
that "... is quiet" empty "$out"
that "... on both sides" empty "$err"
gives "vectors are lists" 0 "$motus" run models/projectile.motus --json
that "... r and r'" holds '(.state.r | length == 2) and (.state["r'"'"'"] | length == 2)'
that "an invariant has three values" holds '.invariants.energy | keys == ["final","initial","max_drift"]'
that "the largest drift is measured from the start" near "$(jq '.invariants.energy | .max_drift - (.initial - .final)' "$out")" 0 1e-12
that "projectile: y after 3 s by symplectic Euler is ½ g h t too low" \
    near "$(jq '.state.r[1]' "$out")" "$(awk 'BEGIN { printf "%.15g", 4.5*3 - 9.81*9/2 - 9.81*0.05*3/2 }')" 1e-12
gives "the spring, ten periods" 0 "$motus" run models/spring.motus --json
that "the largest drift is found on the way: h/4 of twice the energy" near "$(jq '.invariants.energy.max_drift' "$out")" 0.0128205 1e-5
gives "a family is a list" 0 "$motus" run models/chain.motus --json --until 1
that "... of N numbers" holds ".state.x | length == $(sed -n 's/^N *= *\([0-9]*\).*/\1/p' models/chain.motus)"
gives "a family of vectors is a list of lists" 0 "$motus" run models/three-body-figure-eight.motus --json --until 0.1
that "... 3 bodies in the plane" holds '(.state | to_entries[0].value) | length == 3 and (.[0] | length == 2)'
gives "two indices are lists of lists" 0 "$motus" run "$place/field.motus" --json
that "... 8 by 9" holds '(.state.u | length) == 8 and (.state.u[0] | length) == 9'
that "... in their places" near "$(jq '.state.u[1][2] / .state.u[0][0]' "$out")" \
    "$(awk 'BEGIN { p = atan2(0, -1); printf "%.17g", sin(2*p/9)*sin(3*p/10)/(sin(p/9)*sin(p/10)) }')" 1e-9
gives "quantities" 0 "$motus" run $osc --json
that "... are there" holds '.quantities.energy > 0'
gives "--set" 0 "$motus" run $osc --json --set F=0.2 --set "x(0)=0.5"
cp "$out" "$place/set"
gives "--set is an edit" 0 "$motus" run <(sed 's/F = 0.1/F = 0.2/; s/x(0) = 0/x(0) = 0.5/' "$osc") --json
that "... the same bits" eval "[ \"\$(jq -c .state '$out')\" = \"\$(jq -c .state '$place/set')\" ]"
# --- lists from files ---
cat >"$place/table.motus" <<'M'
T = [0, 1]
A = [0, 0]
x'' = -x + interp(t, T, A)
x(0) = 0
x'(0) = 0
method rk4
step 0.01
until 2
M
table=$place/table.motus
gives "--set of two lists" 0 "$motus" run $table --json --set "T = [0, 1, 2.5]" --set "A=[0.5, 1.5, -1]"
sed 's/"seconds".*//' "$out" >"$place/lists"
sed 's/interp.*/0/' $table >"$place/observed.motus"
echo 'q = interp(t, T, A)' >>"$place/observed.motus"
gives "a quantity outside of its table" 0 "$motus" run "$place/observed.motus"
that "... is said to be undefined, and why" eval "tr -s ' \n' ' ' <'$out' | grep -q ' q undefined: t goes beyond 1, the last point of the table A; .*interp(…, hold)'"
printf 'time,acc (g)\n# a comment\n0,0.5\n1,1.5\n\n2.5,-1\n' >"$place/a.csv"
printf 't;a\n0,0;0,5\n1,0;1,5\n2,5;-1\n' >"$place/b.csv"
printf '0\t0,5\r\n1\t1,5\r\n2,5\t-1\r\n' >"$place/c.tsv"
printf '  0.0   .5\n 1e0  +1.5\n%% a comment\n 2.5 -1\n' >"$place/d.dat"
printf '"time","a, b"\n0,0.5\n1,1.5\n2.5,-1\n' >"$place/e.csv"
printf 'acc\n0,5\n1,5\n-1,0\n' >"$place/f.csv"
from() { # NAME T A: the lists are columns of files
    gives "$1" 0 "$motus" run $table --json --set "T=$2" --set "A=$3"
    that "... has the numbers of the lists" eval "sed 's/\"seconds\".*//' '$out' | cmp -s - '$place/lists'"
}
from "columns by number" "@$place/a.csv:1" "@$place/a.csv:2"
from "columns by name" "@$place/a.csv:time" "@$place/a.csv:acc (g)"
from "decimal commas and semicolons" "@$place/b.csv:t" "@$place/b.csv:2"
from "decimal commas and tabs" "@$place/c.tsv:1" "@$place/c.tsv:2"
from "columns between blanks" "@$place/d.dat:1" "@$place/d.dat:2"
from "a name with a comma" "@$place/e.csv:time" "@$place/e.csv:a, b"
from "the only column, with decimal commas" "@$place/a.csv:1" "@$place/f.csv"
"$motus" sweep $table --vary "x(0)=0:1:2" --set "A=@$place/a.csv:2" --set "T=@$place/a.csv:1" --record final -o "$place/list.csv" -q 2>"$err"
that "a file of results has the numbers, not the name of the file" eval "head -n 1 '$place/list.csv' | grep -q 'A=\[0.5, 1.5, -1\]'"
printf '0,5\n1,5\n-1,0\n' >"$place/g.csv"
refuses "what may be two columns or decimal commas" 2 "a number with a decimal comma, or two columns" "$motus" run $table --set "A=@$place/g.csv"
refuses "... also with a number" 2 "a number with a decimal comma, or two columns" "$motus" run $table --set "A=@$place/g.csv:1"
printf 't,a\n0,1\n1,2\n1,3\n2,nan\n4,\n5\n6,7,8\n' >"$place/h.csv"
head -n 4 "$place/h.csv" >"$place/i.csv"
refuses "points that do not rise" 2 "in T number 2 is 1 and number 3 1" "$motus" run $table --set "T=@$place/i.csv:t" --set "A=@$place/i.csv:a"
that "... with the line of the file" says "T[3] stands in line 4 of $place/i.csv" "$err"
refuses "a cell that is no number" 2 "h.csv:5: nan is not a finite number" "$motus" run $table --set "A=@$place/h.csv:a"
sed -i 5d "$place/h.csv"
refuses "a cell that is empty" 2 "h.csv:5: nothing is not a finite number" "$motus" run $table --set "A=@$place/h.csv:a"
sed -i 5d "$place/h.csv"
refuses "a row that is too short" 2 "h.csv:5: the line has too few columns" "$motus" run $table --set "A=@$place/h.csv:a"
sed -i 5d "$place/h.csv"
refuses "a row that is too long" 2 "h.csv:5: the line has more columns than the line of their names" "$motus" run $table --set "A=@$place/h.csv:a"
printf '0,NA\n1,2\n2,3\n' >"$place/j.csv"
refuses "a first row with a cell that is no number is no head" 2 "j.csv:1: NA is not a finite number" "$motus" run $table --set "A=@$place/j.csv:2"
# Files of programs and devices: a list of 0.5, 1.5, -1, whatever stands before and between.
while IFS='|' read -r name column text; do
    printf "$text" >"$place/k.csv"
    from "$name" "@$place/a.csv:1" "@$place/k.csv:$column"
done <<'FILES'
a comment behind a row|2|0,0.5 # note\n1,1.5 #\n2,-1\n
line ends of old computers|2|t,a\r0,0.5\r1,1.5\r2,-1\r
a byte order mark, and a blank before the name| a|\xef\xbb\xbft,a\r\n0,0.5\r\n1,1.5\r\n2,-1\r\n
the line with which Excel says the separator|1|sep=;\n0,5;1;2\n1,5;2;3\n-1;3;4\n
separators at the ends of rows|a|t,a\n0,0.5,\n1,1.5,\n2,-1,\n
lines before the names, and units behind them|CH1|Model,MSO,1\nDate,2\n\nTIME,CH1\ns,Volt\n0,0.5\n1,1.5\n2,-1\n
prose before the only column||Acceleration in g\n0.5\n1.5\n-1\n
dates beside the numbers|2|2020-01-01 00:00,0.5\n2020-01-01 00:01,1.5\n2020-01-01 00:02,-1\n
missing numbers elsewhere|2|NA,0.5\n1,1.5\n,-1\n
exponents of FORTRAN|2|1 5d-1\n2 1.5D+00\n3 -1.\n
numbers in rows of several, behind prose|*|RECORD\nImperial Valley, 5/19/1940, El Centro, 180\nIN G\nNPTS= 3, DT= .01 SEC,\n .5E+00 1.5\n -1.\n
FILES
while IFS='|' read -r name column text sentence; do
    printf "$text" >"$place/k.csv"
    refuses "$name" 2 "$sentence" "$motus" run $table --set "A=@$place/k.csv:$column"
done <<'FILES'
two columns of one name|a|t,a,a\n1,2,3\n|columns 2 and 3 have the name a
column 0|0|t,a\n1,2.5\n|no column 0
a column that is not there|99|t,a\n1,2.5\n|no column 99
a name, but no names|u|1,2.5\n3,4\n|no column u
a quote without an end in the names|2|t,"a\n1,2\n|k.csv:1: a quote has no end in this line
a quote without an end|2|1,2\n"3,4\n|k.csv:2: a quote has no end in this line
marks for thousands|1|1.234,5;2\n|k.csv:1: 1.234,5 is not a finite number
no rows|1|# nothing\n|holds no values
a number beyond the range|2|1;1e999\n|k.csv:1: 1e999 is not a finite number
a missing number behind the names|a|a\nNA\n2\n|k.csv:2: NA is not a finite number
two lines without numbers behind the names|a|a\nx\ny\n2\n|k.csv:3: y is not a finite number
a line of the head that looks like a row|2|Length of the record,2500\n0,1\n1,2\n|k.csv:1: column 1 has a word, and a number in line 2
decimal commas or columns, row by row|*|0,5\n1,5\n|a number with a decimal comma, or two columns
FILES
refuses "lists of different lengths" 2 "2 points, but 3 values" "$motus" run $table --set "A=@$place/a.csv:2"
refuses "a file that is not there" 1 "cannot read" "$motus" run $table --set "A=@$place/none.csv:2"
refuses "several columns and no name" 2 "has several columns" "$motus" run $table --set "A=@$place/a.csv"
printf 'B = [1, 2, 3]\nK = [[1, 2], [3, 4]]\nx = B[1] - K[1, 2]\ny'"''"' = -B[2] y K[2, 1]\ny(0) = 1\ny'"'"'(0) = 0\n' >"$place/entry.motus"
gives "--set of entries" 0 "$motus" run "$place/entry.motus" --json --until 1 --set "B[2]=1/2" --set "K[2, 1] = 5"
sed 's/"seconds".*//' "$out" >"$place/lists"
gives "... is --set of the lists" 0 "$motus" run "$place/entry.motus" --json --until 1 --set "B=[1, 1/2, 3]" --set "K=[[1, 2], [5, 4]]"
that "... to the same bits" eval "sed 's/\"seconds\".*//' '$out' | cmp -s - '$place/lists'"
refuses "an entry that is not there" 2 "B has no such entry" "$motus" run "$place/entry.motus" --set "B[4]=1"
refuses "an entry with too few indices" 2 "an entry of K has more indices" "$motus" run "$place/entry.motus" --set "K[2]=1"
gives "--set of components" 0 "$motus" run models/kepler.motus --json --set "r.x(0) = 5/4" --set "r'.y(0)=sqrt(2)/2" --until 7
cp "$out" "$place/set"
gives "... is --set of vectors" 0 "$motus" run models/kepler.motus --json --set "r(0) = (5/4, 0)" --set "r'(0) = (0, sqrt(2)/2)" --until 7
that "... to the same bits" eval "[ \"\$(jq -c .state '$out')\" = \"\$(jq -c .state '$place/set')\" ]"
"$motus" run - --json <"$osc" >"$out" 2>"$err"
that "a model from standard input" holds '.model == "-" and .steps == 200'
gives "--method and --step" 0 "$motus" run $osc --method rk4 --step 1/64 --json
that "... are taken" holds '.method == "rk4" and .step == 0.015625 and .steps == 128 and .evaluations == 512'
gives "--until 2 pi" 0 "$motus" run $osc --until "2 pi" --step pi/100 --json
that "... ends exactly there" holds '.time == 6.283185307179586 and .steps == 200'
gives "a last, shorter step" 0 "$motus" run $osc --until 1.005 --json
that "... is one step more" holds '.time == 1.005 and .steps == 101'
gives "... and people are told" 0 "$motus" run $osc --until 1.005
that "... its size" says "the last one 0.005"
gives "backward" 0 "$motus" run $osc --until -1 --json
that "... ends before the start" holds '.time == -1 and .steps == 100'
gives "an alias" 0 "$motus" run $osc --method rk2 --json
gives "a method with arguments" 0 "$motus" run $osc --method "newmark(1/4, 1/2)" --json
refuses "an unknown method" 2 "verlett" "$motus" run $osc --method verlett
that "... has a remedy" says "verlet" "$err"
refuses "a method that does not admit the model" 2 "pefrl" "$motus" run models/damped-cubic.motus --method pefrl
that "looking changes nothing: -o, --plot-less and bare runs have the same bits" eval "
    '$motus' run $osc --json --method velocity-verlet >'$place/bare' && '$motus' run $osc --json --method velocity-verlet -o '$place/looked.csv' >'$place/looked' &&
    [ \"\$(jq -c .state '$place/bare')\" = \"\$(jq -c .state '$place/looked')\" ]"

# At most a million numbers.
printf 'N = 600000\nx[i]%s = -x[i] for i = 1..N\nx[i](0) = 1 for i = 1..N\nx[i]%s(0) = 0 for i = 1..N\nstep 0.1\nuntil 0.2\n' "''" "'" >"$place/many.motus"
gives "a large state" 0 "$motus" run "$place/many.motus" --json
that "... is cut at a million numbers, and says so" holds '.cut == true and ([.state[] | length] | add) == 1000000'
that "... and is JSON" json "$out"
gives "a small one" 0 "$motus" run $osc --json
that "... is not cut" holds 'has("cut") | not'

# Speed: the processor time of the founding oscillator from start to exit, the best of several runs, since the machine may be busy.
best=999999
for _ in 1 2 3 4 5 6 7 8 9 10; do
    spent=$({ TIMEFORMAT='%3U %3S'; time "$motus" run $oscillator >/dev/null 2>&1; } 2>&1 | awk '{ print int(1000 * ($1 + $2) + 0.5) }')
    [ "$spent" -lt $best ] && best=$spent
done
that "run $oscillator takes less than 50 ms of a processor ($best ms)" test $best -lt 50

# --- CSV --------------------------------------------------------------------------------------------------------------------------
cd "$place" || exit 1
gives "-o" 0 "$motus" run osc.motus -o traj.csv
that "... says what the file has" says "traj.csv has 201 rows, one at every step"
# Rows between long steps: on straight lines from row to row no number is farther from the motion than a thousandth of its range.
gives "a CSV of long steps" 0 "$motus" run "$root/models/comet.motus" --method taylor --error none -o "$place/smooth.csv"
that "... says that it has rows between them" says "rows, one at every step, and between them what a smooth curve needs"
"$motus" run "$root/models/comet.motus" --method taylor --error none -o "$place/steps.csv" --every "1 step" -q
"$motus" run "$root/models/comet.motus" --method taylor --error none -o "$place/dense.csv" --every 0.01 -q
numbers() { grep -v '^[#t]' "$place/$1.csv"; }
straight() { # rows, and how far lines between them are from the dense ones, in thousandths of the range
    awk -F, 'NR == FNR { n++; for (k = 1; k <= 5; k++) row[n, k] = $k; next }
        { while (at < n - 1 && row[at + 1, 1] < $1) at++
          if (at < 1) at = 1
          for (k = 2; k <= 5; k++) { w = ($1 - row[at, 1]) / (row[at + 1, 1] - row[at, 1]); d = $k - (row[at, k] + w * (row[at + 1, k] - row[at, k]))
              if (d < 0) d = -d; if (d > off[k]) off[k] = d; if (FNR == 1 || $k < low[k]) low[k] = $k; if (FNR == 1 || $k > high[k]) high[k] = $k } }
        END { for (k = 2; k <= 5; k++) if (off[k] / (high[k] - low[k]) > most) most = off[k] / (high[k] - low[k]); printf "%.0f\n", 1000 * most }' <(numbers "$1") <(numbers dense)
}
that "... lines from row to row are a smooth curve" eval "[ $(straight smooth) -le 1 ]"
that "... and from step to step none" eval "[ $(straight steps) -gt 5 ]"
that "... the steps are among the rows" eval "[ \$(numbers steps | wc -l) = $(($(sed -n 's/.* in \([0-9]*\) steps.*/\1/p' "$out") + 1)) ] && [ -z \"\$(comm -23 <(numbers steps | sort) <(numbers smooth | sort))\" ]"
gives "steps short enough" 0 "$motus" run "$root/models/comet.motus" --method dopri5 --tolerance 1e-13 --error none -o "$place/short.csv"
that "... need few rows between them" eval "[ $(numbers short | wc -l) -lt $(($(sed -n 's/.* in \([0-9]*\) steps.*/\1/p' "$out") + 60)) ]"
gives "a CSV of jumps" 0 "$motus" run "$root/models/bouncing-ball.motus" --method rk4 --step 0.01 --until 2 -o "$place/jumps.csv"
that "... says so" says "rows, one at every step, and both sides of $(grep -c . <("$motus" run "$root/models/bouncing-ball.motus" --method rk4 --step 0.01 --until 2 -q --events - | grep '^bounce')) jumps"
that "the first line is the command" eval "[ \"\$(head -n 1 traj.csv)\" = '# motus run osc.motus -o traj.csv' ]"
that "the names" eval "[ \"\$(grep -v '^#' traj.csv | head -n 1)\" = \"t,x,x',energy\" ]"
that "a row for every step and the start" eval "[ \$(grep -vc '^#' traj.csv) = 202 ]"
that "every row has as many numbers as names" eval "! grep -v '^#' traj.csv | awk -F, 'NF != 4 { bad = 1; print } END { exit !bad }'"
"$motus" run osc.motus --json >"$out"
that "the last row is the state of --json, digit by digit" eval "[ \"\$(tail -n 1 traj.csv)\" = \"\$(jq -r '[.time, .state.x, .state[\"x\\u0027\"], .quantities.energy] | map(tostring) | join(\",\")' '$out')\" ]"
"$motus" run osc.motus -o - --quiet >"$out" 2>"$err"
that "-o - is the same on standard output" eval "cmp -s <(grep -v '^#' traj.csv) <(grep -v '^#' '$out')"
"$motus" run osc.motus -o - >"$out" 2>"$err"
that "the summary goes to standard error then" eval "says state '$err' && ! grep -q state '$out'"
gives "--every 10 steps" 0 "$motus" run osc.motus -o - --every "10 steps" --columns t
that "... 21 rows" eval "[ \$(grep -vc '^[#t]' '$out') = 21 ]"
gives "--every 0.1" 0 "$motus" run osc.motus -o - --every 0.1 --columns "t,x"
cp "$out" grid
that "... lands on the steps" eval "cmp -s <(grep -v '^[#t]' grid) <(grep -v '^#' traj.csv | sed 1d | awk -F, 'NR % 10 == 1 { print \$1 \",\" \$2 }')"
gives "--every 0.37, between steps" 0 "$motus" run osc.motus -o - --every 0.37 --columns "t,x"
that "... at these times, and at the end" eval "[ \"\$(grep -v '^[#t]' '$out' | cut -d, -f1 | cut -c 1-5 | tr '\n' ' ')\" = '0 0.37 0.74 1.11 1.48 1.85 2 ' ]"
# Dense output has order 6 in the step; compared with a run whose step ends at 0.37.
x37=$(grep '^0.37,' "$out" | cut -d, -f2)
"$motus" run osc.motus --until 0.37 --json >"$out"
that "... with the values of the motion" near "$x37" "$(jq .state.x "$out")" 1e-12
gives "backward, every 0.25" 0 "$motus" run osc.motus -o - --every 0.25 --until -1 --columns t
that "... the times go down" eval "[ \"\$(grep -v '^[#t]' '$out' | tr '\n' ' ')\" = '0 -0.25 -0.5 -0.75 -1 ' ]"
gives "--columns in their order" 0 "$motus" run osc.motus -o - --columns "energy, x', t" --every 1
that "... and no others" says "energy,x',t"
gives "--columns of a vector" 0 "$motus" run "$root/models/projectile.motus" -o - --columns "r',exact r"
that "... are its components" says "r'.x,r'.y,exact r.x,exact r.y"
gives "--columns with indices" 0 "$motus" run field.motus -o - --columns "u[1,2],u[3,4]'" --every 1
that "... quoted where there is a comma" says "\"u[1,2]\",\"u[3,4]'\""
refuses "an unknown column" 2 "energi" "$motus" run osc.motus -o traj2.csv --columns "t,energi"
that "... leaves no file" absent traj2.csv
printf "x'' = 0\nx(0) = 0\nx'(0) = 0\nmethod rk4\nstep 1\nuntil 1\n" >still.motus
for number in 0.30000000000000004 0.1 1.7976931348623157e+308 4.9406564584124654e-324 123456789012345.67 -2.2250738585072014e-308 1e+22 9007199254740993; do
    "$motus" run still.motus --set "x(0)=$number" -o - --columns x -q >"$out" 2>"$err"
    got=$(sed -n 4p "$out")
    that "$number is written as it is" eval "[ -n '$got' ] && awk -v a='$got' -v b='$number' 'BEGIN { exit !(sprintf(\"%.17g\", a + 0) == sprintf(\"%.17g\", b + 0)) }'"
done
"$motus" run still.motus --set "x(0)=0.1" -o - --columns x -q >"$out"
that "... and 0.1 no longer than that" eval "[ \"\$(sed -n 4p '$out')\" = 0.1 ]"
cat >every.motus <<'M'
x'' = -x
x(0) = 1
x'(0) = 0
step 0.01
until 1
every 25 steps
M
gives "the model's own every" 0 "$motus" run every.motus -o - --columns t
that "... 5 rows" eval "[ \$(grep -vc '^[#t]' '$out') = 5 ]"
gives "... is overridden" 0 "$motus" run every.motus -o - --columns t --every 0.1
that "... 11 rows" eval "[ \$(grep -vc '^[#t]' '$out') = 11 ]"
cp osc.motus $'we\nird, \033[31mname\'s.motus'
gives "a name with a newline and an escape" 0 "$motus" run $'we\nird, \033[31mname\'s.motus' -o weird.csv
that "... stays one line of the head" eval "[ \$(grep -c '^#' weird.csv) = 2 ] && head -n 1 weird.csv | grep -qF \"we'\\\$'\\\\x0a''ird, '\\\$'\\\\x1b''[31m\""
that "... never reaches the terminal" eval "! grep -q $'\033' '$out' '$err'"
gives "... is escaped in JSON" 0 "$motus" run $'we\nird, \033[31mname\'s.motus' --json
that "... which stays JSON" json "$out"
cp osc.motus $'not\xffutf8.motus'
gives "a name that is not UTF-8" 0 "$motus" run $'not\xffutf8.motus' --json
that "... makes good JSON" json "$out"
for locale in $(locale -a 2>/dev/null | grep -iE '^(de|fr)_' | head -n 1); do
    LC_ALL=$locale "$motus" run osc.motus -o - --quiet >"$out"
    that "the point stays a point in $locale" eval "cmp -s <(grep -v '^#' traj.csv) <(grep -v '^#' '$out')"
done

# --- files: complete or not at all ---------------------------------------------------------------------------------------------------
that "no temporary files are left" nothing_left .
echo precious >kept.csv
cat >blow.motus <<'M'
x'' = x^3
x(0) = 1
x'(0) = 1
step 0.01
until 10
M
"$motus" run osc.motus --method dop853 --tolerance 1e-4 --until 5 --save-state rough.state -q >/dev/null
gives "an accuracy that the errors of a restart state exceed" 1 "$motus" run osc.motus --method dop853 --accuracy 1e-9 --until 10 --restart rough.state
printf "x'' = -0.3 sign(x') - x\nx(0) = 5; x'(0) = 0\nuntil 30\n" >sticks.motus
refuses "friction that sticks" 1 "the run crawls: at t = 25.1" "$motus" run sticks.motus --switches step
refuses "friction that sticks, compiled" 1 "$("$motus" run sticks.motus --method dop853 --tolerance 1e-6 --switches step --machine interpreter 2>&1 | sed -n 's/^motus: //p')" \
    "$motus" run sticks.motus --method dop853 --tolerance 1e-6 --switches step --machine compiled
gives "... sticks where its switches are located" 0 "$motus" run sticks.motus
that "... at once" grep -q "0 ±" "$out"
refuses "a motion that leaves the finite numbers" 1 "t = " "$motus" run blow.motus -o kept.csv --save-state kept.state --plot kept.svg --force
that "... leaves the old file as it was" eval "[ \"\$(cat kept.csv)\" = precious ]"
that "... and makes no new one" eval "absent kept.state && absent kept.svg && nothing_left ."
"$motus" run blow.motus --json >"$out" 2>"$err"
that "... and its JSON names the kind" holds '.error.kind == "diverged"'
cat >fall.motus <<'M'
x'' = -1/x^2
x(0) = 1
x'(0) = 0
step 0.001
until 2
M
gives "a run that passes a singularity" 1 "$motus" run fall.motus -o fall.csv
that "... says so, and when" grep -q "singularity of the force between t = 1.11 and t = 1.111" "$err"
that "... and prints what it computed" says "t = 0 to 2"
that "... also into its file" [ "$(grep -c '^[^#]' fall.csv)" = 2002 ]
gives "... by any method" 1 "$motus" run fall.motus --method rk4 --json
that "... its JSON is one object" json "$out"
that "... that has the time" holds '.singularity == 1.11 and .steps == 2000'
gives "... but not before it" 0 "$motus" run fall.motus --until 1.1 --json
that "... whose JSON has none" holds '.singularity == null'
sed 's/-1.x^2/-x\/(x^2 + 1e-6)^1.5/; s/step.*/step 0.01/' fall.motus >narrow.motus
gives "a step that does not resolve the force" 1 "$motus" run narrow.motus --json
that "... is told" grep -q "the step does not resolve the force between t = 1.11 and t = 1.12" "$err"
that "... and is no singularity" holds '.singularity == null'
printf "x'' = 1/(1 - t)\nx(0) = 0\nx'(0) = 0\nmethod rk4\nstep 0.25\nuntil 2\n" >pole.motus
refuses "a division by zero on the way" 1 "t = " "$motus" run pole.motus -o pole.csv
that "... leaves no file" absent pole.csv
refuses "a folder that is not there" 1 "cannot write" "$motus" run osc.motus -o nowhere/traj.csv
refuses "a folder as output" 1 "cannot write" "$motus" run osc.motus -o .
refuses "a full disk" 1 "No space left" "$motus" run osc.motus -o /dev/full
ln -s /dev/full full.svg
refuses "a full disk, plot" 1 "full.svg: No space left" "$motus" run osc.motus --plot full.svg
"$motus" run osc.motus --json >/dev/full 2>"$err"
that "a full standard output is exit status 1" test $? = 1
that "... and one message" eval "[ \$(wc -l <'$err') = 1 ] && says 'standard output' '$err'"
for verb in "compare osc.motus --methods verlet" "converge osc.motus --methods verlet" "check osc.motus" "run osc.motus --emit-c" methods --help; do
    "$motus" $verb >/dev/full 2>"$err"
    that "full: motus $verb" eval "[ $? = 1 ] && [ \$(wc -l <'$err') = 1 ] && grep -q 'No space left' '$err'"
done
# With descriptors 0 to 2 closed an output file must not get one of them, and with it the report.
closed() { "$@" <&- >&- 2>&-; }
for kind in csv svg npy table; do
    case $kind in
    csv) words=(run osc.motus -o) ;;
    svg) words=(run osc.motus --plot) ;;
    npy) words=(sweep osc.motus --vary "x(0)=1:2:9" -o) ;;
    table) words=(run osc.motus --when "x = 0: record" --events) ;;
    esac
    "$motus" "${words[@]}" open.$kind >"$out" 2>"$err"
    closed "$motus" "${words[@]}" closed.$kind
    that "descriptors 0 to 2 closed: $kind has its bytes" eval "[ $? = 0 ] && cmp <(sed 's/open[.]$kind/closed.$kind/' open.$kind) closed.$kind"
done
closed "$motus" run osc.motus
that "... a report without a file is not lost with status 0" [ $? = 1 ]
"$motus" run osc.motus -o only.csv >&- 2>"$err"
that "... a closed standard output alone wants no report" eval "[ $? = 0 ] && empty '$err' && says 0, only.csv"
# A limit of the size of files is an error, and no signal that kills.
(ulimit -f 1; exec "$motus" run osc.motus --until 1000 -o limited.csv) >"$out" 2>"$err"
that "a limit of the size of files: exit status 1" [ $? = 1 ]
that "... with a message, and no file" eval "says 'cannot write limited.csv: File too large' '$err' && absent limited.csv && nothing_left ."
(ulimit -f 1; exec "$motus" sweep osc.motus --vary "x(0)=1:2:9000" -o limited.npy) >"$out" 2>"$err"
that "... of a sweep" eval "[ $? = 1 ] && says 'cannot write limited.npy: File too large' '$err'"
mkdir small
if mount -t tmpfs -o size=64k none small 2>/dev/null; then
    refuses "a full file system" 1 "No space left" "$motus" run "$root/$oscillator" -o small/traj.csv
    that "... is left as it was" eval "[ -z \"\$(ls -A small)\" ]"
    umount small
fi
if [ "$(id -u)" != 0 ]; then
    touch locked.csv && chmod 444 locked.csv
    refuses "a file made read-only" 1 "Permission denied" "$motus" run osc.motus -o locked.csv
    cp osc.motus secret.motus && chmod 000 secret.motus
    refuses "an unreadable model" 1 "Permission denied" "$motus" run secret.motus
fi
cp osc.motus self.motus
refuses "the model as its own output" 2 "would be overwritten" "$motus" run self.motus -o self.motus
ln -s self.motus link.motus
refuses "... through a link" 2 "would be overwritten" "$motus" run self.motus -o link.motus
that "... and it is whole" cmp -s osc.motus self.motus
refuses "two outputs of one name" 2 "two outputs" "$motus" run osc.motus -o same.svg --plot same.svg
refuses "an output without a name" 2 "empty" "$motus" run osc.motus -o ""
touch target.csv && ln -s target.csv through.csv
gives "an output through a link" 0 "$motus" run osc.motus -o through.csv
that "... keeps the link and fills its target" eval "[ -L through.csv ] && [ -s target.csv ]"
(umask 027 && "$motus" run osc.motus -o mask.csv -q)
that "rights follow the umask" eval "[ \$(stat -c %a mask.csv) = 640 ]"
chmod 600 mask.csv && "$motus" run osc.motus -o mask.csv -q
that "rights of a file that was there stay" eval "[ \$(stat -c %a mask.csv) = 600 ]"
# A long run that is stopped ends by the signal and leaves no file; nor does one that is killed, where the file system
# has files without names.
signals="INT TERM HUP"
begun() { [ -n "$(find . -name '.motus-*')" ] || ls -l "/proc/$1/fd" 2>/dev/null | grep -q deleted; }
"$motus" run osc.motus --until 1e7 -o killed.csv >"$out" 2>"$err" &
child=$!
for _ in $(seq 100); do begun $child && break; sleep 0.02; done
nothing_left . && signals="$signals KILL"
kill -KILL $child
wait $child 2>"$err"
find . -name '.motus-*' -delete
for signal in $signals; do
    [ -n "$(trap -p "$signal")" ] && continue           # the parent process ignores it, so the program does too
    (trap - INT; exec "$motus" run osc.motus --until 1e7 -o "stopped-$signal.csv" >"$out" 2>"$err") &
    child=$!
    for _ in $(seq 100); do begun $child && break; sleep 0.02; done
    sleep 0.1
    kill -$signal $child
    wait $child
    status=$?
    that "SIG$signal: the program dies of it" test $status = $((128 + $(kill -l $signal)))
    that "... and leaves no file, whole or temporary" eval "absent stopped-$signal.csv && nothing_left ."
done
# Where nobody asks for the signal, as in `check` of a large model, the program ends all the same.
printf '%s\n' "x[i]'' = x[i+1] - 2 x[i] + x[i-1] for i = 2..999999" "x[1]'' = 0" "x[1000000]'' = 0" 'x[i](0) = sin(i) for i = 1..1000000' \
    "x[i]'(0) = 0 for i = 1..1000000" >large.motus
"$motus" check large.motus >"$out" 2>"$err" &
child=$!
caught() { (($((0x$(sed -n 's/^SigCgt:[[:space:]]*//p' "/proc/$1/status"))) & 0x4000)); } # SIGTERM
for _ in $(seq 500); do caught $child 2>/dev/null && break; sleep 0.02; done
kill -TERM $child
wait $child
that "SIGTERM ends check of a large model" [ $? = 143 ]
rm large.motus
"$motus" run "$root/$oscillator" -o - 2>"$err" | head -n 3 >"$out"
that "a reader that goes away" eval "[ \${PIPESTATUS[0]} != 0 ] || true; [ \$(wc -l <'$out') = 3 ] && empty '$err'"
exec 7> >(:)
wait $!
"$motus" run "$root/$oscillator" -o kept.csv --force >&7 2>"$err"
that "a reader that has gone away is a failure" [ $? != 0 ]
exec 7>&-
that "... which loses no file" grep -q "^0," kept.csv
rm -f kept.csv

# --- models that cannot be read -----------------------------------------------------------------------------------------------------
refuses "a model that is not there" 1 "cannot read" "$motus" run nowhere.motus
refuses "a folder as model" 1 "folder" "$motus" run small
: >empty.motus
refuses "an empty model" 2 "" "$motus" run empty.motus
head -c 3000 "$motus" >binary.motus
refuses "a model of bytes" 2 "byte 0" "$motus" run binary.motus
head -c 4000 /dev/urandom | tr -d '\000' >random.motus
refuses "a model of random bytes" 2 "random.motus" "$motus" run random.motus
yes "y = 1 + 2 + 3" | head -c 10000000 >ten.motus
refuses "a model of 10 MB" 2 "" timeout 20 "$motus" run ten.motus
head -c 10000000 /dev/urandom | tr -d '\000' >noise.motus
refuses "10 MB of noise" 2 "" timeout 20 "$motus" run noise.motus
yes "# x" | head -c 17000000 >long.motus
refuses "a model beyond 16 MiB" 2 "longer than 16777216 bytes" "$motus" run long.motus
refuses "a model without end" 2 "longer than 16777216 bytes" "$motus" run <(yes "# x")
{ printf "x'' = "; head -c 10000 /dev/zero | tr '\0' '('; printf 1; head -c 10000 /dev/zero | tr '\0' ')'; printf "\nx(0)=0\nx'(0)=0\n"; } >nest.motus
refuses "10 000 nested brackets" 2 "nest.motus:1:" "$motus" run nest.motus
printf "a = b\nb = a\nx'' = -x\nx(0)=1\nx'(0)=0\n" >cycle.motus
refuses "a cycle" 2 "cycle.motus:" "$motus" run cycle.motus --step 0.1 --until 1
printf "x'' = -x\nx(0)=1\nstep 0.1\nuntil 1\n" >missing.motus
refuses "a missing initial value" 2 "x'(0)" "$motus" run missing.motus
printf "omega = 2\nx'' = -omga^2 x\nx(0)=1\nx'(0)=0\nstep 0.1\nuntil 1\n" >slip.motus
refuses "an unknown name" 2 "slip.motus:2:8: " "$motus" run slip.motus
that "... with the line" says "    x'' = -omga^2 x" "$err"
that "... a caret under it" eval "grep -qE '^    {7}\^' '$err' || grep -qE '^           \^' '$err'"
that "... and the remedy" says "omega" "$err"
"$motus" run slip.motus --json >"$out" 2>"$err"
that "... as JSON" holds '.error.kind == "name" and .error.line == 2 and .error.column == 8 and (.error.message | contains("omega"))'
that "... and nothing else" empty "$err"
printf "x'' = -x \033[2J \xe2\x80\xae y\nx(0)=1\nx'(0)=0\n" >escape.motus
refuses "escapes in a model" 2 "escape.motus:1:" "$motus" run escape.motus
that "... do not reach the terminal" eval "! LC_ALL=C grep -qE $'\033'\"|\$(printf '\\xe2\\x80\\xae')\" '$err'"
"$motus" run escape.motus --json >"$out" 2>"$err"
that "... nor JSON" json "$out"
printf "x'' = -x\nx(0)=1\nx'(0)=0\nuntil 1\n" >nostep.motus
"$motus" run nostep.motus >"$out" 2>"$err"
that "a newcomer's lines: a method is chosen" eval "grep -qE '^auto: [a-z0-9]+ needs the fewest operations' '$out' && [ ! -s '$err' ]"
that "... for the accuracy 1e-9" eval "grep -qF \"accuracy 1e-09 of the motion's size holds\" '$out'"
"$motus" run nostep.motus --json >"$out" 2>"$err"
that "... in JSON too" holds '.accuracy == 1e-9 and .reached <= 1e-9 and .tolerance > 0 and (.choice | length) > 0 and .suggested == {} and (.state.x - 0.5403023058681398 | fabs) <= 1e-9'
"$motus" run nostep.motus --accuracy 1e-5 --method rk4 --json >"$out" 2>"$err"
that "--accuracy finds the step of a method with steps of one size" holds '.method == "rk4" and .reached <= 1e-5 and .step > 0 and (.state.x - 0.5403023058681398 | fabs) <= 1e-5'
"$motus" run nostep.motus --accuracy "1e-6 absolute" --json >"$out" 2>"$err"
that "... an absolute one" holds '.absolute and .reached <= 1e-6'
"$motus" run "$root/models/driven-oscillator.motus" --accuracy 1e-8 --json >"$out" 2>"$err"
that "... and leaves the model's method and step aside" holds '.method != "verlet" and .reached <= 1e-8 and (.state.x - 0.04778309565760847 | fabs) <= 1e-8'
"$motus" run nostep.motus --accuracy 1e-15 --until 1000 >"$out" 2>"$err"
status=$?
that "an accuracy out of reach is said after the numbers" eval "[ $status = 1 ] && grep -q 'accuracy 1e-15 of the motion.s size is not reached' '$out' && grep -qF 'the accuracy 1e-15 is not reached: the trials reached' '$err'"
"$motus" run nostep.motus --accuracy 1e-15 --until 1000 --json >"$out" 2>"$err"
status=$?
that "... in JSON within the one object, and on standard error" eval "[ $status = 1 ] && [ \$(jq -s length '$out') = 1 ] && grep -q 'the accuracy 1e-15' '$err'"
that "... as \`missed\`, beside the errors" holds '.missed.kind == "accuracy" and (.missed.message | contains("1e-15")) and .error.x > 0 and .reached > .accuracy'
printf "x' = 10*(y - x)\ny' = x*(28 - z) - y\nz' = x*y - 8/3*z\nx(0)=1; y(0)=1; z(0)=1\nuntil 60\n" >lorenz.motus
"$motus" run lorenz.motus --accuracy 1e-9 >"$out" 2>"$err"
lost=$(grep -o 'significant after t = [0-9.]*' "$out")
that "where no digit is left, the refusal names the time of the run that is printed" eval "[ -n '$lost' ] && grep -qE '$lost\$' '$err'"
that "... and says what keeps digits, not that there are some" eval "grep -q 'a smaller --until' '$err' && ! grep -q 'the numbers are there' '$err'"
"$motus" run lorenz.motus --accuracy 1e-9 --until 36 >"$out" 2>"$err"
that "... and where digits are left, their error, which no trial has told" eval "grep -q 'is not reached: the error is ' '$err' && grep -q 'the numbers are there' '$err'"
printf "x'' = -(1+3*(x<0))*x\nx(0)=1\nx'(0)=0\nuntil 20\n" >kinked.motus
"$motus" compare kinked.motus --accuracies 1e-3:1e-8 --methods gauss4 >"$out" 2>"$err"
that "where kinks keep a method from an accuracy, compare does not blame rounding" eval "grep -qE 'gauss4: the best of its [0-9]+ runs has the error' '$out' && ! grep -q rounding '$out'"
printf "x'' = 0\nx(0)=0\nx'(0)=0\nuntil 1\nw = -x\n" >signless.motus
for how in cheap none; do
    "$motus" run signless.motus --error $how >"$out" 2>"$err"
    that "a component that is 0 has no sign, --error $how" eval "grep -qE '^ +w +0( |\$)' '$out'"
done
"$motus" check nostep.motus >"$out" 2>"$err"
that "check names the method that auto takes, and why" eval "grep -A1 '^auto' '$out' | grep -qE '[a-z0-9]+ needs the fewest operations: '"
"$motus" check nostep.motus --json >"$out" 2>"$err"
that "... in JSON" holds '.auto.method as $m | .auto.why | startswith($m)'
refuses "accuracy and tolerance" 2 "an accuracy and a tolerance are given" "$motus" run nostep.motus --accuracy 1e-6 --tolerance 1e-6
refuses "accuracy and step" 2 "a step and an accuracy are given" "$motus" run nostep.motus --method verlet --accuracy 1e-6 --step 0.1
refuses "auto and step" 2 "give --accuracy 1e-9 in its place" "$motus" run nostep.motus --method auto --step 0.1
refuses "an accuracy below rounding" 2 "is below the rounding of the numbers" "$motus" run nostep.motus --accuracy 1e-17
refuses "a negative accuracy" 2 "--accuracy" "$motus" run nostep.motus --accuracy -1
"$motus" run nostep.motus --method verlet >"$out" 2>"$err"
that "no step anywhere: one is suggested" eval "grep -qF 'the model gives no step: motus takes it from the fastest rate of its motion, 1, and its longest period, or time of growth, 6.28. To keep it' '$err'"
that "... as a line of a model" eval "grep -qx 'step 0.01' '$err'"
"$motus" run nostep.motus --method verlet --json >"$out" 2>"$err"
that "... and marked in JSON" holds '.step == 0.01 and .suggested == {"step": 0.01}'
printf "x'' = -x\nx(0)=1\nx'(0)=0\nstep 0.1\n" >nountil.motus
"$motus" run nountil.motus --json >"$out" 2>"$err"
that "no end anywhere: one is suggested" holds '.time == 50 and .suggested == {"until": 50}'
that "... as a line of a model" eval "grep -qx 'until 50' '$err'"
printf "x'' = -x\nx(0)=1\nx'(0)=0\n" >neither.motus
"$motus" run neither.motus --method verlet -o suggested.csv >/dev/null 2>"$err"
that "neither: both on one line" eval "grep -qx 'step 0.05; until 50' '$err'"
{ cat neither.motus; grep '^step' "$err"; } >kept.motus
"$motus" run kept.motus --method verlet -o kept.csv --json >"$out" 2>"$err"
that "... which keeps the run" eval "diff <(grep -v '^#' suggested.csv) <(grep -v '^#' kept.csv) && [ ! -s '$err' ]"
that "... and is no suggestion any more" holds '.suggested == {}'
"$motus" run neither.motus --method verlet -q >"$out" 2>"$err"
that "--quiet says nothing of it" eval "[ ! -s '$err' ]"
"$motus" compare neither.motus --methods verlet,rk4 --json >"$out" 2>"$err"
that "compare suggests the same" holds '.suggested == {"step": 0.05, "until": 50} and all(.rows[]; .step == 0.05 and .steps == 1000)'
"$motus" converge neither.motus --methods verlet --json >"$out" 2>"$err"
that "converge needs an end alone" holds '.suggested == {"until": 50} and .rows[0].observed > 1.9'
"$motus" sweep neither.motus --vary "x(0)=1,2,4" --json -o neither.csv --force >"$out" 2>"$err"
that "sweep suggests the same for all trajectories" eval "grep -qF -- '--step 0.05 --until 50' neither.csv"
that "... and marks it" holds '.suggested == {"step": 0.05, "until": 50} and .steps == 1000'

# --- restart ------------------------------------------------------------------------------------------------------------------------
restart_case() {            # model, step, half, whole, method
    local model=$1 step=$2 half=$3 whole=$4 method=$5
    rm -f state first.csv second.csv whole.csv
    "$motus" run "$model" --step "$step" --until "$whole" --method "$method" --json -o whole.csv >whole.json 2>"$err" &&
        "$motus" run "$model" --step "$step" --until "$half" --method "$method" -q --save-state state -o first.csv 2>"$err" &&
        "$motus" run "$model" --step "$step" --until "$whole" --method "$method" --json --restart state -o second.csv >second.json 2>"$err" ||
        { cat "$err" second.json; return 1; }
    [ "$(jq -c '[.state, .steps, .evaluations, .time, .iterations]' whole.json)" = "$(jq -c '[.state, .steps, .evaluations, .time, .iterations]' second.json)" ] ||
        { echo "the end differs"; return 1; }
    [ "$(jq -c '[.invariants[].initial]' whole.json)" = "$(jq -c '[.invariants[].initial]' second.json)" ] || { echo "the start of the invariants differs"; return 1; }
    local rows
    rows=$(grep -v '^[#t]' second.csv | wc -l)
    cmp -s <(grep -v '^[#t]' second.csv) <(grep -v '^[#t]' whole.csv | tail -n "$rows") || { echo "the rows differ"; return 1; }
}
for method in verlet verlet-literal beeman velocity-verlet leapfrog symplectic-euler rk4 pefrl yoshida6 gauss4 implicit-midpoint "newmark(1/4, 1/2)"; do
    that "restarted is uninterrupted, to the bit: $method" restart_case osc.motus 0.01 0.7 2 "$method"
done
that "... with a velocity in the force" restart_case "$root/models/damped-cubic.motus" 0.001 1 3 verlet
that "... with vectors" restart_case "$root/models/kepler.motus" 0.01 1.5 4 velocity-verlet
that "... after an end between steps" restart_case osc.motus 0.01 0.705 2 verlet
that "... to an end between steps" restart_case osc.motus 0.01 0.7 1.995 verlet
that "... with a step that is no binary fraction" restart_case osc.motus 1/3 5 20 verlet
that "... backward" restart_case osc.motus 0.01 -0.7 -2 velocity-verlet
"$motus" run osc.motus -q --until 1 --save-state state --force
gives "a state may be replaced by the next one" 0 "$motus" run osc.motus -q --restart state --save-state state
cp state good
gives "a restart without --until" 0 "$motus" run osc.motus --restart good --json
that "... goes to the end of the model" holds '.time == 2 and .steps == 200'
refuses "a restart with another method" 2 "" "$motus" run osc.motus --restart good --method rk4
refuses "a restart with another step" 2 "" "$motus" run osc.motus --restart good --step 0.02
refuses "a restart of another model" 2 "" "$motus" run "$root/models/kepler.motus" --restart good
refuses "a restart from a model" 2 "" "$motus" run osc.motus --restart osc.motus
refuses "a restart from nothing" 1 "cannot read" "$motus" run osc.motus --restart nowhere
head -c $(($(stat -c %s good) / 2)) good >half
refuses "half a state" 2 "" "$motus" run osc.motus --restart half
head -c 2000 /dev/urandom >noise
refuses "a state of noise" 2 "" "$motus" run osc.motus --restart noise
: >none
refuses "an empty state" 2 "" "$motus" run osc.motus --restart none

# --- plots --------------------------------------------------------------------------------------------------------------------------
gives "--plot svg" 0 "$motus" run "$root/models/projectile.motus" --plot fig.svg -q
that "... is an SVG" eval "head -c 200 fig.svg | grep -q '<?xml' && tail -n 2 fig.svg | grep -q '</svg>'"
that "... the exact motion is green" eval "grep -qi '15803d\|rgb( 21, 128,  61)' fig.svg"
that "... in dashes" grep -q stroke-dasharray fig.svg
printf "x'' = -sin(x)\nx(0) = 1; x'(0) = 0\nuntil 50\n" >plain.motus # nothing is observed after every step
gives "--plot of steps that adapt" 0 "$motus" run plain.motus --plot plain.svg -q
gives "--plot png" 0 "$motus" run osc.motus --plot fig.png -q
that "... is a PNG" eval "head -c 8 fig.png | od -An -tx1 | grep -q '89 50 4e 47 0d 0a 1a 0a'"
gives "--plot pdf" 0 "$motus" run osc.motus --plot fig.pdf -q
that "... is a PDF" eval "head -c 5 fig.pdf | grep -q '%PDF-'"
gives "--plot -" 2 "$motus" run osc.motus --plot -
refuses "--plot fig.gif" 2 ".svg, .png or .pdf" "$motus" run osc.motus --plot fig.gif
gives "a coarse run" 0 "$motus" run "$root/$oscillator" --step 0.2 --until 60 --plot band.svg -q
that "... draws its error" says "fill-opacity = '0.250000'" band.svg
gives "a fine run" 0 "$motus" run "$root/$oscillator" --plot line.svg -q
that "... whose error is thinner than the line, does not" lacks "fill-opacity" line.svg
gives "a run whose error becomes total" 0 "$motus" run "$root/models/spring.motus" --method explicit-euler --plot total.svg -q
that "... is dotted from there on" says "stroke-dasharray='1.2,2.4'" total.svg
that "... and the title says from when" says "no digit is known after t = 20.4 (dotted)" total.svg
gives "a path whose error becomes total" 0 "$motus" run "$root/models/charged-particle.motus" --method explicit-euler --plot path.svg -q
that "... says so" says "no digit is known after t = 4.85 (dotted)" path.svg
gives "... and a phase plane" 0 "$motus" run "$root/$oscillator" --step 0.5 --until 100 --plot-of "x,x'" --plot plane.svg -q
that "... says so" says "no digit is known after t = 51 (dotted)" plane.svg
gives "one that tells no errors" 0 "$motus" run "$root/models/spring.motus" --method explicit-euler --error none --plot none.svg -q
that "... has nothing dotted" lacks "no digit" none.svg
gives "a phase plane" 0 "$motus" run osc.motus --plot phase.svg --plot-of "x,x'" -q
that "... names its axes" grep -q "x&apos; against x\|x' against x\|x&#39; against x" phase.svg
gives "a quantity against time" 0 "$motus" run osc.motus --plot energy.svg --plot-of "t,energy" -q
refuses "--plot-of of one column" 2 "two columns" "$motus" run osc.motus --plot no.svg --plot-of x
refuses "--plot-of of an unknown column" 2 "q" "$motus" run osc.motus --plot no.svg --plot-of "x,q"
refuses "--plot-of of a vector" 2 "r.x" "$motus" run "$root/models/projectile.motus" --plot no.svg --plot-of "t,r"
that "... and no picture" absent no.svg
gives "100 000 steps" 0 "$motus" run "$root/$oscillator" --plot long.svg -q
that "... are thinned to what is seen" test "$(stat -c %s long.svg)" -lt 300000
for model in "$root"/models/*.motus; do
    name=$(basename "$model" .motus)
    gives "a picture of $name" 0 timeout 60 "$motus" run "$model" --plot "$name.svg" -q
    that "... is whole" eval "tail -n 2 '$name.svg' | grep -q '</svg>'"
done
gives "a field" 0 "$motus" run field.motus --plot field.svg -q
that "... is an image inside the SVG" grep -q 'data:image/png' field.svg
# Names that a shell or gnuplot would execute.
evil=$'`touch owned`\'; system("touch owned"); \'@x $(touch owned).motus'
cp osc.motus "$evil"
gives "a name full of commands" 0 "$motus" run "$evil" --plot evil.svg -q
that "... is only a title" eval "absent owned && grep -q 'touch owned' evil.svg"
cp osc.motus 'a_{b}^c.motus'
gives "a name full of markup" 0 "$motus" run 'a_{b}^c.motus' --plot markup.svg -q
that "... is shown as it is" grep -qF 'a_{b}^c' markup.svg
printf "θ'' = -θ\nθ(0)=1\nθ'(0)=0\nstep 0.1\nuntil 1\n" >theta.motus
gives "names in Greek" 0 "$motus" run theta.motus --plot theta.svg -q
that "... in the picture" grep -q θ theta.svg
mkdir bin
refuses "no gnuplot" 1 "gnuplot is not installed" env PATH="$place/bin" "$motus" run osc.motus --plot no.svg
that "... says how to get it" says "apt-get install gnuplot" "$err"
printf '#!/bin/sh\necho "line 0: the pen is broken" >&2\nexit 1\n' >bin/gnuplot && chmod +x bin/gnuplot
refuses "a gnuplot that fails" 1 "the pen is broken" env PATH="$place/bin:$PATH" "$motus" run osc.motus --plot no.svg -o no.csv
that "... leaves neither picture nor CSV" eval "absent no.svg && absent no.csv && nothing_left ."
printf '#!/bin/sh\nexit 0\n' >bin/gnuplot
PATH=$place/bin:$PATH "$motus" run "$root/$oscillator" --plot no.svg -q >"$out" 2>"$err"
that "a gnuplot that does not listen is an error, not a death" test $? = 1
cd "$root" || exit 1

# --- compare ------------------------------------------------------------------------------------------------------------------------
gives "compare --json" 0 "$motus" compare models/projectile.motus --json
that "... is JSON" json "$out"
that "compare: the keys of a row" holds '.rows | length > 3 and all(.[]; has("method") and has("order") and has("steps") and has("evaluations") and has("seconds") and has("error_max") and has("error_final") and has("invariants") and has("reversal"))'
gives "compare: a composition under friction" 0 "$motus" compare models/damped-cubic.motus --methods kahan-li8 --step 0.01 --json
that "... returns to its start by round-off" holds '.rows[0].reversal < 1e-11 and .rows[0].error_max < 1e-9'
printf "x' = -x\nx(0) = 1\nstep 0.1\nuntil 1\n" >"$place/decay.motus"
gives "compare: a first-order variable alone" 0 "$motus" compare "$place/decay.motus" --methods rk4 --json
that "... has an error, and no position has" holds '.rows[0] | .error_max == null and .error_max_v == null and .error_max_s > 1e-8'
gives "compare --json" 0 "$motus" compare models/projectile.motus --json
euler=$(jq '.rows[] | select(.method == "explicit-euler").error_final' "$out")
symplectic=$(jq '.rows[] | select(.method == "symplectic-euler").error_final' "$out")
that "projectile: explicit Euler is off by ½ g h t" near "$euler" 0.73575 1e-12
that "projectile: symplectic Euler is off by as much" near "$symplectic" 0.73575 1e-12
that "projectile: RK2 and Verlet are exact to round-off" holds '[.rows[] | select(.method == "midpoint" or .method == "verlet").error_max] | length == 2 and all(.[]; . < 1e-12)'
gives "compare for people" 0 "$motus" compare models/projectile.motus
that "... says why" eval "grep -qi 'opposite' '$out'"
gives "spring" 0 "$motus" compare models/spring.motus --json --methods explicit-euler,symplectic-euler
that "spring: explicit Euler gains energy without bound" holds '.rows[0].invariants.energy | .trending == true and .final > 2 * .initial'
that "spring: symplectic Euler does not" holds '.rows[1].invariants.energy | .trending == false and .max_drift < 0.1 * .initial'
that "--methods keeps the order asked for" holds '[.rows[].method] == ["explicit-euler", "symplectic-euler"]'
gives "--methods with arguments" 0 "$motus" compare $osc --json --methods "verlet,newmark(1/4, 1/2),rk4"
that "... are three" holds '.rows | length == 3'
gives "equal work" 0 "$motus" compare models/kepler.motus --evaluations 6000 --methods verlet,rk4 --json --until 3
that "... is equal work" holds '[.rows[].evaluations] | all(.[]; . > 5400 and . < 6600)'
that "... by unequal steps" holds '.rows[1].step > 3 * .rows[0].step'
gives "a reference where there is no exact motion" 0 "$motus" compare $osc --methods verlet,rk4 --json
that "... has an error of its own" holds '.reference != "exact" and .reference_error > 0 and .reference_error < 1e-9 and .rows[0].error_max > 1e-7'
gives "compare --quiet" 0 "$motus" compare $osc --methods verlet --quiet
that "... is quiet" empty "$out"
refuses "compare with an unknown method" 2 "verlett" "$motus" compare $osc --methods verlett
gives "compare --plot" 0 "$motus" compare models/projectile.motus --methods explicit-euler,symplectic-euler,verlet --plot "$place/cmp.svg" -q
that "... draws the methods and the truth" eval "grep -q symplectic-euler '$place/cmp.svg' && grep -qi '15803d\|rgb( 21, 128,  61)' '$place/cmp.svg'"

gives "compare --accuracies" 0 "$motus" compare models/kepler.motus --accuracies 1e-4:1e-7 --methods rk4,pefrl,dop853,dep12 --json
that "... is JSON" json "$out"
that "... every method meets every accuracy" holds '.accuracies == [1e-4, 1e-5, 1e-6, 1e-7] and (.rows | length == 4) and ([.rows[].points[] | select(.error > 0 and .error <= .accuracy and .seconds > 0)] | length == 16)'
that "... with a step or a tolerance" holds 'all(.rows[]; (.adaptive == all(.points[]; has("tolerance"))) and (.adaptive != all(.points[]; has("step"))))'
that "... the cheapest has the fewest evaluations" holds '. as $all | all(range(4); . as $i | $all.cheapest[$i].evaluations == ([$all.rows[] | [.points[$i].evaluations, .method]] | min | .[1]))'
gives "... in any order" 0 "$motus" compare models/kepler.motus --accuracies 1e-7:1e-4 --methods dop853 --json
that "... is the same" holds '.accuracies == [1e-4, 1e-5, 1e-6, 1e-7] and .refused == []'
gives "... more than the reference knows" 0 "$motus" compare models/kepler.motus --accuracies 1e-11:1e-14 --methods verlet,dep12
that "... is refused, and told" eval "grep -q 'Accuracies from 1e-1[234] on are left out' '$out' && grep -q 'verlet: .* would take' '$out' && ! grep -q '1e-14  ' '$out'"
refuses "nothing but what the reference does not know" 1 "no accuracy can be judged" "$motus" compare models/kepler.motus --accuracies 1e-14 --methods verlet,dep12
gives "... drawn" 0 "$motus" compare models/spring.motus --accuracies 1e-3:1e-5 --methods verlet,dop853 --plot "$place/work.svg" -q
that "... with both works" eval "grep -q 'evaluations of the force' '$place/work.svg' && grep -q 'time in seconds' '$place/work.svg' && grep -q dop853 '$place/work.svg'"

# --- converge -----------------------------------------------------------------------------------------------------------------------
for name in pendulum damped-cubic projectile-drag charged-particle; do
    gives "converge $name: every method keeps its order" 0 "$motus" converge models/$name.motus --json
    that "... of all that are admitted" holds ".rows | length == $("$motus" check models/$name.motus --json | jq '[.methods[] | select(.admitted and .name != "exact")] | length')"
    that "... none that chooses its steps has failed" holds '[.rows[] | select(.adaptive)] | all(.[]; .passed != .uncertain and .status == "ok") and ([.[] | select(.passed and .power >= .power_due - 0.25 and .between > .between_due - 1)] | length >= 3)'
    that "... certified" holds 'all(.rows[] | select(.adaptive | not); (.observed == null) or (if .standard_error == null then .declared > 8 and .observed >= 8 else .observed > .declared - (if .declared >= 6 then ([0.15, 2 * .standard_error] | max) else 0.15 end) end))'
    [ $name = pendulum ] && cp "$out" "$place/pendulum.json"
done
that "converge is JSON" json "$place/pendulum.json"
that "converge: the keys of a row" holds '.rows | all(.[]; has("method") and has("declared") and has("observed") and (.points | length > 2 and all(.[]; has("step") and has("error") and .evaluations > 0)))' "$place/pendulum.json"
that "... one evaluation a step, and four" holds '[.rows[] | select(.method == "velocity-verlet" or .method == "rk4") | . as $r | .points[] | .evaluations * .step / (if $r.method == "rk4" then 4 else 1 end)] | max / min < 1.4' "$place/pendulum.json"
gives "converge for people" 0 "$motus" converge $osc --methods verlet,rk4
that "... prints one table first" eval "sed -n 3p '$out' | grep -qE '^  method +declared +observed +passed$'"
that "... of certificates" eval "grep -qE '^  verlet +2 +(1\.9|2\.0)[0-9] +yes$' '$out' && grep -qE '^  rk4 +4 +(3\.9|4\.0|3\.8|4\.1)[0-9] +yes$' '$out'"
that "... without the points" eval "! grep -qE '^ +(step|error) ' '$out'"
gives "converge --points" 0 "$motus" converge $osc --methods verlet,rk4 --points
that "... the same table" eval "sed -n 3,5p '$out' | grep -qE '^  rk4 +4 '"
that "... and then the error at every step" eval "[ \$(grep -cE '^    (step|error) ' '$out') -ge 4 ]"
gives "converge of methods that choose their steps" 0 "$motus" converge models/henon-heiles.motus --methods tsit5,dep6,radau15
that "... certifies two" eval "grep -qE '^  tsit5 +yes +5 +(4\.9|5\.0)[0-9] ' '$out' && grep -qE '^  dep6 +yes ' '$out'"
that "... and says that it cannot tell" eval "grep -qE '^  radau15 +not certified ' '$out' && grep -q '^not certified: ' '$out'"
gives "... with --points" 0 "$motus" converge models/henon-heiles.motus --methods tsit5 --points
that "... tells tolerances" eval "grep -qE '^    tolerance +1.0e-02 ' '$out' && grep -qE '^    between ' '$out'"
refuses "converge with --method" 2 "converge takes no --method" "$motus" converge $osc --method rk4
that "... names --methods" says "--methods M,..." "$err"
printf "x'' = x^3 exp(x)\nx(0) = 3\nx'(0) = 30\nstep 0.5\nuntil 10\n" >"$place/blow-up.motus"
refuses "converge where nothing reaches the end" 1 "no reference solution until 10" "$motus" converge "$place/blow-up.motus"
gives "exact here" 0 "$motus" converge models/projectile.motus --methods verlet,rk4
that "... where there is no slope" says "exact here"
printf "x'' = -sign(x)\nx(0) = 1\nx'(0) = 0\nstep 0.01\nuntil 6\n" >"$place/kink.motus"
gives "an order that a force with jumps does not leave" 0 "$motus" converge "$place/kink.motus" --methods rk4
that "... is not certified" says "not certified"
that "... for that reason" says "the force is not smooth"
gives "... with JSON" 0 "$motus" converge "$place/kink.motus" --methods rk4 --json
that "... the rows are one JSON object" json "$out"
that "... that says so" holds '.rows[0] | .passed == false and .uncertain'
gives "converge --plot" 0 "$motus" converge $osc --methods verlet,rk4 --plot "$place/orders.svg" -q
that "... draws both" eval "grep -q rk4 '$place/orders.svg' && grep -q verlet '$place/orders.svg'"

# --- check --------------------------------------------------------------------------------------------------------------------------
gives "check --json" 0 "$motus" check models/damped-cubic.motus --json
that "... is JSON" json "$out"
for key in equations variables velocity_dependent linear_in_velocity time_dependent affine methods; do that "check: key $key" holds "has(\"$key\")"; done
that "check: damped cubic depends on the velocity, linearly" holds '.velocity_dependent and .linear_in_velocity and (.time_dependent | not) and (.affine | not)'
that "check: every method, with a reason where it is refused" holds \
    "(.methods | length == $("$motus" methods --json | jq '.methods | length')) and all(.methods[]; .admitted or (.reason | length > 10))"
that "check: some are refused, some not" holds '([.methods[].admitted] | any) and ([.methods[].admitted] | all | not)'
that "check: with friction a composition is admitted, and preserves nothing" holds '.methods[] | select(.name == "kahan-li8") | .admitted and .preserves == ""'
cat >"$place/printed.motus" <<'M'
g = 9.81
L = 1
theta'' = -g/L sin(theta)
theta(0) = 1
theta'(0) = 0
M
gives "check: the pendulum as textbooks print it" 0 "$motus" check "$place/printed.motus"
that "... says what was understood" says "theta'' = -(g/L) sin(theta)"
gives "... and it runs" 0 "$motus" run "$place/printed.motus" --step 0.01 --until 1
gives "check: a charged particle" 0 "$motus" check models/charged-particle.motus --json
that "... boris preserves the volume, and is not symplectic" holds '.methods[] | select(.name == "boris") | .preserves == "volume"'
gives "check: a planet" 0 "$motus" check models/kepler.motus --json
that "... verlet is symplectic" holds '.methods[] | select(.name == "verlet") | .preserves == "symplectic"'
gives "check: a driven oscillator" 0 "$motus" check models/driven-oscillator.motus
that "... has no energy" lacks "an energy exists"
cat >"$place/switches.motus" <<'M'
V = 0.5
x'' = -x + 0.6 sign(V - x') - max(x, 1)^1.5
x(0) = 0
x'(0) = 0
M
gives "check: switching surfaces" 0 "$motus" check "$place/switches.motus"
that "... each with what becomes of runs there" says "V - x' = 0, where sign(V - x') changes: steps cross it, since switches are not located unless"
"$motus" check "$place/switches.motus" --set V=1 --json >"$out" 2>"$err"
that "... in JSON" holds '.switches == [{"operation": "sign(V - x'"'"')", "surface": "V - x'"'"' = 0", "count": 1, "located": false, "not_located": "switches are not located unless asked for, since the force may be undefined beyond one", "sliding": "held"}, {"operation": "max(x, 1)", "surface": "x = 1", "count": 1, "located": false, "not_located": "switches are not located unless asked for, since the force may be undefined beyond one", "sliding": "passes"}]'
printf "x'' = -x - 0.1 sign(x')\nx(0) = 1\nx'(0) = 0\n" >"$place/dry.motus"
gives "check: dry friction" 0 "$motus" check "$place/dry.motus"
that "... is located" says "x' = 0, where sign(x') changes: adaptive methods end their steps there; where the force pushes"
that "... and holds" says "back from both sides, the motion is held there"
gives "check for people" 0 "$motus" check models/damped-cubic.motus
that "... says that the velocity is solved in closed form" says "closed form"
for model in models/*.motus; do
    name=$(basename "$model" .motus)
    "$motus" check "$model" --json >"$out" 2>"$err"
    # run takes the methods that check admits, and refuses the others.
    wrong=
    for method in $(jq -r '.methods[] | select(.name != "verlet-literal") | .name + ":" + (.admitted | tostring)' "$out"); do
        timeout 60 "$motus" run "$model" --method "${method%:*}" --until "$(awk -v h="$(sed -n 's/^step *\([0-9.e-]*\).*/\1/p' "$model")" 'BEGIN { print 3 * h }')" -q >/dev/null 2>"$err"
        status=$?
        case ${method#*:}$status in true0 | true1 | false2) ;; *) wrong+="${method%:*}: admitted ${method#*:}, exit status $status; " ;; esac
    done
    that "check and run agree about $name" test -z "$wrong"
    [ -z "$wrong" ] || echo "    $wrong"
done

# --- methods ------------------------------------------------------------------------------------------------------------------------
gives "methods --json" 0 "$motus" methods --json
that "... is JSON" json "$out"
that "... rows with their properties" holds '.methods | length >= 30 and all(.[]; has("name") and has("aliases") and has("title") and has("family") and has("order") and has("stages") and has("evaluations") and has("forces") and has("symplectic") and has("reversible") and has("stability_limit") and (.name == "exact" or (.cite | length > 2)))'
count=$(jq '.methods | length' "$out")
for name in explicit-euler midpoint heun ralston rk3 rk4 rk4-38 symplectic-euler velocity-verlet leapfrog ruth3 forest-ruth pefrl mclachlan4 suzuki4 yoshida6 \
    kahan-li6 yoshida8 kahan-li8 verlet verlet-literal beeman newmark implicit-midpoint gauss4 gauss6 boris exact; do
    that "there is $name" holds ".methods | any(.name == \"$name\")"
done
gives "methods" 0 "$motus" methods
that "... a line for each" eval "[ \$(sed -n '2,/^\$/p' '$out' | grep -c .) = $count ]"
gives "methods --markdown" 0 "$motus" methods --markdown
that "... a row for each" eval "[ \$(grep -c '^| ' '$out') = $((count + 1)) ] && ! grep -qv '^|' '$out'"
gives "a card" 0 "$motus" methods verlet
that "... has formula, properties, reference, use" eval "says formula && says properties && says reference && says 'when to use it'"
gives "a card by alias" 0 "$motus" methods yoshida4
that "... is the method's" says forest-ruth
gives "a card as JSON" 0 "$motus" methods verlet --json
that "... one row" holds '.methods | length == 1 and .[0].name == "verlet"'
refuses "the card of nothing" 2 "verlett" "$motus" methods verlett
that "... with a remedy" says "verlet" "$err"

# --- terminals ----------------------------------------------------------------------------------------------------------------------
if command -v script >/dev/null; then
    terminal() { script -qec "$*" /dev/null </dev/null >"$out" 2>&1; }
    terminal "$motus" run "$osc"
    that "colours on a terminal" grep -q $'\033\[1m' "$out"
    NO_COLOR=1 terminal "$motus" run "$osc"
    that "none with NO_COLOR" eval "! grep -q $'\033' '$out'"
    TERM=dumb terminal "$motus" run "$osc"
    that "none on a dumb terminal" eval "! grep -q $'\033' '$out'"
    terminal "$motus" run "$osc" --until 400000 --machine interpreter
    that "long work shows its progress" grep -q 'run  *[0-9]* %' "$out"
    terminal "$motus" run "$osc" --until 400000 --machine interpreter --quiet
    that "... not with --quiet" eval "! grep -q 'run  *[0-9]* %' '$out'"
    terminal "$motus" run "$osc"
    that "... nor when it is short" eval "! grep -q 'run  *[0-9]* %' '$out'"
fi

echo "$passed passed, $failed failed"
[ $failed = 0 ]
