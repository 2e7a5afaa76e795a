#!/bin/bash
# Events in the program: their table in print, in JSON and as CSV, both sides of what they change, and times that are known.
#
# Each case is one line `ok` or `not ok`; the last line counts them. MOTUS is the program (build/motus).
cd "$(dirname "$0")/.." || exit 1
. test/cli/cases.sh

# The rows of a CSV, without its comment and its head.
rows() { grep -v '^#' "$1" | tail -n +2; }
head_of() { grep -v '^#' "$1" | head -n 1; }

# --- a ball that bounces ------------------------------------------------------------------------------------------------------------
cat >"$place/ball.motus" <<'M'
g = 9.81
h = 1
e = 0.8
y'' = -g
y(0) = h
y'(0) = 0
when y = 0 falling as bounce: y' = -e y', record
energy = y'^2/2 + g y
method verner9
until 5
M
ball=$place/ball.motus

gives "a run with events" 0 "$motus" run "$ball" --error none
that "... says where they accumulate" eval "grep -qE '^bounces accumulate at t = 4\.06371276887[0-9]*\([0-9]+\)$' '$out'"
that "... and so what ended it" lacks "ended the run"
that "... no step was shortened" lacks "the last one"
that "... the first ten" eval "[ \$(grep -cE '^  bounce +[0-9.]+ +([1-9]|10)  ' '$out') = 10 ]"
that "... and the last three" eval "[ \$(grep -cE '^  bounce +4\.0637127688' '$out') = 3 ]"
that "... how many are left out" says "… 122 more"
that "... and where they are" says "--events FILE writes all events"
that "... with the state on arrival" eval "grep -qE '^  bounce +0\.451523640985730[89] +1 +[^ ]+ +-4\.429446918' '$out'"

that "... which is before the end" says "the run ends there, before t = 5: \`when bounce accumulates: …\` says how it goes on"
gives "the events as CSV" 0 "$motus" run "$ball" --error none --events "$place/events.csv" --quiet
that "... say nothing else" empty "$out"
that "... have a head" eval "[ \"\$(head_of '$place/events.csv')\" = \"event,t,count,touched,y,y',energy,y.after,y'.after,energy.after\" ]"
that "... and 135 rows" eval "[ \$(rows '$place/events.csv' | wc -l) = 135 ]"
that "... of which each turns the velocity" eval "rows '$place/events.csv' | awk -F, '{ d = \$9 + 0.8 * \$6; if (d < 0) d = -d; if (!(\$6 < 0 && d <= 1e-15 * -\$6 && \$8 == \$5)) { print; bad = 1 } } END { exit bad }'"
that "... which begin with the command" eval "head -n 1 '$place/events.csv' | grep -q '^# motus run '"

# Bounce n is at t_1 + 2 v_1/g (e + e^2 + ... + e^(n-1)), v_1 the speed of the first impact: in 60 digits, cut after 18.
cat >"$place/truth" <<'T'
0.451523640985730904 1.173961466562900351 1.751911727024635909 2.214271935394024355 2.584160102089535112
2.880070635445943717 3.116799062131070602 3.306181803479172109 3.457687996557653315 3.578892951020438280
3.675856914590666252 3.753428085446848630 3.815485022131794532 3.865130571479751253 3.904847010958116630
3.936620162540808932 3.962038683806962774 3.982373500819885847 3.998641354430224305 4.011655637318495072
4.022067063629111686 4.030396204677604976 4.037059517516399609 4.042390167787435315 4.046654688004263880
4.050066304177726732 4.052795597116497013 4.054979031467513239 4.056725778948326219 4.058123176932976603
4.059241095320696910 4.060135430030873156 4.060850897799014153 4.061423272013526950 4.061881171385137188
4.062247490882425378 4.062540546480255931 4.062774990958520372 4.062962546541131926 4.063112591007221169
4.063232626580092563 4.063328655038389678 4.063405477805027370 4.063466936018337524 4.063516102588985647
4.063555435845504146 4.063586902450718945 4.063612075734890784 4.063632214362228255 4.063648325264098232
4.063661213985594213 4.063671524962790999 4.063679773744548427 4.063686372769954369 4.063691651990279123
4.063695875366538927 4.063699254067546769 4.063701957028353043 4.063704119396998063 4.063705849291914078
4.063707233207846890 4.063708340340593140 4.063709226046790140 4.063709934611747740 4.063710501463713820
4.063710954945286684 4.063711317730544975 4.063711607958751608 4.063711840141316914 4.063712025887369159
4.063712174484210955 4.063712293361684392 4.063712388463663142 4.063712464545246141 4.063712525410512541
4.063712574102725661 4.063712613056496156 4.063712644219512553 4.063712669149925670 4.063712689094256164
4.063712705049720559 4.063712717814092075 4.063712728025589288 4.063712736194787058 4.063712742730145275
4.063712747958431848 4.063712752141061106 4.063712755487164513 4.063712758164047238 4.063712760305553418
4.063712762018758363 4.063712763389322318 4.063712764485773482 4.063712765362934414 4.063712766064663159
4.063712766626046155 4.063712767075152552 4.063712767434437669 4.063712767721865763 4.063712767951808239
T
# Differences in units of 1e-18, of which halves of a number with 18 decimals are exact; 4 units in the last place.
cat >"$place/near.awk" <<'A'
function low(s) { sub(/^[0-9]*\./, "", s); return substr(s "000000000000000000", 10, 9) }
function high(s) { return int(s) * 1e9 + substr(substr(s, index(s, ".") + 1) "000000000", 1, 9) }
NR == FNR { for (k = 1; k <= NF; k++) truth[++known] = $k; next }
FNR <= 100 {
    off = (high($2) - high(truth[FNR])) * 1e9 + (low($2) - low(truth[FNR]))
    ulp = $2 < 0.5 ? 2^-54 : $2 < 1 ? 2^-53 : $2 < 2 ? 2^-52 : $2 < 4 ? 2^-51 : 2^-50
    units = (off < 0 ? -off : off) * 1e-18 / ulp
    if (units > most) most = units
    seen++
}
END { printf "%d bounces, at most %.2f units off\n", seen, most; exit !(seen == 100 && known == 100 && most <= 4) }
A
that "100 bounces to 4 units in the last place" eval "rows '$place/events.csv' | sed 's/,/ /g' | awk -f '$place/near.awk' '$place/truth' -"

"$motus" run "$ball" --events "$place/loud.csv" >"$out" 2>"$err"
gives "the events of a quiet run" 0 "$motus" run "$ball" --events "$place/quiet.csv" --quiet
that "... are the same, with the errors of their times" eval "diff <(rows '$place/loud.csv') <(rows '$place/quiet.csv') && head_of '$place/quiet.csv' | grep -q '^event,t,t.error,'"

gives "the events as JSON" 0 "$motus" run "$ball" --error none --json
that "... are JSON" json "$out"
that "... all of them" holds '.events | length == 135'
that "... in order" holds '[.events[].time] | . == sort'
that "... with counts and states" holds '.events[2] | .name == "bounce" and .count == 3 and .touched == false and .error == null and (.state | keys) == ["energy", "y", "y'\''"]'
that "... and what ended the run" holds '.ended == "bounce"'
that "... at the limit, within its error" holds '.accumulated | .error < 1e-12 and (.time - 4.063712768871578 | fabs) <= .error'
cp "$out" "$place/run.json"
that "... the numbers are those of the CSV" eval "diff <(jq -r '.events[] | [.time, .state.y, .state[\"y'\''\"]] | @csv' '$place/run.json' | awk -F, '{ printf \"%.17g %.17g %.17g\\n\", \$1, \$2, \$3 }') <(rows '$place/events.csv' | awk -F, '{ printf \"%.17g %.17g %.17g\\n\", \$2, \$5, \$6 }')"

sed 's/record/record, stop after 3/' "$ball" >"$place/three.motus"
gives "an event that stops" 0 "$motus" run "$place/three.motus" --error none --method rk4 --step 0.03
that "... says so" eval "grep -qE '^bounce ended the run at t = 1\.7519117270246' '$out'"
that "... with all its events" lacks "--events FILE"
that "... no step was shortened" lacks "the last one"
gives "... in JSON" 0 "$motus" run "$place/three.motus" --error none --json
that "... too" holds '.ended == "bounce" and .accumulated == null and (.events | length) == 3'

cat >"$place/touch.motus" <<'M'
y'' = -2
y(0) = 0
y'(0) = 2
when y = 1 as top: record
when y = 0.5: record
method dop853
until 3
M
gives "a touch" 0 "$motus" run "$place/touch.motus" --error none
that "... is called so" eval "grep -qE '^  top +(1|0\.9999999999[0-9]*) +1  touched ' '$out'"
that "... and only it" eval "[ \$(grep -c '  touched  *[01]' '$out') = 1 ]"
gives "... in the CSV" 0 "$motus" run "$place/touch.motus" --error none --quiet --events -
that "... too" eval "rows '$out' | cut -d, -f1,3,4 | tr '\n' ' ' | grep -q '^event2,1,0 top,1,1 event2,2,0 $'"

cat >"$place/third.motus" <<'M'
n = 0
x'' = -x
x(0) = 1
x'(0) = 0
when x = 0: n = n + 1
when n == 3 as third: stop
when x == 0 as zero: record
until 100
M
gives "an event where a mode is equal to a number" 0 "$motus" run "$place/third.motus" --json
that "... happens, at 5 pi/2" holds '.ended == "third" and (.events | length) == 3 and (.events[2].time - 7.853981633974483 | fabs) < 1e-12'

gives "a run that events ended within a step" 0 "$motus" run "$ball" --error none --method rk4 --step 0.03 --save-state "$place/ended.state" -q
that "... is saved" [ -s "$place/ended.state" ]

# --- the stadium, as the comment of the billiard says it ------------------------------------------------------------------------------
awk -v q="'" '/^#     n = /  { sub(/^# +/, ""); sub(/  +from .*/, ""); wall = $0; next }
     /^#     when / { sub(/^# +/, ""); hit = $0; next }
     /^r\(0\)/      { print "r(0) = (0.2, 0.1)"; next }
     /^r.\(0\)/     { print "r" q "(0) = (0.8, 0.6)"; next }
     /^when/        { print wall; print hit; next }
     /^along|^invariant angular/ { next }
     { print }' models/billiard.motus >"$place/stadium.motus"
gives "the stadium" 0 "$motus" run "$place/stadium.motus"
that "... says after which hit no digit is left" eval "n=\$(sed -n 's/^  no digit of an event is known to be significant after hit number //p' '$out'); [ \"\$n\" -ge 32 ] && [ \"\$n\" -le 44 ]"
gives "... in JSON" 0 "$motus" run "$place/stadium.motus" --json
that "... too" holds '.events_significant >= 32 and .events_significant <= 44 and .events[.events_significant].error == null and .events[.events_significant - 1].error > 0'
that "... hits within their bars" holds '[[1, 1.408492607088319165], [10, 16.94038997256210474], [20, 39.19316993526689108], [30, 54.99452047218082444]] as $t | . as $r | $t | all(. as [$n, $want] | $r.events[$n - 1] | (.time - $want | fabs) <= .error)'
gives "a ball by a method of order 1" 0 "$motus" run models/bouncing-ball.motus --method symplectic-euler
that "... does not fall through the floor, and tells no limit" says "bounces accumulate; no digit of their limit is known to be significant"

# --- both sides of a jump -----------------------------------------------------------------------------------------------------------
# Between ordinary rows stand the state on arrival and the one after the action; the next ordinary row at that time is not written twice.
sed 's/record/record, stop after 2/; /^energy/d' "$ball" >"$place/two.motus"
sides='0 0.25 0.451523640986 0.451523640986 0.5 0.75 1 1.17396146656 1.17396146656'
for how in "dop853" "verner9" "rk4 --step 0.1" "gauss8 --step 0.02" "verlet --step 1/64"; do
    # shellcheck disable=SC2086
    gives "rows by $how" 0 "$motus" run "$place/two.motus" --method $how --error none --every 0.25 --quiet -o -
    that "... with both sides of jumps" eval "[ \"\$(rows '$out' | awk -F, '{ printf \"%s%.12g\", (NR > 1 ? \" \" : \"\"), \$1 }')\" = '$sides' ]"
    that "... on arrival first" eval "rows '$out' | awk -F, 'NR > 1 && \$1 == t { n++; d = \$3 + 0.8 * v; if (!(v < 0 && d < 1e-14 && d > -1e-14)) bad = 1 } { t = \$1; v = \$3 } END { exit !(n == 2 && !bad) }'"
done
gives "rows of every step" 0 "$motus" run "$place/two.motus" --method dop853 --error none --quiet -o -
that "... hold each state once" eval "[ -z \"\$(rows '$out' | sort | uniq -d)\" ] && [ \"\$(rows '$out' | cut -d, -f1 | uniq -d | wc -l)\" = 2 ]"
that "... in the order of time" eval "rows '$out' | cut -d, -f1 | sort -cg"
gives "rows backward" 0 bash -c "sed 's/until 5/until -3/; s/-e y/-y/' '$place/two.motus' | '$motus' run - --error none --every 0.3 --quiet -o -"
that "... in the order of time" eval "rows '$out' | cut -d, -f1 | sort -cgr && [ \"\$(rows '$out' | cut -d, -f1 | uniq -d | wc -l)\" = 2 ]"
gives "rows with errors" 0 "$motus" run "$place/two.motus" --errors --every 0.25 --quiet -o -
that "... know none at jumps" eval "[ \"\$(rows '$out' | awk -F, 'NR > 1 && \$1 == t { print \$4 before } { t = \$1; before = \$4 }' | tr '\n' ' ')\" = 'nannan nannan ' ]"
# An event without a row in the table has its sides all the same; so has a counter, on which no motion depends.
sed 's/record, //' "$place/two.motus" >"$place/silent.motus"
for how in "dop853" "rk4 --step 0.1" "verlet --step 1/64"; do
    # shellcheck disable=SC2086
    gives "rows without a table by $how" 0 bash -c "diff <('$motus' run '$place/two.motus' --method $how --error none --every 0.25 --quiet -o - | grep -v '^#') <('$motus' run '$place/silent.motus' --method $how --error none --every 0.25 --quiet -o - | grep -v '^#')"
done
printf '%s\n' 'n = 0' "x'' = -x" 'x(0) = 1' "x'(0) = 0" 'when x = 0: n = n + 1' 'method verlet' 'step 1/64' 'until 5' >"$place/counts.motus"
gives "rows of a counter" 0 "$motus" run "$place/counts.motus" --error none --every 1 --quiet --columns t,n -o -
that "... have both sides" eval "[ \"\$(rows '$out' | awk -F, '{ printf \"%.3g %s \", \$1, \$2 }')\" = '0 0 1 0 1.57 0 1.57 1 2 1 3 1 4 1 4.71 1 4.71 2 5 2 ' ]"
gives "... no further ones in other columns" 0 "$motus" run "$place/counts.motus" --error none --every 1 --quiet --columns t,x -o -
that "... stand there" eval "[ \$(rows '$out' | wc -l) = 6 ]"
if command -v gnuplot >/dev/null; then
    gives "a plot of a velocity that jumps" 0 "$motus" run "$place/two.motus" --error none --quiet --plot-of "t,y'" --plot "$place/jump.svg"
    that "... draws no line between the sides" eval "[ \"\$(tr '\n' ' ' <'$place/jump.svg' | grep -oE \"<path stroke='rgb\( *29, *78, *216\)' +d='[^']{200,}'\" | wc -l)\" = 2 ]"
fi

# --- events from the command line ---------------------------------------------------------------------------------------------------
gives "events of the command line" 0 "$motus" run "$ball" --method dop853 --error none --quiet --events - --when "y' = 0 falling as top: record" --when "when y < 0.05 as low: stop after 2"
that "... happen" eval "[ \"\$(rows '$out' | cut -d, -f1,3 | tr '\n' ' ')\" = 'bounce,1 top,1 ' ]"
that "... where they should" eval "rows '$out' | awk -F, '\$1 == \"top\" { d = \$5 - 0.64; exit !(d < 4e-16 && d > -4e-16) }'"
gives "check knows them" 0 "$motus" check "$ball" --when "y' = 0 as top: record" --json
refuses "a name that the model has not" 2 "--when:1:5: q is not defined" "$motus" run "$ball" --when "y = q: record"
that "... is shown in the option's text" says "    y = q: record" "$err"
refuses "no event" 2 "this is no event" "$motus" run "$ball" --when ""
refuses "two events in one" 2 "this is more than one event" "$motus" run "$ball" --when "y = 1: record; y = 2: record"
refuses "a name that is taken" 2 "two events are named bounce" "$motus" run "$ball" --when "y = 1 as bounce: record"

# Hénon and Heiles: points 1, 10 and 50 of the section x = 0, x' > 0 from (0, -0.25, 0.42, 0), by two codes in 30 digits.
henon=models/henon-heiles.motus
gives "a section" 0 "$motus" run $henon --method dop853 --tolerance 1e-14 --until 332 --section "x = 0 rising" --error none --quiet --columns "y,y'" --events "$place/section.csv"
that "... has its points" eval "rows '$place/section.csv' | awk -F, 'BEGIN { want[1] = \"7.347877788393735666 -0.173162923756184781672 0.280409669564646432067\"; want[10] = \"67.59198267655077 0.190151322181840301876 0.425023397021007371812\"; want[50] = \"331.1385598348059555 0.136512411876635262979 0.38798303504327030978\" }
    \$3 in want { split(want[\$3], w, \" \"); for (k = 1; k <= 3; k++) { d = (k == 1 ? \$2 : k == 2 ? \$5 : \$6) - w[k]; if (d > 1e-8 || d < -1e-8) { print \$0; bad = 1 } } n++ } END { exit bad || n != 3 }'"
gives "a section that ends" 0 "$motus" run $henon --method dop853 --until 500 --section "x = 0 rising" --skip 2 --points 3 --error none
that "... says so" says "section ended the run at t = 31.68"
that "... after all its points" eval "[ \$(awk '/^  event /{ part++ } part == 1 && /^  section /{ n++ } END { print n }' '$out') = 5 ]" # a wide table has parts
if command -v gnuplot >/dev/null; then
    gives "a section is drawn" 0 "$motus" run $henon --method dop853 --until 500 --section "x = 0 rising" --skip 2 --points 3 --error none --quiet --plot "$place/section.svg"
    that "... its points alone" says "where x = 0 rising: 3 points" "$place/section.svg"
    that "... in the plane of the other number" eval "grep -q '>y</tspan>\|>y<' '$place/section.svg' && grep -q \">y'<\" '$place/section.svg'"
    gives "a section in another plane" 0 "$motus" run $henon --method dop853 --until 100 --section "x = 0 rising" --error none --quiet --plot-of "t,x'" --plot "$place/plane.svg"
    that "... has its axes" eval "grep -q \">x'<\" '$place/plane.svg' && grep -q '>t<' '$place/plane.svg'"
    gives "a section that fixes the velocity" 0 "$motus" run "$ball" --section "y' = 0 falling" --error none --quiet --plot "$place/tops.svg"
    that "... is drawn against the time" eval "grep -q '>t<' '$place/tops.svg' && grep -q '>y<' '$place/tops.svg' && lacks \">y'<\" '$place/tops.svg'"
    gives "a section of a vector" 0 "$motus" run models/kepler.motus --section "r.x = 0" --error none --quiet --plot "$place/half.svg"
    that "... is drawn in the plane of the other component and its velocity" eval "grep -q '>r.y<' '$place/half.svg' && grep -q \">r'.y<\" '$place/half.svg'"
    refuses "a section that is cut off" 2 '--section "x =" is not what may stand before the colon of an event' "$motus" run $henon --section "x ="
    refuses "a section that is no event" 2 "an event happens when a condition becomes true" "$motus" run $henon --section "x"
    that "... is shown without what the program adds" lacks "as section" "$err"
    refuses "a semicolon in an event" 2 "a comma joins what an event does" "$motus" run $henon --when "x = 0: y = 0; record"
    refuses "a section without a point" 2 "none is left to draw" "$motus" run $henon --method dop853 --until 10 --section "x = 0 rising" --skip 9 --error none --plot "$place/none.svg"
    that "... leaves no file" absent "$place/none.svg"
fi
# --- sections of sweeps -------------------------------------------------------------------------------------------------------------
# A point for each number of a bifurcation diagram: a rotor whose velocity is the parameter passes pi/2 at pi/(2 w).
printf '%s\n' 'w = 1' "x'' = 0" 'x(0) = 0' "x'(0) = w" 'method verlet' 'step 0.125' 'until 4' >"$place/turn.motus"
turn=$place/turn.motus
gives "events of a sweep from the command line" 0 "$motus" sweep "$turn" --vary "w=1,2,3" --when "x = pi/2 rising as quarter: record, stop" --events "$place/turns.csv" -o "$place/sweep.csv" --quiet
that "... of each trajectory" eval "[ \"\$(rows '$place/turns.csv' | awk -F, '{ d = \$3 - atan2(1, 0)/(\$1 + 1); print \$1, \$2, (d < 1e-15 && d > -1e-15) }' | tr '\n' ' ')\" = '0 quarter 1 1 quarter 1 2 quarter 1 ' ]"
gives "a sweep that records what an event keeps" 0 "$motus" sweep "$turn" --vary "w=1,2" --when "x = pi/2 rising as quarter: record" --record "count(quarter)" --events "$place/kept.csv" --quiet
that "... its table of events has no column of that" eval "[ \"\$(head_of '$place/kept.csv')\" = \"\$(head_of '$place/turns.csv')\" ]"
refuses "another event over the rows of the first" 2 "" "$motus" sweep "$turn" --vary "w=1,2,3" --when "x = pi/3 rising as quarter: record, stop" -o "$place/sweep.csv" --resume
refuses "a picture of a part" 2 "exclude each other" "$motus" sweep "$turn" --vary "w=1,2" --section "x = 1" --plot "$place/none.svg" -o "$place/unwritten.csv" --resume
if command -v gnuplot >/dev/null; then
    gives "a section of a sweep is drawn" 0 "$motus" sweep "$turn" --vary "w=1:3:21" --section "every 1" --skip 1 --points 2 --plot "$place/many.svg" -o "$place/many.csv" --quiet
    that "... with the points that are wanted" says "where every 1: 42 points of 21 trajectories" "$place/many.svg"
    that "... a colour for each trajectory" eval "[ \"\$(grep -oE \"<use xlink:href='#gpDot[^>]*|<use [^>]*color='[^']*'|fill='rgb[^']*'\" '$place/many.svg' | grep -o 'rgb([^)]*)' | sort -u | wc -l)\" -ge 21 ]"
    that "... and their scale" eval "grep -q '>w<\|>w</tspan>' '$place/many.svg'"
    gives "a bifurcation diagram is drawn" 0 "$motus" sweep "$turn" --vary "w=1:3:21" --section "every 1" --plot-of "w,x" --plot "$place/fork.svg" -o "$place/fork.csv" --quiet
    that "... with the varied number as abscissa" eval "grep -q '>w<\|>w</tspan>' '$place/fork.svg' && grep -q '>x<\|>x</tspan>' '$place/fork.svg'"
    that "... in one colour" lacks "palette" "$place/fork.svg"
    refuses "a plane of varied numbers" 2 "one must be of the motion" "$motus" sweep "$turn" --vary "w=1,2" --vary "x(0)=0,1" --section "every 1" --plot-of "w,x(0)" --plot "$place/none.svg" -o "$place/unwritten.csv"
    refuses "no point of a sweep" 2 "there are no points left to draw" "$motus" sweep "$turn" --vary "w=1,2" --section "x = 100" --plot "$place/none.svg" -o "$place/unwritten.csv" --force
    refuses "two files of one name" 2 "is named for two outputs" "$motus" sweep "$turn" --vary "w=1,2" --section "every 1" --plot "$place/none.svg" -o "$place/none.svg"
fi
refuses "points of no section" 2 "--points needs --section" "$motus" run $henon --points 3
refuses "an event in the text of a section" 2 "write an equation or a comparison alone" "$motus" run $henon --section "x = 0: record"
refuses "a link with an event" 2 "--share and --when exclude each other" "$motus" run "$ball" --when "y = 1: record" --share

# --- continued runs -----------------------------------------------------------------------------------------------------------------
cat >"$place/kicks.motus" <<'M'
n = 0
late = time(low, last)
x'' = -x - 0.1 x'
x(0) = 1
x'(0) = 0
when x = 0 rising as up: n = n + 1, record
when x < -0.4 as low: record
when every 0.3 as kick: x' = x' + 0.01, record
M
for half in 4.2 4.237; do # on a time of the grid, and between two
    for method in verlet rk4 gauss6; do
        kicks="$place/kicks.motus --method $method --step 0.01 --error none --quiet"
        "$motus" run $kicks --until $half --save-state "$place/kicks.state" --force --events "$place/first.csv"
        gives "a continued run with events, $method from $half" 0 "$motus" run $kicks --until 9.5 --restart "$place/kicks.state" --events "$place/second.csv" --force
        "$motus" run $kicks --until 9.5 --events "$place/whole.csv" --force
        that "... has the table of the whole run" eval "diff <(grep -v '^# motus' '$place/second.csv' | tail -n +2) <(grep -v '^# motus' '$place/whole.csv' | tail -n +2)"
        that "... which is longer than that of the first" eval "[ \$(rows '$place/whole.csv' | wc -l) -gt \$(rows '$place/first.csv' | wc -l) ]"
    done
done
sed 's/rising as up/falling as up/' "$place/kicks.motus" >"$place/other.motus"
refuses "the state of a run with other events" 2 "belongs to another model" "$motus" run "$place/other.motus" --method gauss6 --step 0.01 --until 9.5 --restart "$place/kicks.state"
"$motus" run "$place/kicks.motus" --method dop853 --until 5 --save-state "$place/kicks.state" --force --quiet
gives "the errors of a continued run" 0 "$motus" run "$place/kicks.motus" --method dop853 --until 9.5 --restart "$place/kicks.state" --events "$place/second.csv" --force
that "... cover all its events" eval "rows '$place/second.csv' | awk -F, '{ n++ } !(\$3 > 0 && \$3 < 1e-4) { exit 1 } END { exit n < 30 }'"

# --- sweeps -------------------------------------------------------------------------------------------------------------------------
cat >"$place/flock.motus" <<'M'
e = 0.8
k = 0
y'' = -9.81 - k y' |y'|
y(0) = 1
y'(0) = 0
n = 0
when y = 0 falling as hit: y' = -e y', n = n + 1, record
when y' = 0 falling as top: record, stop after 6
M
flock="$place/flock.motus --vary e=0.5:0.9:9 --vary k=0,0.1,0.3 --method rk4 --step 0.01 --until 3 --quiet"
gives "the events of a sweep" 0 "$motus" sweep $flock -o "$place/rows.csv" --events "$place/flock.csv" --threads 1
that "... have a head" eval "[ \"\$(head_of '$place/flock.csv')\" = \"index,event,t,count,touched,y,y',n,y.after,y'.after,n.after\" ]"
that "... of all trajectories" eval "[ \"\$(rows '$place/flock.csv' | cut -d, -f1 | uniq | tr '\\n' ' ')\" = \"\$(seq -s ' ' 0 26) \" ]"
same_as_run() { # number, settings of one trajectory
    "$motus" run "$place/flock.motus" --set "$2" --set "$3" --method rk4 --step 0.01 --until 3 --quiet --error none --events "$place/one.csv" --force &&
        diff <(rows "$place/flock.csv" | grep "^$1," | cut -d, -f2-) <(rows "$place/one.csv")
}
that "... the first those of a run" same_as_run 0 e=0.5 k=0
that "... and others" same_as_run 17 e=0.75 k=0.3
for how in "--threads 2" "--machine interpreter" "--machine compiled --threads 2"; do
    gives "the same with $how" 0 "$motus" sweep $flock $how -o "$place/again.csv" --events "$place/flock2.csv" --force
    that "... has the same bytes" cmp "$place/flock.csv" "$place/flock2.csv"
done
row_checks "$place/rows.csv" "$place/rows.rows"
row_checks "$place/flock.csv" "$place/flock.rows"
for kept in 0 100 1000 2000; do # as an interruption leaves both files: the events of trajectories that have no row yet
    head -c $kept "$place/rows.csv" >"$place/again.csv"
    head -c $((8 * kept + 50)) "$place/flock.csv" >"$place/flock2.csv"
    [ $kept = 2000 ] && cp "$place/flock.csv" "$place/flock2.csv"
    [ $kept = 1000 ] && { cat "$place/flock.csv"; printf '26,hit,1.2'; } >"$place/flock2.csv"
    cp "$place/rows.rows" "$place/again.csv.check" && cp "$place/flock.rows" "$place/flock2.csv.check"
    gives "a sweep that was interrupted after $kept bytes" 0 "$motus" sweep $flock -o "$place/again.csv" --events "$place/flock2.csv" --resume --threads 2
    that "... has the same rows" cmp "$place/rows.csv" "$place/again.csv"
    that "... and the same events" cmp "$place/flock.csv" "$place/flock2.csv"
    that "... with their checks" eval "cmp '$place/rows.csv.check' '$place/again.csv.check' && cmp '$place/flock.csv.check' '$place/flock2.csv.check'"
done
that "the last line says of how many trajectories" eval "[ \"\$(tail -n 1 '$place/flock.csv')\" = '# end of the events of trajectories: 27' ]"
# The file of events is shortened, and that of rows has all trajectories but three.
sed '$d' "$place/rows.csv" | sed '$d' | sed '$d' >"$place/again-cut.csv"
size=$(wc -c <"$place/flock.csv")
shortened() {
    local left rows
    for left in "$@"; do # bytes
        for rows in again-cut rows; do
            cp "$place/$rows.csv" "$place/again.csv" && cp "$place/rows.rows" "$place/again.csv.check"
            head -c "$left" "$place/flock.csv" >"$place/flock2.csv"
            cp "$place/flock2.csv" "$place/kept.csv" && cp "$place/flock.rows" "$place/flock2.csv.check"
            "$motus" sweep $flock -o "$place/again.csv" --events "$place/flock2.csv" --resume >"$out" 2>"$err"
            [ $? = 2 ] && grep -q "does not have all events of the\|is damaged: after byte" "$err" && says "compute both again: --force" "$err" &&
                cmp "$place/again.csv" "$place/$rows.csv" && cmp "$place/flock2.csv" "$place/kept.csv" || { echo "$left bytes, $rows"; return 1; }
        done
    done
}
grep -v '^#' "$place/flock.csv" | sed 1d | awk -F, '$1 < 24' >"$place/early.csv"
whole=$(($(head -n 3 "$place/flock.csv" | wc -c) + $(wc -c <"$place/early.csv"))) # of the 24 trajectories
that "events that are missing are refused, and both files stay" shortened 0 $((size / 3)) $((size / 2))
that "... where a row is not whole, or the last trajectory is not" shortened $((whole - 10)) $((whole - $(tail -n 1 "$place/early.csv" | wc -c)))
that "... where nothing tells that it is" shortened $whole
rm -f "$place/flock2.csv"
cp "$place/again-cut.csv" "$place/again.csv" && cp "$place/rows.rows" "$place/again.csv.check"
refuses "... and a file that is gone" 2 "does not have all events of the 24 trajectories" "$motus" sweep $flock -o "$place/again.csv" --events "$place/flock2.csv" --resume
# As a kill leaves the file while events are written over its last line: the # is the last byte that is written over.
{ head -n 3 "$place/flock.csv"; cat "$place/early.csv"; } >"$place/begun.csv" && cp "$place/flock.csv.check" "$place/begun.csv.check" && row_checks "$place/begun.csv" "$place/early.rows"
written_over() {
    local behind
    for behind in "" " end" $'4,hit,1.5\n24,top,2' $'\n25,hit,1.5\n'; do
        cp "$place/again-cut.csv" "$place/again.csv" && cp "$place/rows.rows" "$place/again.csv.check" && cp "$place/early.rows" "$place/flock2.csv.check"
        { head -n 3 "$place/flock.csv"; cat "$place/early.csv"; printf '#%s' "$behind"; } >"$place/flock2.csv"
        "$motus" sweep $flock -o "$place/again.csv" --events "$place/flock2.csv" --resume && cmp "$place/flock.csv" "$place/flock2.csv" && cmp "$place/rows.csv" "$place/again.csv" || { echo "with #$behind"; return 1; }
    done
}
that "events that were being written over are continued" written_over
{ head -n 3 "$place/flock.csv"; awk -F, '$1 < 20' "$place/early.csv"; echo "# end of the events of trajectories: 20"; } >"$place/flock2.csv"
cp "$place/again-cut.csv" "$place/again.csv" && cp "$place/rows.rows" "$place/again.csv.check" && cp "$place/flock.rows" "$place/flock2.csv.check"
row_checks "$place/flock2.csv" "$place/early.check" && cp "$place/early.check" "$place/flock2.csv.check"
refuses "an older table of events" 2 "does not have all events of the 24 trajectories" "$motus" sweep $flock -o "$place/again.csv" --events "$place/flock2.csv" --resume
cp "$place/flock.csv" "$place/flock2.csv"
cp "$place/flock.csv" "$place/flock2.csv" && cp "$place/flock.rows" "$place/flock2.csv.check"
sed -i '20s/1/2/' "$place/flock2.csv"
refuses "an event that was changed" 2 "flock2.csv is damaged: after byte" "$motus" sweep $flock -o "$place/again.csv" --events "$place/flock2.csv" --resume
rm "$place/flock2.csv.check" && cp "$place/flock.csv" "$place/flock2.csv"
refuses "events without their checks" 2 "flock2.csv has rows, but" "$motus" sweep $flock -o "$place/again.csv" --events "$place/flock2.csv" --resume
gives "the events of a sweep with errors" 0 "$motus" sweep $flock --errors -o "$place/again.csv" --events "$place/errors.csv" --force
that "... have errors of their times" eval "rows '$place/errors.csv' | awk -F, '!(\$4 > 0 && \$4 < 1e-2) { exit 1 } END { exit NR < 100 }'"
that "... and else the same numbers" eval "diff <(rows '$place/errors.csv' | cut -d, -f1-3,5-) <(rows '$place/flock.csv')"
refuses "events of a sweep over a file" 2 "exists" "$motus" sweep $flock -o "$place/none.csv" --events "$place/flock.csv"
refuses "events of another sweep" 2 "is not the table of events of this sweep" "$motus" sweep $flock --until 2 -o "$place/none.csv" --events "$place/flock.csv" --resume
that "... leaves no rows" absent "$place/none.csv"
that "... and the table as it was" cmp "$place/flock.csv" "$place/flock2.csv"
refuses "rows and events of a sweep in one file" 2 "is named for two outputs" "$motus" sweep $flock -o "$place/x.csv" --events "$place/x.csv"
refuses "both on standard output" 2 "both go to standard output" "$motus" sweep $flock --events -

refuses "events over the model" 2 "is read and would be overwritten" "$motus" run "$ball" --events "$ball"
refuses "events and rows in one file" 2 "is named for two outputs" "$motus" run "$ball" --events "$place/x.csv" -o "$place/x.csv"
gives "events and JSON in one place" 2 "$motus" run "$ball" --events - --json
that "... are refused" holds '.error.message | contains("both write to standard output")'
refuses "events of a link" 2 "exclude each other" "$motus" run "$ball" --events "$place/x.csv" --share
{ cat "$ball"; echo "when y' > 0 as back: y' = -y'"; } >"$place/pushes.motus"
refuses "a run that fails" 1 "events in one instant" "$motus" run "$place/pushes.motus" --events "$place/none.csv"
that "... leaves no table" absent "$place/none.csv"

# --- what once went wrong -------------------------------------------------------------------------------------------------------
value() { jq -r "$1" "$out"; }
near() { awk -v a="$1" -v b="$2" -v d="$3" 'BEGIN { exit !(a - b <= d && b - a <= d) }'; } # a, b, distance
one=$place/one.motus
text() { printf '%b' "$1" >"$one"; }
ball="y'' = -9.81\ny(0) = 1\ny'(0) = 0\nuntil 3\n"
# Friction breaks loose where what holds it reaches its most: 5 units of time pass at rest, then x'' = (t - 5)/10.
text "x'' = 0.1 t - 0.5 sign(x')\nx(0) = 0\nx'(0) = 0\nuntil 10\n"
for method in dop853 taylor radau15 auto; do
    gives "friction breaks loose, $method" 0 "$motus" run "$one" --method $method --json
    that "  and moves by 125/60 in 5" near "$(value '.state.x')" 2.0833333333333333 1e-8
done
for numbers in "1 0.5 0.3" "2 0.1 1" "0.5 1 0.7" "4 0.2 0.5" "0.1 0.5 0.2"; do
    set -- $numbers
    text "x'' = $1 ($2 t - x) - $3 sign(x')\nx(0) = 0\nx'(0) = 0\nuntil 20\n"
    gives "a spring pulls a block that sticks and slips, $numbers" 0 "$motus" run "$one" --method dop853 --tolerance 1e-9
done
# Conditions that hold at the instant itself.
text "${ball}when y <= 0: y' = -0.9 y', record\n"
gives "a closed condition whose action turns the motion back" 0 "$motus" run "$one" --method dop853 --json
that "  happens once at each impact" [ "$(value '.events | length')" = 4 ]
text "x' = 1\ny' = -1\nx(0) = -1\ny(0) = 1\nn = 0\nwhen x >= 0 and y >= 0 as both: n = n + 1, record\nuntil 2\n"
gives "a condition of which two parts are 0 at once" 0 "$motus" run "$one" --method dop853 --json
that "  happens once" [ "$(value '.events | length')" = 1 ]
text "${ball}when y < 0 as b: y' = -0.5 y'\nwhen b accumulates: stop\n"
gives "a condition whose events accumulate" 0 "$motus" run "$one" --method dop853 --json
that "  at sqrt(2 h/g) (1 + e)/(1 - e)" near "$(value '.accumulated.time')" 1.354570922957192 1e-12
# The ball of a family that comes to rest is the one that rests.
text "y[i]'' = if(r[i] == 1, 0, -9.81) for i = 1..2\ny[1](0) = 100\ny[2](0) = 1\ny[i]'(0) = 0 for i = 1..2\nr[i] = 0 for i = 1..2
when y[i] = 0 falling as b: y[i]' = -0.5 y[i]' for i = 1..2
when b accumulates: r[i] = 1, y[i]' = 0, y[i] = 0 for i = 1..2\nuntil 5\n"
gives "in a family each member's events accumulate for themselves" 0 "$motus" run "$one" --method dop853 --json
# A floor that is not at 0: rounding hides the bounces long before that of the time does.
for c in 0.3 10 1000.1; do
    text "y'' = -9.81\ny(0) = 1 + $c\ny'(0) = 0\nuntil 30\nwhen y = $c falling as bounce: y' = -0.5 y', record\n"
    gives "a ball on a floor at $c" 0 "$motus" run "$one" --method dop853 --json
    that "  comes to rest on it" near "$(value '.state.y')" "$c" 1e-9
    that "  when its bar says" near "$(value '.accumulated.time')" 1.354570922957192 "$(value '.accumulated.error')"
done
text "A = 0.005\ny'' = -1\ny(0) = 0.6\ny'(0) = 0\nuntil 30\ngap = y - A sin(2 pi t)\nwhen gap = 0 falling as bounce: y' = -0.5 y' + 3 pi A cos(2 pi t), record\n"
for method in "rk4 --step 0.01" dop853 taylor; do
    gives "a ball on a table that moves, $method" 0 "$motus" run "$one" --method $method --json
    that "  does not fall through it" near "$(value '.accumulated.time')" 3.542279107235079 "$(value '.accumulated.error')"
done
# A function that is not defined everywhere has its roots where it is.
text "x'' = -x\nx(0) = 1\nx'(0) = 0\nuntil 10\nwhen sqrt(x) = 0.5 as z: record\n"
for method in taylor dop853 radau15; do
    gives "a root of a function that is undefined for half of the time, $method" 0 "$motus" run "$one" --method $method --json
    that "  and the others" [ "$(value '.events | map(.time * 1e6 | round) | join(" ")')" = "1318116 4965069 7601301" ]
done
# What is located is a root of true steps, whatever dense output says: x + h x' - h^2 x/2 reaches 1.18 in the first step, dense output 1.1878.
text "x'' = -x\nx(0) = 1\nx'(0) = 0.6\nmethod verlet\nstep 1\nuntil 3\nwhen x = 1.184: record\nwhen x = 1.176 as low: record\n"
gives "a value that steps do not reach" 0 "$motus" run "$one" --json
that "  is no event, and one that they reach is two" [ "$(value '[.events[].name] | join(" ")')" = "low low" ]
# Steps end at -0.5, -1 and -1 + 0.5^2/2, so they pass -0.99 twice: at 3 - u with u^2 + u = 0.04, and at 3 + sqrt(0.02).
text "x'' = -x\nx(0) = 1\nx'(0) = 0\nmethod verlet\nstep 1\nuntil 3.5\nwhen x = -0.99: record\n"
gives "a value that the ends of steps pass" 0 "$motus" run "$one" --json
that "  is passed, though dense output errs there" [ "$(value '.events | map(.time * 1e9 | round) | join(" ")')" = "2961483519 3141421356" ]
# A speed that stays what it is, by methods whose dense output differentiates positions.
text "x'' = if(x' > 100, 1, 0)\nx(0) = 0\nx'(0) = 0.5\nwhen x' = 0.5: record\nuntil 20\n"
for method in verlet verlet-literal leapfrog suzuki4 yoshida8 rk4 gauss8; do
    gives "a function that stays 0 by $method" 0 "$motus" run "$one" --method $method --step 0.001 --switches step --error none --json
    that "  is no event" [ "$(value '.events | length')" = 0 ]
done
# A mode is true where it is not 0: x = cos t passes 0 at odd multiples of pi/2, and b is 1 from the first to the second, from the third to the fourth.
text "b = 0\nx'' = -x\nx(0) = 1\nx'(0) = 0\nuntil 10\nwhen x = 0: b = 1 - b\nwhen b and x' > 0.5 as up: record\nwhen not b and x > 0.5: record\nwhen b as on: record\nq = if(b, x, 2)\n"
gives "a mode as a condition" 0 "$motus" run "$one" --json
that "  is true where it is not 0" [ "$(value '[.events[] | .name + " " + (.time * 1e6 | round | tostring) + " " + (.state.q * 1e6 | round | tostring)] | join(", ")')" = "on 1570796 0, up 3665191 -866025, event3 5235988 2000000, on 7853982 0, up 9948377 -866025" ]
# The first kick is the one whose rounding grows most.
text "K = 5.29\nth'' = 0\nth(0) = -1.16\nth'(0) = 2.15\nuntil 20\nwhen every 1 as kick: th' = th' + K sin(th), record\n"
gives "a motion that only kicks round" 0 "$motus" run "$one" --method taylor --json
that "  is as near as its error says" near "$(value '.state.th')" 372.296079583658923 "$(value '.error.th')"
# A symplectic method is symplectic but where the state decides the size of a step. A method that is reversible by steps of one size stays
# so: with the velocity turned round a ball that bounces without loss comes back to where it began but for rounding.
elastic="y'' = -1 - 0.3 sin(3 y)\ny(0) = 1.3\ny'(0) = 0.37\nuntil 20\n"
cut="the state decides where an event that assigns ends a step, so that step is not symplectic, while those between are"
text "${elastic}when y = 0 falling as bounce: record, y' = -y'\n"
for method in verlet gauss4; do
    gives "events that cut the steps of $method" 0 "$motus" run "$one" --method $method --step 0.125 --error none --json
    that "  break those steps alone, and it says so" eval "says '$cut' '$err' && holds '.events_note == \"$cut\"'"
    back=("y(0)=$(value .state.y)" "y'(0)=$(value "-.state[\"y'\"]")")
    gives "  back" 0 "$motus" run "$one" --method $method --step 0.125 --error none --set "${back[0]}" --set "${back[1]}" --json -q
    that "  it comes to where it began" holds "(.events | length) == 6 and (.state.y - 1.3 | fabs) < 1e-12 and (.state[\"y'\"] + 0.37 | fabs) < 1e-12"
    that "  quietly" empty "$err"
done
gives "steps that adapt reversibly" 0 "$motus" run "$one" --method verlet-reversible --tolerance 1e-3 --until 0.5 --error none
that "  begin anew, and it says so" says "the control of steps begins anew after an event that assigns" "$err"
for method in rk4 newmark; do
    gives "$method" 0 "$motus" run "$one" --method $method --step 0.125 --error none --json
    that "  has nothing to break" eval "lacks symplectic '$err' && holds 'has(\"events_note\") and .events_note == null'"
done
gives "check" 0 "$motus" check "$one"
that "  says it of the model" eval "tr -s ' \n' ' ' <'$out' | grep -qF 'the state decides where an event that assigns ends a step: by a symplectic method that step is not symplectic, while those between are'"
for event in "when y = 0 falling: record" "when every 1: y' = 0.5 y'" "when t = 1.3: y' = 0.5 y'" "n = 0\nwhen y = 0 falling: n = n + 1"; do
    text "$elastic$event\n"
    gives "$event" 0 "$motus" run "$one" --method verlet --step 0.125 --error none
    that "  cuts no step where the state decides" lacks symplectic "$err"
done
gives "check" 0 "$motus" check "$one"
that "  neither" lacks "the state decides"
text "y'' = -1 - 0.1 y'\ny(0) = 1\ny'(0) = 0\nuntil 3\nwhen y = 0 falling: y' = -y'\n"
gives "a force that no method is symplectic for" 0 "$motus" run "$one" --method verlet --step 0.125 --error none
that "  has nothing to break" lacks symplectic "$err"
# What only counts is exact, where the events are those of the companion.
counted="$ball""n = 0\nm = 3\ncell = 0\ntwice = 2 count(bounce) + 1\nlate = time(tick, last)\nwhole = if(n > 4, n*m, -n)\nwhen y = 0 falling as bounce: record, y' = -0.9 y', n = n + 1, m = 2, cell = floor(y + 3.5)\nwhen every 0.3 as tick: n = n + 1\n"
text "$counted"
for how in "--method rk4 --step 0.01" "--method dop853 --tolerance 1e-6"; do
    gives "counts by ${how#--method }" 0 "$motus" run "$one" --until 2 $how --json
    that "  have the error 0, and a time or a place has not" holds '.error | .n == 0 and .m == 0 and .twice == 0 and .whole == 0 and .late > 0 and .cell > 0'
    gives "  in print" 0 "$motus" run "$one" --until 2 $how
    that "  they have none" eval "grep -qx '  n         9' '$out' && grep -qx '  twice     7' '$out' && grep -qx '  m         2' '$out' && grep -qx '  whole     18' '$out' && grep -q '^  late .*±' '$out'"
done
gives "an event as late as the end may be" 0 "$motus" run "$one" --until 0.4515236409857309 --method rk4 --step 0.1 --json
that "  counts for nothing that is known" holds '.error | .n == null and .twice == null'
gives "a clock that ticks at the end" 0 "$motus" run "$one" --until 0.3 --method rk4 --step 0.1 --json
that "  counts" holds '.quantities.n == 1 and .error.n == 0'
gives "events that accumulate" 0 "$motus" run "$one" --until 9 --method rk4 --step 0.01
that "  have no number, and what each assigns alike is known" eval "grep -qx '  n         —' '$out' && grep -qx '  twice     —' '$out' && grep -qx '  m         2' '$out'"
text "rest = 0\nhits = count(bounce)\nticks = count(tick)\ny'' = if(rest, 0, -9.81)\ny(0) = 1\ny'(0) = 0\nuntil 2.15\nwhen y = 0 falling as bounce: record, y' = -0.5 y'\nwhen bounce accumulates: y' = 0, y = 0, rest = 1\nwhen every 0.3 as tick: record\n"
gives "a run that goes on behind them" 0 "$motus" run "$one" --method rk4 --step 0.01 --json
that "  knows what others count" holds '.quantities.rest == 1 and .quantities.ticks == 7 and .error.rest == 0 and .error.ticks == 0 and .error.hits == null'
text "x'' = 0\ny'' = 0\nx(0) = 0.7\ny(0) = 0.1\nx'(0) = 0.613\ny'(0) = 0.8\nhits = count(disc)\nside = 0\nk = 3\nodd = 0.5\nwhen x^2 + y^2 = 0.25 falling as disc: record, x' = x' - 8 x*(x*x' + y*y'), y' = y' - 8 y*(x*x' + y*y'), odd = 1 - odd\nwhen abs(x) = 1 rising as wx: record, x' = -x', side = 1\nwhen abs(y) = 1 rising as wy: record, y' = -y', side = 2\n"
gives "a billiard" 0 "$motus" run "$one" --method rk4 --step 0.05 --until 20 --json
that "  is counted" holds '.error.hits == 0 and .error.side == 0 and .error.odd > 0'
gives "a billiard that loses its digits" 0 "$motus" run "$one" --method rk4 --step 0.05 --until 200 --json
that "  loses its counts with them" holds '.events_significant < (.events | length) and .error.hits == null and .error.side == null'
# The errors are those of one motion, whatever computes it, and however often.
text "x'' = -x - 2 x y\ny'' = -y - x^2 + y^2\nx(0) = 0\ny(0) = 0.2\nx'(0) = 0.4\ny'(0) = 0\nwhen x = 0 rising as s: record, stop after 4\nuntil 5\nmethod taylor\ntolerance 1e-9\n"
for machine in interpreter compiled; do
    gives "errors by the machine $machine" 0 "$motus" run "$one" --machine $machine --json
    jq -c '[.error, .state, [.events[] | [.time, .error]]]' "$out" >"$place/alike-$machine"
done
that "  are the same by both" cmp -s "$place/alike-interpreter" "$place/alike-compiled"
gives "errors of a sweep" 0 "$motus" sweep "$one" --vary "y(0)=0.2,0.2,0.2,0.2" --record final --errors --threads 2 -o "$place/twins.csv"
that "  are the same in all its rows" test "$(grep -v '^#' "$place/twins.csv" | tail -n +2 | cut -d, -f3- | sort -u | wc -l)" = 1
# Rounding is an error too: of numbers beyond 2^53, of assignments that repeat, and of a quantity's own formula.
text "x'' = -x\nx(0) = 1\nx'(0) = 0\nn = 0\nseed = 1\nsmall = 1\nz = 0.3\ns = 0\nc = 0\nwhen x = 0: n = n + 1, seed = mod(1103515245 seed + 12345, 2147483648), small = mod(16807 small, 2147483647), z = 3.99 z (1 - z), s = s + 0.1, c = c + 0.5\nk = (n + 1e17) - 1e17\nq = (x + 1e8) - 1e8\nsq = n^2\n"
gives "numbers that rounding changes" 0 "$motus" run "$one" --until 400 --method taylor --json
# 127 events; the truths in integers and, of z, by 120 digits
that "  have its error" holds '.quantities.n == 127 and .error.n == 0 and .error.sq == 0 and .error.c < 1e-12 and .quantities.c == 63.5 and .error.small == 0 and .quantities.small == 2014119113 and .error.seed > 1e9 and .error.z > 0.1 and .error.s > 3e-14 and .error.k >= 8 and .error.q > 1e-9 and .error.q < 1e-7'
text "x'' = -x\nx(0) = cos(2)\nx'(0) = sin(2)\nn = 0\nwhen x = 1: n = n + 1\n"
gives "a count that a touch leaves open" 0 "$motus" run "$one" --method verlet --step 0.05 --until 5
that "  says what is open" says "undecided: an event may have happened or not, or it jumps, within the error of the state"

# A ball on a shaking plate settles on it in every third period, and flies from there as at the start: at t = 2 as at 2 - 15/8.
plate="A = 0.01; w = 2 pi*8; g = 9.81; e = 0.5; on_plate = 1\nz = A sin(w t); zd = A w cos(w t); zdd = -A w^2 sin(w t)\ny'' = if(on_plate, zdd, -g)\ny(0) = 0; y'(0) = A w\nwhen on_plate and zdd < -g as takeoff: on_plate = 0, record\nwhen hit accumulates as settle: on_plate = 1, y = z, y' = zd, record\nuntil 2\n"
text "${plate}when y = z falling as hit: y' = zd - e (y' - zd), record\n"
gives "events that accumulate again and again" 0 "$motus" run "$one" --method dop853 --tolerance 1e-12 --json
that "  are told each time" holds '[.events[] | select(.name == "settle") | .time - 0.375 * .count + 0.015998682 | fabs < 1e-7] == [true, true, true, true, true]'
ends="$(value .state.y) $(value .error.y)"
gives "  as from the start" 0 "$motus" run "$one" --method dop853 --tolerance 1e-12 --until 0.125 --json
that "  so that the motion repeats" near "${ends% *}" "$(value .state.y)" "${ends#* }"
that "  which is known well" near "${ends#* }" 0 1e-8
for how in "dop853 --tolerance 1e-10" "dopri5 --tolerance 1e-9" "taylor" "rk4 --step 0.001"; do
    gives "the plate by $how" 0 "$motus" run "$one" --method $how --error none --json
    that "  leaves no ball below it" holds '.state.y > -0.011 and ([.events[] | select(.name == "settle")] | length) == 5'
done
text "${plate}when not on_plate and y < z as hit: y' = zd - e (y' - zd), record\n"
for how in "dop853 --tolerance 1e-12" "dep6 --tolerance 1e-10"; do
    gives "a condition that accumulates again by $how" 0 "$motus" run "$one" --method $how --error none --json
    that "  leaves no ball below it" holds '.state.y > -0.011 and ([.events[] | select(.name == "settle")] | length) == 5'
    that "  and has no event where the ball rests" holds '[.events[] | select(.name == "hit" and .state["on_plate"] == 1)] == []'
done
# each hit leaves a part of the speed that shrinks with the speed, and the third flight is lower than rounding
text "${plate}when y = z falling as hit: y' = zd + 0.5 (y' - zd)^2\n"
gives "flights that shrink ever faster" 0 "$motus" run "$one" --method dop853 --error none --until 0.37 --json
that "  end on the plate" holds '.quantities.on_plate == 1 and .state.y == .quantities.z or (.state.y - .quantities.z | fabs) < 1e-12'
text "g = 10; e = 0.5; rest = 0\ny'' = if(rest, 0, -g)\ny(0) = 1; y'(0) = 0\nwhen y = 0 falling as hit: y' = -e y'\nwhen hit accumulates as settle: rest = 1, y = 0, y' = 0, record\nwhen every 3 as kick: rest = 0, y' = 4, record\nuntil 8.9\n"
gives "a ball that is thrown again" 0 "$motus" run "$one" --json
that "  rests with its error" holds '.state."y'"'"'" == 0 and .error."y'"'"'" < 1e-12 and ([.events[] | select(.name == "settle") | .time - (4.6, 7.6, 1.341640786499874) | fabs < 1e-12] | map(select(.)) | length) == 3'
# The time of a function of the time alone is known, whatever the motion is.
text "k = 0\ny'' = -9.81 - k y'^3\ny(0) = 300\ny'(0) = 0\nuntil 30\nwhen t = 4*60/100 + 1 as chute: k = 0.01, record\nwhen cos(t) = 0 as late: record\nwhen y = 0 falling as ground: record, stop\n"
gives "events at times that are known" 0 "$motus" run "$one" --method dopri5 --tolerance 1e-6 --json
that "  have the bars of these times" holds '([.events[] | select(.name != "ground") | .error <= 2e-15 * .time] | all) and ([.events[] | select(.name == "late") | .time - 1.5707963267948966 - 3.141592653589793 * (.count - 1) | fabs < 4e-15] | all) and .events[-1].name == "ground" and .events[-1].error > 1e-9'
that "  which hold" holds '.events[1] | .name == "chute" and (.time - 3.4 | fabs) <= .error'
# A condition that holds from the start on never becomes true.
text "u = 0\nx'' = u + 0.02\nx(0) = 0.2\nx'(0) = 0\nuntil 60\nwhen x > 0.05: u = -1\nwhen x > 0.1 and u >= 0: u = -2\nwhen x < -0.05: u = 1\n"
gives "conditions that hold from the start on" 0 "$motus" run "$one" --json
that "  are counted" holds '.events_held == 2 and .events_held_of == "event1"'
gives "  in print" 0 "$motus" run "$one"
that "  are told" says "event1 and 1 other event never happened: their conditions held from the start on"
gives "one that becomes false and true again" 0 "$motus" run "$one" --set "x(0)=0.06" --set "x'(0)=-0.1" --json
that "  happens" holds '.events_held == 0 and .events_held_of == null'
# A function that another rule's action sends back has touched 0.
bounce="y'' = -9.81\ny(0) = 1\ny'(0) = 0\nuntil 3.5\n"
hit="when y = 0 falling as bounce: y' = -0.8 y', record\n"
for how in "verlet --step 0.125" "dop853" "taylor"; do
    text "$bounce${hit}when y = 0 as s: record\nwhen y = 0 falling as down: record\nwhen 0 = y falling as up: record\n"
    gives "a section on a floor that sends back, by $how" 0 "$motus" run "$one" --method $how --json
    that "  is touched by every bounce, with its time and error" holds '[.events[] | select(.name == "s") | [.touched, .time, .error]] == [.events[] | select(.name == "bounce") | [true, .time, .error]] and ([.events[].error] | all(. < 1e-12))'
    that "  and passed by none" holds '[.events[] | select(.name == "up" or .name == "down")] == []'
    text "${bounce}when y = 0 as s: record\nwhen y = 0 falling as down: record\nwhen y = 0 rising as up: record\n$hit"
    gives "one above the bounce in the text, by $how" 0 "$motus" run "$one" --method $how --json
    that "  has seen it pass, once" holds '([.events[] | select(.name == "s" or .name == "down") | .touched] | all(not)) and ([.events[] | .name] | group_by(.) | map([.[0], length])) == [["bounce", 9], ["down", 9], ["s", 9]]'
done

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
