#!/bin/bash
# Pictures: what gnuplot is told to draw. A program in its place keeps the script, so that these are tests of numbers and names.
#
# Each case is one line `ok` or `not ok`; the last line counts them. MOTUS is the program (build/motus).
cd "$(dirname "$0")/.." || exit 1
. test/cli/cases.sh

mkdir "$place/bin"
script=$place/script
printf '#!/bin/sh\ncat >"%s"\nprintf x\n' "$script" >"$place/bin/gnuplot"
chmod +x "$place/bin/gnuplot"
# name, words of the command
draws() { gives "$1" 0 env PATH="$place/bin:$PATH" "$motus" "${@:2}" -q --plot "$place/fig.svg" --force; }
# The numbers of curve $2 in panel $1, counted from 0.
block() { sed -n "/^\\\$d$1_$2 << END_OF_DATA/,/^END_OF_DATA/p" "$script" | sed '1d;$d'; }
count() { block "$1" "$2" | grep -c .; }
# How many curves of the figure have a name in the key that matches.
keys() { grep -E '^s?plot' "$script" | grep -oE "title '[^']+'" | grep -cE "${1:-.}"; }
one() { [ "$(grep -E "$1" "$script" | sort -u | wc -l)" = 1 ]; }

# --- curves and dots ----------------------------------------------------------------------------------------------------------------
cat >"$place/ball.motus" <<'M'
g = 9.81      # m/s^2
y'' = -g
y(0) = 1      # m
y'(0) = 0     # m is no unit here
E = y'^2/2 + g y # J/kg
method verlet
step 0.125    # s
until 1
M
ball=$place/ball.motus
draws "a ball in eight steps" run "$ball"
that "... falls on a smooth curve" eval "[ $(count 0 0) -gt 1000 ] && block 0 0 | awk '{ d = \$2 - (1 - 9.81*\$1*\$1/2); if (d > 1e-9 || d < -1e-9) exit 1 }'"
that "... with its nine states as dots" eval "[ $(count 0 1) = 9 ] && says \"with points pt 7\" '$script' && [ $(keys steps) = 1 ]"
that "... the axes tell units" eval "says \"'y (m)'\" '$script' && says \"'t (s)'\" '$script'"
that "... no quantities" lacks "E" <(grep -v END "$script")
draws "by a method of first order" run "$ball" --method explicit-euler --error none
that "... from state to state in straight lines" [ "$(count 0 0)" = 9 ]
sed 's/^method/exact y = 1 - g t^2\/2\nmethod/' "$ball" >"$place/exact.motus"
draws "... with the exact motion" run "$place/exact.motus" --method explicit-euler --error none
that "... which stays smooth" eval "[ $(count 0 0) = 9 ] && [ $(count 0 2) -gt 1000 ]"
draws "in a thousand steps" run "$ball" --step 0.001
that "... there are no dots" lacks "'steps'" "$script"
draws "by steps that adapt" run "$ball" --method dop853
that "... with dots" eval "[ $(count 0 1) -gt 2 ] && [ $(count 0 1) -lt 50 ]"
draws "by many of them" run models/pendulum.motus --method dop853 --until 1000 --error none
that "... without, and without a key" eval "[ $(keys steps) = 0 ] && ! grep -q '^set key at' '$script'"
draws "a velocity" run "$ball" --plot-of "t,y'"
that "... whose comment is prose, has the unit of y over that of the time" says "set ylabel 'y'' (m/s)'" "$script"
draws "a quantity and the height" run "$ball" --plot-of "t,E,y"
that "... both" eval "[ $(keys '^title .(E|y).$') = 2 ]"
that "... an axis of two units has neither" says "set ylabel ''" "$script"
refuses "ten columns" 2 "two columns are needed, and 9 are the most" "$motus" run "$ball" --plot-of t,y,y,y,y,y,y,y,y,y --plot "$place/no.svg"
gives "a note" 0 env PATH="$place/bin:$PATH" "$motus" run "$ball" --plot "$place/fig.svg" --force
that "... how to draw a quantity" says '--plot-of "t,E" draws one' "$err"

# --- events -------------------------------------------------------------------------------------------------------------------------
sed 's/^E = .*/when y = 0 falling as bounce: y'"'"' = -0.8 y'"'"', record\nwhen y'"'"' = 0 falling as top: record/' "$ball" >"$place/floor.motus"
draws "a ball on a floor" run "$place/floor.motus" --until 3 --events "$place/events.csv"
marks() { grep -c "^$1," "$place/events.csv"; }
that "... its bounces are marks, and its tops others" eval "[ $(marks bounce) -gt 2 ] && [ $(count 0 2) = $(marks bounce) ] && [ $(count 0 3) = $(marks top) ] && [ $(keys 'bounce|top') = 2 ]"
that "... on the floor" eval "block 0 2 | awk '{ if (\$2 > 1e-9 || \$2 < -1e-9) exit 1 }'"
sed 's/, record//; /top/d' "$place/floor.motus" >"$place/quiet.motus"
draws "events that record nothing" run "$place/quiet.motus" --until 3
that "... are marks without a name" eval "[ $(keys events) = 1 ] && [ $(count 0 2) = $(marks bounce) ]"
draws "a billiard's thousand hits" run models/billiard.motus --until 1832 --error none
that "... are no marks" lacks "'hit'" "$script"

# --- axes ---------------------------------------------------------------------------------------------------------------------------
draws "a comet" run models/comet.motus
that "... the axes of all panels have one width" eval "one '^set lmargin' && one '^set rmargin' && [ $(grep -c '^set lmargin' "$script") = 4 ]"
# Returns whether both axes of the first panel have one scale: numbers per pixel.
equal() {
    tr '[]:,' '    ' <"$script" | awk '/^set terminal/ { w = $5; h = $6 } /^set [lrtb]margin/ { at[$2] = $5 } /^set [xy]range/ { size[$2] = $4 - $3 }
        /^s?plot/ { x = size["xrange"]/(w*(at["rmargin"] - at["lmargin"])); y = size["yrange"]/(h*(at["tmargin"] - at["bmargin"]))
            exit !(x > 0 && x/y > 0.999 && x/y < 1.001) }'
}
that "... one scale" equal
that "... a circle at the start, and an arrow" eval "grep -q \"^set label 1 '' at first -35.07[0-9]*, first -*0 point pt 6\" '$script' && grep -q '^set arrow 1 from .* head filled' '$script'"
that "... the key lies beside the axes" eval "awk '/^set rmargin/ { edge = \$5 } /^set key at screen/ { n++; bad += \$5 + 0 <= edge } END { exit n < 1 || bad }' '$script'"
draws "a plane of position and velocity" run models/pendulum.motus --plot-of "theta,theta'"
that "... has two scales" eval "! grep -q '^set [xy]range' '$script'"
that "... a start" says "set arrow 1 from" "$script"
printf "%s\n" "x'' = -x" "y'' = -4 y" "x(0) = 1   # m" "y(0) = 3   # m" "x'(0) = 1 # m/s" "y'(0) = 0 # [m]" 'method rk4' 'step 0.01' 'until 9' >"$place/two.motus"
draws "a plane of two positions" run "$place/two.motus" --plot-of x,y
that "... has one scale" equal
draws "... of numbers with one unit" run "$place/two.motus" --plot-of "x,y'"
that "... has one scale" equal
draws "... of two units" run "$place/two.motus" --plot-of "x,x'"
that "... has two" eval "! grep -q '^set [xy]range' '$script'"

printf "%s\n" "y'' = -9.81" "q'' = -q" "a'' = -a" "b'' = -b" "y(0) = 1000 # m" "q(0) = 0.01 # m" "a(0) = 800 # rad" "b(0) = 500 # rad" \
    "y'(0) = 0; q'(0) = 0; a'(0) = 0; b'(0) = 0" 'method dop853' 'until 9' >"$place/mixed.motus"
draws "numbers of two units, and one far smaller than another" run "$place/mixed.motus" --error none
that "... in three panels" eval "[ $(grep -c '^plot' "$script") = 3 ] && [ $(grep -c "^set title 'motion'" "$script") = 3 ]"
that "... each with its unit" eval "[ \"\$(grep '^set ylabel' '$script' | cut -d\\' -f2 | tr '\n' ' ')\" = 'y (m) q (m) (rad) ' ]"
that "... with their dots" eval "[ $(count 2 0) -gt 1000 ] && [ $(count 2 1) -lt 150 ] && [ $(count 2 2) = $(count 2 0) ]"
printf "x'' = -x\nx(1e9) = 1\nx'(1e9) = 0\nuntil 1e9 + 20\nmethod rk4\nstep 0.25\n" >"$place/late.motus"
draws "late times" run "$place/late.motus" --error none
that "... differ in the numbers of the axis" says "set format x '%.11g'" "$script"

# --- compare ------------------------------------------------------------------------------------------------------------------------
rows() { sed -n "/^  method .*evaluations/,/^$/p" "$out" | sed '1d;$d'; }
gives "compare" 0 "$motus" compare models/spring.motus
that "... a dozen methods" eval "[ \$(rows | wc -l) = 12 ] && says '12 of 36 methods'"
that "... the model's own" eval "rows | grep -q '^  symplectic-euler '"
that "... some of each family" eval "rows | grep -q '^  beeman ' && rows | grep -q '^  rk4 ' && rows | grep -q '^  gauss8 ' && rows | grep -q '^  kahan-li8 '"
that "... not those that others of their family beat" eval "! rows | grep -qE '^  (suzuki4|explicit-euler|newmark)'"
gives "compare for a narrow terminal" 0 "$motus" compare models/kepler.motus
that "... is 80 columns wide" eval "! grep -qE '.{81}' '$out'"
gives "all of it" 0 "$motus" compare models/kepler.motus --all
that "... is too" eval "! grep -qE '.{81}' '$out'"
gives "compare --all" 0 "$motus" compare models/spring.motus --all
that "... every method" eval "[ \$(rows | wc -l) = 36 ] && lacks 'methods:'"
gives "compare --methods" 0 "$motus" compare models/spring.motus --methods suzuki4,heun
that "... those" eval "[ \$(rows | wc -l) = 2 ]"
gives "compare --json" 0 "$motus" compare models/spring.motus --json
that "... has every method" holds '.rows | length == 36'
gives "compare --accuracies" 0 "$motus" compare models/spring.motus --accuracies 1e-3:1e-5
that "... shows a dozen, and the cheapest" eval "[ \$(rows | wc -l) = 0 ] && [ \$(sed -n '/^Evaluations/,/^$/p' '$out' | wc -l) -le 16 ] && says 'the best of each family by work'"
draws "a comparison" compare models/spring.motus --methods verlet,rk4
that "... the motions lie over their errors" eval "[ $(grep -c '^plot' "$script") = 3 ] && says 'set logscale y' '$script' && says 'error of x at the steps, from exact' '$script'"
that "... with one key" [ "$(grep -c '^set key' "$script")" = 1 ]
gives "its numbers" 0 "$motus" compare models/spring.motus --methods verlet,rk4 --json
that "... the errors are those of the table" eval "block 1 0 | awk -v most=$(jq .rows[0].error_max "$out") '{ if (\$2 > m) m = \$2 } END { exit !(m/most > 0.98 && m/most < 1.02) }'"
that "... and at the end" eval "block 1 1 | tail -n 1 | awk -v end=$(jq .rows[1].error_final "$out") '{ exit !(\$1 == 60 && \$2/end > 0.999 && \$2/end < 1.001) }'"
draws "one against a reference" compare models/pendulum.motus --methods verlet,rk4
that "... that is named" eval "grep -q 'error of theta at the steps, from gauss8' '$script'"
gives "its numbers" 0 "$motus" compare models/pendulum.motus --methods verlet,rk4 --json
that "... the errors are those of the table" eval "block 1 0 | awk -v most=$(jq .rows[0].error_max "$out") '{ if (\$2 > m) m = \$2 } END { exit !(m/most > 0.98 && m/most < 1.02) }'"
printf "x'' = 0\nx(0) = 0\nx'(0) = 0\nstep 0.1\nuntil 1\n" >"$place/rest.motus"
draws "errors that are all 0" compare "$place/rest.motus" --methods verlet
that "... say so" says "every number is 0" "$script"
gives "... to gnuplot too" 0 "$motus" compare "$place/rest.motus" --methods verlet -q --plot "$place/rest.svg"
draws "a comparison of a family" compare models/chain.motus --methods verlet,rk4
that "... draws the cell that moves furthest" eval "says 'error of x[16] at the steps' '$script' && says 'x[16]' '$script'"
that "... changes of the energy of 1e-6 and 1e-12 in one panel" [ "$(grep -c '^set logscale y' "$script")" = 2 ]
draws "a comparison of all" compare models/spring.motus --all
that "... draws a dozen and the exact motion" [ "$(grep '^plot' "$script" | head -n 1 | grep -o "title '[^']" | wc -l)" = 13 ]
draws "orders" converge models/damped-cubic.motus
that "... of a dozen methods" [ "$(keys)" = 12 ]
draws "orders of methods that become unstable" converge models/ueda.motus --methods verlet,rk4
that "... end little above the errors on the slopes" eval "sed -n 's/^set yrange .:\(.*\)]$/\1/p' '$script' | awk '{ n++; if (!(\$1 > 1 && \$1 < 1e4)) exit 1 } END { exit n != 1 }'"

# --- sweeps and sections ------------------------------------------------------------------------------------------------------------
spring="models/damped-spring.motus --set F=1 --record max(x),energy -o $place/rows.csv --force"
rows() { grep -v '^#' "$place/rows.csv" | tail -n +2; }
that "a picture alone prints no rows" eval "env PATH='$place/bin:$PATH' '$motus' sweep models/damped-spring.motus --set F=1 --vary omega=3,1,2 --plot '$place/fig.svg' --force >'$out' 2>'$err' && says '3 trajectories' && ! grep -q '^0,' '$out' '$err' && lacks /dev/null"
draws "a resonance curve" sweep $spring --vary omega=3,1,2
that "... is what the rows have, in the order of the frequencies" eval "diff <(block 0 0) <(rows | sort -t, -k2 -g | awk -F, '{ printf \"%.12g %.10g\n\", \$2, \$3 }')"
that "... a panel for each record" eval "[ $(grep -c '^plot' "$script") = 2 ] && says \"'omega'\" '$script' && says \"'max(x)'\" '$script'"
that "... dots for three" [ "$(count 0 1)" = 3 ]
draws "one record of them" sweep $spring --vary omega=1:2:400 --plot-of "omega,max(x)"
that "... alone" eval "[ $(grep -c '^plot' "$script") = 1 ] && [ $(count 0 0) = 400 ] && [ $(keys trajectories) = 0 ]"
draws "a family of curves" sweep $spring --vary omega=1:2:5 --vary gamma=0.1,0.2 --plot-of "omega,max(x)"
that "... one for each value of the second number" eval "[ $(keys 'gamma = 0.[12]') = 2 ] && [ $(count 0 0) = 5 ] && [ $(count 0 2) = 5 ]"
draws "a map" sweep $spring --vary omega=1:2:11 --vary gamma=0.1:0.9:9 --plot-of "omega,max(x)"
that "... omega to the right, gamma upwards" eval "[ \"\$(sed -n '/^.heat0 /,/^END/p' '$script' | sed '1d;\$d' | tr ' ' '\n')\" = \"\$(rows | sort -t, -k3,3g -k2,2g | awk -F, '{ printf \"%.6g\n\", \$4 }')\" ]"
draws "random numbers" sweep $spring --random gamma=0.1:0.9 --count 50 --plot-of "gamma,max(x)"
that "... are points without a line" eval "[ $(count 0 0) = 50 ] && grep -q '^plot .d0_0 using 1:2 with points' '$script' && [ $(grep -c linespoints "$script") = 0 ]"
draws "errors of a sweep" sweep models/pendulum.motus --method rk4 --step 0.5 --vary "theta(0)=1:2:5" --errors -o "$place/rows.csv" --force
that "... are a band" eval "grep -q '^.b0_0 ' '$script'"
draws "with a unit" sweep models/thrown-ball-air.motus --vary m=1:2:5 -o "$place/rows.csv" --force
that "... of the number and of the record" eval "says \"'m (kg)'\" '$script' && says \"'r.x (m)'\" '$script' && lacks \"r'\" <(grep plot '$script')"
refuses "what is not varied" 2 "x is not varied" "$motus" sweep $spring --vary omega=1,2 --plot-of "x,max(x)" --plot "$place/no.svg"
refuses "what is not recorded" 2 "min(x) is not recorded" "$motus" sweep $spring --vary omega=1,2 --plot-of "omega,min(x)" --plot "$place/no.svg"
refuses "nothing but the step" 2 "--plot-of omega: two numbers are needed" "$motus" sweep $spring --vary omega=1,2 --plot-of omega --plot "$place/no.svg"
printf "%s\n" "x' = 10 (y - x)" "y' = x (28 - z) - y" "z' = x y - 8/3 z" 'x(0) = 1; y(0) = 1; z(0) = 20' 'until 20' >"$place/lorenz.motus"
draws "a section of first-order variables" run "$place/lorenz.motus" --method dop853 --section "z = 27 rising" --error none
that "... in the plane of the others" eval "says \"set xlabel 'x'\" '$script' && says \"set ylabel 'y'\" '$script'"
draws "a section that names two of three" run "$place/lorenz.motus" --method dop853 --section "z = 27 + y" --error none
that "... is drawn against the time" eval "says \"set xlabel 't'\" '$script' && says \"set ylabel 'x'\" '$script'"
draws "a section of a position that has a first-order variable beside it" run models/van-der-pol.motus --section "x = 0" --error none
that "... is drawn against the time, since it fixes the position" eval "says \"'t'\" '$script' && says \"x''\" '$script'"
draws "points at times that differ late" run "$place/late.motus" --section "x = 0" --error none
that "... have few long numbers" eval "grep -q '^set xtics [0-9]' '$script'"
draws "a section in space" run models/penning-trap.motus --section "r.x = 0 rising" --error none
that "... is drawn in the plane of the next component" eval "says \"set xlabel 'r.y'\" '$script' && says \"set ylabel 'r''.y'\" '$script'"
draws "a section of a family" run models/chain.motus --section "x[1] = 0 rising" --error none
that "... has the first number that it does not name" says "set xlabel 'x[2]'" "$script"

echo "$passed passed, $failed failed"
[ $failed = 0 ]
