#!/bin/bash
# motus sweep: the values and their order, the same bits as single runs, files that survive interruptions and are finished to the same bytes.
#
# Each case is one line `ok` or `not ok`; the last line counts them. MOTUS is the program (build/motus).
cd "$(dirname "$0")/.." || exit 1
. test/cli/cases.sh
cd "$place" || exit 1

cat >osc.motus <<'M'
F = 0.1
w = 1
x'' = -x + x^3 + F cos(w t)
x(0) = 0
x'(0) = 0
energy = x'^2/2 + x^2/2
method velocity-verlet
step 0.01
until 2
M
cat >line.motus <<'M'
a = 1
x'' = a
x(0) = 0
x'(0) = 0
method verlet
step 1
until 2
M
cat >blow.motus <<'M'
k = 1
x'' = k x^3
x(0) = 1
x'(0) = 0
method rk4
step 0.01
until 4
M
rows() { grep -v '^#' "${1:-$out}" | sed 1d; }
names() { grep -v '^#' "${1:-$out}" | head -n 1; }
column() { rows "${2:-$out}" | cut -d, -f"$1" | tr '\n' ' '; }
is() { [ "$1" = "$2" ] || { printf '%s\nis not\n%s\n' "$1" "$2"; return 1; }; }
sweep() { "$motus" sweep "$@"; }

# --- steps ----------------------------------------------------------------------------------------------------------------------
sweep osc.motus --vary F=0.1,0.2 --method dopri5 --tolerance 1e-7 --until 5 --record "steps, rejected, h_min, h_max, evaluations, x" -q >"$out" 2>"$err"
that "what is recorded of the steps has the words of run --json" is "$(names)" "index,F,steps,rejected,h_min,h_max,evaluations,x,stopped,stopped_by"
"$motus" run osc.motus --set F=0.2 --method dopri5 --tolerance 1e-7 --until 5 --json >one.json
for key in steps rejected h_min h_max evaluations; do
    n=$(names | tr , '\n' | grep -nx "$key" | cut -d: -f1)
    that "$key is that of the run" grep -q "\"$key\": $(column "$n" | cut -d' ' -f2)[,}]" one.json
done
sweep osc.motus --vary F=0.1,0.2 --method dopri5 --tolerance 1e-7 --until 5 --record steps -o steps.csv -q
refuses "another tolerance is another sweep" 2 "made by another sweep" "$motus" sweep osc.motus --vary F=0.1,0.2 --method dopri5 --tolerance 1e-6 --until 5 --record steps -o steps.csv --resume
that "the head names the tolerance" grep -q -- "--method dopri5 --tolerance 1e-07 --until 5" steps.csv
refuses "a time between samples where steps adapt" 2 "the steps of the method have no one size" "$motus" sweep osc.motus --vary F=1 --method dopri5 --until 5 --record "max(x)" --every 0.1

# --- errors ---------------------------------------------------------------------------------------------------------------------
for method in "rk4 --step 0.02" "dopri5 --tolerance 1e-7"; do
    told=(sweep osc.motus --vary F=0.125:0.5:11 --method $method --until 5 --record "x, max(x), steps, x'" --errors -q)
    "${told[@]}" --machine interpreter -o one.csv --force
    that "errors by $method have columns after what is recorded" is "$(names one.csv)" "index,F,x,max(x),steps,x',x.error,max(x).error,x'.error,significant,stopped,stopped_by"
    "${told[@]}" --machine compiled --threads 1 -o two.csv --force
    that "... and the same bytes in lanes" cmp one.csv two.csv
    "${told[@]}" --machine compiled --lanes 16 --threads 2 -o two.csv --force
    that "... with other lanes and threads" cmp one.csv two.csv
    head -n 8 one.csv >part.csv && row_checks one.csv part.csv.check
    "${told[@]}" -o part.csv --resume
    that "... and when they are resumed" cmp one.csv part.csv
    "$motus" run osc.motus --set F=0.125 --method $method --until 5 --json >one.json
    sweep osc.motus --vary F=0.125:0.5:11 --method $method --until 5 --record x --errors -q >"$out"
    that "... the error is that of the run" grep -q "\"error\": {\"x\": $(column 4 | cut -d' ' -f1)," one.json
    refuses "... which are another sweep without" 2 "made by another sweep" "$motus" sweep osc.motus --vary F=0.125:0.5:11 --method $method --until 5 --record "x, max(x), steps, x'" -q -o one.csv --resume
done
printf "x'' = -9.81 sin(x)\nx(0) = pi/2\nx'(0) = 0\n" >pendulum.motus
leaps=(sweep pendulum.motus --method rk4 --vary "x(0)=pi/2,pi/3,1" --until 1000)
"${leaps[@]}" --step 2 >"$out" 2>"$err"
that "steps that grow where the motion does not are told" grep -q "steps of 2 by rk4 are too long: .* what is recorded is not the motion" "$err"
"${leaps[@]}" --step 0.1 >"$out" 2>"$err"
that "... and others not" is "$(grep -c "too long" "$err")" 0
"${leaps[@]}" --step 2 --errors >"$out" 2>"$err"
that "a line counts the trajectories without a significant digit" grep -q "no digit is known to be significant at the end of 3 of 3 trajectories" "$err"
"$motus" run pendulum.motus --method rk4 --step 2 --until 1000 --error none >"$out" 2>"$err"
that "... and a run without errors says that its steps are too long" grep -q "steps of 2 by rk4 are too long: where the motion swings" "$err"
refuses "the error of a time" 2 "record 1 is the time of a maximum, which has no error" "$motus" sweep osc.motus --vary F=1 --record "x, time_of_max(x)" --errors
refuses "errors by no companion" 2 "--errors and --error none exclude each other" "$motus" sweep osc.motus --vary F=1 --errors --error none
refuses "a companion for nothing" 2 "--error needs --errors in a sweep" "$motus" sweep osc.motus --vary F=1 --error full
sweep blow.motus --vary k=-1,1 --record x --errors -q >"$out"
that "a trajectory that stops has no error" is "$(rows | sed 1d | cut -d, -f3-5)" ",,"

# --- accuracy -------------------------------------------------------------------------------------------------------------------
exact=(sweep osc.motus --vary F=0.02,0.06,0.1,0.12,0.18 --method tsit5 --until 20 --record "x, max(x), min(x), reached, tolerance" --errors --accuracy 1e-9 -q)
"${exact[@]}" -o exact.csv
that "an accuracy is in the head" grep -q "^# motus sweep .* --method tsit5 --accuracy 1e-09 --until 20" exact.csv
within() { rows "$1" | awk -F, 'NR > 1 { size = $4 > -$5 ? $4 : -$5; if (!($8 <= 1e-9 * size && $9 <= 1e-9 * size && $6 <= 1e-9) || $12 != "") bad = 1 } END { exit bad }'; }
that "... and every error is below it" within exact.csv
that "... with tolerances of their own" eval '[ "$(rows exact.csv | cut -d, -f7 | sort -u | wc -l)" -gt 1 ]'
rows exact.csv | sed 1d | while IFS=, read -r _ F x _ _ _ tolerance _; do
    "$motus" run osc.motus --set "F=$F" --method tsit5 --until 20 --tolerance "$tolerance" --json >one.json
    grep -q "\"x\": $x[,}]" one.json || echo "F = $F"
done >differ.txt
that "... which give a run the same numbers" is "$(cat differ.txt)" ""
"${exact[@]}" -o alone.csv --machine interpreter --threads 1
that "... by any machine and number of threads" cmp exact.csv alone.csv
head -n 6 exact.csv >part.csv && row_checks exact.csv part.csv.check
"${exact[@]}" -o part.csv --resume
that "... also resumed" cmp exact.csv part.csv
"${exact[@]}" >"$out"
that "... also without a file" cmp exact.csv "$out"
refuses "an accuracy that is not reached" 1 "the accuracy 1e-15 is not reached: trajectory 0 (F = 0.1) has the error" "$motus" sweep osc.motus --vary F=0.1,0.2 --method dop853 --until 20 --accuracy 1e-15 -o none.csv
refuses "an accuracy by steps of one size" 2 "the steps of verlet have one size" "$motus" sweep osc.motus --vary F=1 --method verlet --accuracy 1e-6 -o no.csv
refuses "an accuracy and a tolerance" 2 "an accuracy and a tolerance are given" "$motus" sweep osc.motus --vary F=1 --method dop853 --accuracy 1e-6 --tolerance 1e-6 -o no.csv
sweep osc.motus --vary F=1 --until 20 --accuracy 1e-6 -q >"$out"
that "an accuracy without a method takes an adaptive one" grep -q -- "--method dop853 --accuracy 1e-06" "$out"

refuses "a value at a time" 2 "x is recorded at the end of the run, not at a time" "$motus" sweep line.motus --vary a=1,2 --record "x(0)"
that "... what there is" says "write x, or one of its values on the way: min(x), max(x), mean(x)" "$err"
refuses "a slip in --record" 2 "there is no maxx(…) to record" "$motus" sweep line.motus --vary a=1,2 --record "maxx(x)"
that "... and what was meant" says "did you mean max(...)?" "$err"

# --- values ---------------------------------------------------------------------------------------------------------------------
values() {                   # name, option, argument, the values
    sweep line.motus "$2" "$3" --record x -q >"$out" 2>"$err" </dev/null
    that "$1" is "$(column 2)$(cat "$err")" "$4 "
}
values "a range" --vary a=0:1:11 "0 0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8 0.9 1"
values "a range that goes down through 0" --vary a=0.3:-0.1:5 "0.3 0.2 0.1 0 -0.1"
values "a range of one" --vary a=2:2:1 "2"
values "a range of constant expressions" --vary "a = 0 : 2*pi : 3" "0 3.141592653589793 6.283185307179586"
values "... with functions and brackets" --vary "a=sqrt(4):max(3, 4):3" "2 3 4"
values "equal ratios" --vary a=log:0.001:1000:7 "0.001 0.01 0.1 1 10 100 1000"
values "equal ratios going down, below 0" --vary a=log:-8:-1:4 "-8 -4 -2 -1"
values "a list" --vary "a=3, 1e-3, -2 pi, 1/3" "3 0.001 -6.283185307179586 0.3333333333333333"
values "a list of one" --vary a=7 "7"
printf 'n,"the a, quoted",b\r\n# a remark\n1,0.5,x\n\n2, 1.5 ,y\n3,"-2.5e-3",z\n' >values.csv
values "a column of a file, by name" --vary "a=@values.csv:the a, quoted" "0.5 1.5 -0.0025"
values "... by number" --vary a=@values.csv:2 "0.5 1.5 -0.0025"
printf '1\n2\n4' >plain.csv
printf '\357\273\277a,b\r\n1,5\r\n2,6\r\n' >marked.csv
values "a file that begins with a byte order mark" --vary a=@marked.csv:a "1 2"
printf '\357\273\2771\n2\n' >marked.csv
values "... and has no head" --vary a=@marked.csv "1 2"
# A file that has no end, or is none: an error at once, in bounded memory.
printf 'a\n1\n2\0\n' >zero.csv
head -c 17000000 /dev/zero | tr '\0' 1 >long.csv
mkdir folder.csv
mkfifo pipe.csv
values_refused() { refuses "$1" "$2" "$3" timeout 20 bash -c 'ulimit -v 2000000; exec "$@"' - "$motus" sweep osc.motus --vary "F=@$4" --until 1; }
values_refused "values: a device without end" 1 "/dev/zero: it is a device" /dev/zero:k
values_refused "... a byte 0" 2 "zero.csv:3: the line has a byte 0" zero.csv:a
values_refused "... a line without end" 2 "long.csv:1: the line is longer than 16777216 bytes" long.csv
values_refused "... a folder" 1 "folder.csv: it is a folder" folder.csv
values_refused "... a pipe that nobody writes" 1 "no program has opened it to write" pipe.csv
(sleep 0.3; timeout 20 bash -c "printf '1\\n2\\n4\\n' >pipe.csv") &
values "a pipe that is written later" --vary a=@pipe.csv "1 2 4"
wait
refuses "merge of what is no file" 2 "pipe.csv is not a regular file" "$motus" merge pipe.csv pipe.csv -o nothing.csv
rm zero.csv long.csv pipe.csv
rmdir folder.csv
values "a file of one column without a head" --vary a=@plain.csv "1 2 4"
sweep line.motus --vary a=1:2:3 --record "x,x'" -o first.csv -q
values "the file of another sweep" --vary "a=@first.csv:x'" "2 3 4"

sweep osc.motus --vary F=1,2 --vary w=3,4,5 --record x -q >"$out"
that "two --vary: every one with every other, the last fastest" is "$(rows | cut -d, -f1-3 | tr '\n' ' ')" "0,1,3 1,1,4 2,1,5 3,2,3 4,2,4 5,2,5 "
that "the names of the columns" is "$(names)" "index,F,w,x,stopped,stopped_by"
sweep osc.motus --vary F=1,2,3 --vary w=4:6:3 --zip --record x -q >"$out"
that "--zip: side by side" is "$(rows | cut -d, -f1-3 | tr '\n' ' ')" "0,1,4 1,2,5 2,3,6 "
sweep osc.motus --vary F=1,2 --random w=0:1 --count 3 --record x -q >"$out"
that "--vary and --random: so many draws for each value" is "$(column 2)" "1 1 1 2 2 2 "
that "... all of them different" eval "[ \$(column 3 | tr ' ' '\n' | sort -u | grep -c .) = 6 ]"

# --- random -----------------------------------------------------------------------------------------------------------------------
sweep line.motus --random a=0:1 --count 1000 --record x -q >thousand
# 53 bits of the words 6627e8d5 e169c58d, the published answer of Philox4x32-10 to 0
that "the first number of seed 0 is the published one" is "$(column 2 thousand | cut -d' ' -f1)" "$(printf '%.16g' 0x.e169c58d6627e8p0)"
sweep line.motus --random a=0:1 --count 10 --record x -q >ten
that "a trajectory has its numbers whatever the count" cmp <(rows ten) <(rows thousand | head -n 10)
sweep line.motus --random a=0:1 --count 1000 --seed 0 --record x -q --threads 1 --lanes 1 >again
that "... whatever threads and lanes, and 0 is the seed" cmp thousand again
sweep line.motus --random a=0:1 --count 1000 --seed 18446744073709551615 --record x -q >other
that "another seed, other numbers" eval "[ \"\$(comm -12 <(column 2 thousand | tr ' ' '\n' | sort) <(column 2 other | tr ' ' '\n' | sort) | grep -c .)\" = 0 ]"
sweep line.motus --random a=-3:5 --count 1000 --record x -q >"$out"
that "evenly between the ends" eval "rows | awk -F, '{ s += \$2; bad += \$2 < -3 || \$2 > 5 } END { m = s/NR - 1; exit !(!bad && m*m < 16*64/12/NR) }'"
sweep line.motus --random a=normal:3:0.5 --count 1000 --record x -q >"$out"
that "normal: mean and deviation" eval "rows | awk -F, '{ s += \$2; q += (\$2-3)^2 } END { m = s/NR - 3; v = q/NR/0.25 - 1; exit !(m*m < 16*0.25/NR && v*v < 16*2/NR) }'"
sweep osc.motus --random F=0:1 --random w=0:1 --count 50 --record x -q >"$out"
that "two draws are two numbers" eval "rows | awk -F, '\$2 == \$3 { bad = 1 } END { exit bad }'"

# --- the same bits as single runs -------------------------------------------------------------------------------------------------------
run_of() { "$motus" run osc.motus "$@" --json | jq -r '[.state.x, .state["x\u0027"], .quantities.energy] | map(tostring) | join(",")'; }
for how in "" "--method rk4" "--method verlet --step 1/64" "--until 1.005" "--until -1" "--method gauss4" "--machine interpreter"; do
    # shellcheck disable=SC2086
    sweep osc.motus $how --vary F=-0.2:0.7:4 --vary "x(0)=0,0.25" --record "final,energy" -q >"$out" 2>"$err"
    # shellcheck disable=SC2086
    that "the bits of single runs: ${how:-as the model says}" is "$(rows | cut -d, -f4-6)" "$(for F in -0.2 0.1 0.4 0.7; do for x in 0 0.25; do run_of $how --set F=$F --set "x(0)=$x"; done; done)"
done
"$motus" run osc.motus --set F=0.3 -o traj.csv --columns "t,x,energy" -q
sweep osc.motus --vary F=0.3 --record "min(x),max(x),time_of_min(x),time_of_max(x),mean(energy),max( energy )" -q >"$out"
that "min, max and their times are those of the rows of a run" is "$(rows | cut -d, -f3-6,8)" "$(rows traj.csv | awk -F, '
    NR == 1 || $2 + 0 < least + 0 { least = $2; tl = $1 } NR == 1 || $2 + 0 > most + 0 { most = $2; tm = $1 } NR == 1 || $3 + 0 > e + 0 { e = $3 }
    END { print least "," most "," tl "," tm "," e }')"
that "mean" near "$(column 7)" "$(rows traj.csv | awk -F, '{ s += $3 } END { printf "%.17g", s/NR }')" 1e-15
that "their names" is "$(names)" "index,F,min(x),max(x),time_of_min(x),time_of_max(x),mean(energy),max(energy),stopped,stopped_by"
"$motus" run osc.motus --set F=0.3 -o traj.csv --columns "t,x" --every "70 steps" -q
sweep osc.motus --vary F=0.3 --record "max(x),mean(x)" --every "70 steps" -q >"$out"
that "--every: looks that far apart, and at the end" is "$(column 3)" "$(rows traj.csv | awk -F, 'NR == 1 || $2 > m { m = $2 } END { print m }' OFMT=%.17g CONVFMT=%.17g) "
cp "$out" steps
sweep osc.motus --vary F=0.3 --record "max(x),mean(x)" --every 0.7 -q >"$out"
that "--every as a time" cmp steps "$out"
sweep "$root/models/three-body-figure-eight.motus" --vary "r[1].x(0)=0.97" --until 0.01 -q >"$out" 2>"$err"
sweep "$root/models/projectile.motus" --vary g.y=-9.81,-1.62 --record "r,max(r'.y)" -q >"$out" 2>"$err"
that "a name stands for all its numbers; a component varies" is "$(names)" "index,g.y,r.x,r.y,max(r'.y),stopped,stopped_by"

# A number that decides the step or the end cannot vary, unless this is given.
printf '%s\n' "T = 3" "h = 0.1" "x'' = -x" "x(0) = 1" "x'(0) = 0" "step h" "until T" >decides.motus
refuses "what decides the end" 2 "decides the end" "$motus" sweep decides.motus --vary T=1,2
refuses "what decides the step" 2 "decides the step" "$motus" sweep decides.motus --vary h=0.1,0.2
gives "... but not of a sweep with its own" 0 "$motus" sweep decides.motus --vary T=1,2 --vary h=0.1,0.2 --until 2 --step 0.1

# Ends that differ: before the start, at it, within a step of it, between steps.
for machine in compiled interpreter; do
    sweep osc.motus --vary until=-1,0,0.004,0.5,1.237,30 --record "x,x'" --machine $machine -q >"ends-$machine.csv"
done
that "ends that differ: the same bits on both machines" is "$(cat ends-compiled.csv)" "$(cat ends-interpreter.csv)"
while IFS=, read -r _ end x v _; do
    "$motus" run osc.motus --until "$end" -o end.csv --columns "t,x,x'" -q
    that "... and as a run until $end" is "$x,$v" "$(tail -n 1 end.csv | cut -d, -f2,3)"
    rm -f end.csv
done < <(rows ends-compiled.csv)
sweep osc.motus --vary until=0:20:500 --record x -o ends-cut.csv -q
cp ends-cut.csv ends-whole.csv && cp ends-cut.csv.check ends-whole.csv.check
truncate -s 3000 ends-cut.csv && row_checks ends-whole.csv ends-cut.csv.check
sweep osc.motus --vary until=0:20:500 --record x -o ends-cut.csv -q --resume
that "... and resumed to the same bytes" cmp -s ends-cut.csv ends-whole.csv

# --- a motion that diverges ---------------------------------------------------------------------------------------------
gives "some that blow up" 0 "$motus" sweep blow.motus --vary k=-1,3,1,100,0 --record "x,max(x)"
that "... are said" eval "says '3 of 5 trajectories did not reach their end' '$err'"
that "... their cells are empty, and the time is there" eval "rows | awk -F, '\$2 > 0 { bad += !(\$3 == \"\" && \$4 == \"\" && \$5 > 0 && \$5 < 4) } \$2 <= 0 { bad += !(\$3 != \"\" && \$4 != \"\" && \$5 == \"\") } END { exit bad || NR != 5 }'"
for k in 3 100; do
    "$motus" run blow.motus --set k=$k --json >run.json 2>/dev/null
    that "... the time is that of the single run, k = $k" eval "[ -n '$k' ] && jq -r .error.message run.json | grep -qF \"t = \$(rows | awk -F, '\$2 == $k { print \$5 }')\""
done
sweep blow.motus --vary k=-1 --record "x,max(x)" -q >alone
that "... the others are as ever" is "$(rows | head -n 1)" "$(rows alone)"

# --- files -----------------------------------------------------------------------------------------------------------------------
ask=(osc.motus --vary F=0:0.5:7 --vary w=1,2 --record "x,max(energy)")
gives "-o" 0 "$motus" sweep "${ask[@]}" -o whole.csv
sweep "${ask[@]}" -q >"$out"
that "-o holds what standard output shows" cmp whole.csv "$out"
that "the first line is the request, with nothing left out" is "$(head -n 1 whole.csv)" \
    "# motus sweep osc.motus --vary F=0:0.5:7 --vary w=1,2 --record 'x,max(energy)' --method velocity-verlet --step 0.01 --until 2"
for how in "--threads 1" "--threads 2" "--lanes 1" "--lanes 4" "--machine interpreter" "--method velocity-verlet --step 1/100" "--until 2"; do
    # shellcheck disable=SC2086
    sweep "${ask[@]}" $how -o same.csv --force -q 2>"$err"
    that "the same bytes with $how" cmp whole.csv same.csv
done
sh -c "$(head -n 1 whole.csv | sed "s|^# motus|'$motus'|") -q" >"$out"
that "the first line is a command that makes the file" cmp whole.csv "$out"
refuses "a file that is there" 2 "whole.csv exists" "$motus" sweep "${ask[@]}" -o whole.csv
that "... the remedies" eval "says --resume '$err' && says --force '$err'"
refuses "... with another request as well" 2 "exists" "$motus" sweep line.motus --vary a=1 -o whole.csv
cp whole.csv copy.csv && cp whole.csv.check copy.csv.check
gives "--resume of a whole file" 0 "$motus" sweep "${ask[@]}" -o copy.csv --resume --json
that "... does nothing" eval "cmp whole.csv copy.csv && holds '.resumed == 14 and .seconds == 0'"
: >none.csv
gives "an empty file is no loss" 0 "$motus" sweep "${ask[@]}" -o none.csv
that "... and is filled" cmp whole.csv none.csv

row_checks whole.csv whole.rows
# Cut in the last two rows, at their ends, in the head, to nothing.
size=$(stat -c %s whole.csv) tail=$(tail -n 2 whole.csv | wc -c) head=$(grep -E '^(#|index)' whole.csv | wc -c)
resumed() { head -c "$1" whole.csv >cut.csv && cp whole.rows cut.csv.check && sweep "${ask[@]}" -o cut.csv --resume -q && cmp whole.csv cut.csv && cmp whole.csv.check cut.csv.check; }
everywhere() { local n; for n in "$@"; do resumed "$n" || { echo "cut at $n"; return 1; }; done; }
that "resumed after a cut at every byte of the last two rows" everywhere $(seq $((size - tail)) "$size")
that "... at every byte of the head and the first row" everywhere $(seq 0 $((head + 20)))
head -c $((size - 30)) whole.csv >cut.csv && head -c 4000 /dev/zero >>cut.csv && cp whole.rows cut.csv.check
that "... after a power cut that left zeros" eval "sweep \"\${ask[@]}\" -o cut.csv --resume -q && cmp whole.csv cut.csv"
head -n 6 whole.csv >cut.csv && tail -n 3 whole.csv >>cut.csv && cp whole.rows cut.csv.check
that "... with rows that do not follow" eval "sweep \"\${ask[@]}\" -o cut.csv --resume -q && cmp whole.csv cut.csv"
head -n 8 whole.csv >cut.csv && echo 5,0.1 >>cut.csv && cp whole.rows cut.csv.check
that "... with half a row" eval "sweep \"\${ask[@]}\" -o cut.csv --resume -q && cmp whole.csv cut.csv"
cp whole.csv longer.csv && cp whole.csv.check longer.csv.check && echo 14,1,2,3,4, >>longer.csv
that "... with rows that do not belong" eval "sweep \"\${ask[@]}\" -o longer.csv --resume -q && cmp whole.csv longer.csv"
gives "--resume of nothing begins" 0 "$motus" sweep "${ask[@]}" -o fresh.csv --resume
that "... and is the same" cmp whole.csv fresh.csv
head -c $((size - 30)) whole.csv >cut.csv && cp whole.rows cut.csv.check
gives "another way to the same model" 0 "$motus" sweep "$PWD/osc.motus" "${ask[@]:1}" -o cut.csv --resume -q
that "... is the same sweep" cmp whole.csv cut.csv

head -c $((size - 30)) whole.csv >part.csv && cp whole.rows part.csv.check
cp part.csv kept.csv
sed 's/x^3/x^5/' osc.motus >osc5.motus
other() {                    # name, the command's changes
    local name=$1
    shift
    refuses "--resume with another $name" 2 "part.csv was made by another sweep" "$motus" sweep "$@" -o part.csv --resume
    that "... the file stays" cmp part.csv kept.csv
}
other model osc5.motus "${ask[@]:1}"
other method "${ask[@]}" --method rk4
other step "${ask[@]}" --step 0.02
other end "${ask[@]}" --until 3
other range osc.motus --vary F=0:0.5:8 --vary w=1,2 --record "x,max(energy)"
other list osc.motus --vary F=0:0.5:7 --vary w=1,3 --record "x,max(energy)"
other order osc.motus --vary w=1,2 --vary F=0:0.5:7 --record "x,max(energy)"
other record osc.motus --vary F=0:0.5:7 --vary w=1,2 --record "x,min(energy)"
other look "${ask[@]}" --every "2 steps"
other parameter "${ask[@]}" --set "x(0)=0.1"
other freedom "${ask[@]}" --fast
other draw osc.motus --random F=0:0.5 --count 14 --record "x,max(energy)"
that "... which it is, is said" says "it was made by: motus sweep osc.motus --vary F=0:0.5:7" "$err"
sweep line.motus --random a=0:1 --count 9 --seed 1 -o seeded.csv -q
refuses "--resume with another seed" 2 "another sweep" "$motus" sweep line.motus --random a=0:1 --count 9 --seed 2 -o seeded.csv --resume
refuses "--resume with another count" 2 "another sweep" "$motus" sweep line.motus --random a=0:1 --count 10 --seed 1 -o seeded.csv --resume
# Steps of adaptive methods end where the force changes its formula, or lead across: two sweeps.
printf "k = 1\nx'' = -k x + max(x, 0)\nx(0) = 1\nx'(0) = 0\nuntil 5\n" >kink.motus
kinked=(kink.motus --vary k=0.5:2:7 --record x --method dop853 --machine compiled)
gives "switches are located" 0 "$motus" sweep "${kinked[@]}" -o located.csv --json
that "... which JSON says, and why there are no lanes" holds '.switches == "locate" and .lanes == 1 and (.note | contains("one trajectory at a time; --switches step"))'
gives "... as --switches locate asks for" 0 "$motus" sweep "${kinked[@]}" --switches locate -o asked.csv -q
that "... to the same file" cmp located.csv asked.csv
gives "--switches step leads across" 0 "$motus" sweep "${kinked[@]}" --switches step -o across.csv --json
that "... in lanes" holds '.switches == "step" and .lanes > 1 and .note == null'
one_of() { "$motus" run kink.motus --set k=2 --method dop853 --json "$@" | jq .state.x; }
that "... each with the bits of the runs" test "$(tail -n 1 located.csv | cut -d, -f3) $(tail -n 1 across.csv | cut -d, -f3)" = "$(one_of) $(one_of --switches step)"
head -c 211 located.csv >part.csv && cp part.csv kept.csv
refuses "--resume with other switches" 2 "part.csv was made by another sweep" "$motus" sweep "${kinked[@]}" --switches step -o part.csv --resume
that "... the file stays" cmp part.csv kept.csv
cp located.csv.check part.csv.check
gives "... with the same ones" 0 "$motus" sweep "${kinked[@]}" -o part.csv --resume -q
that "... it is finished" cmp located.csv part.csv
gives "steps of one size locate where they are asked to" 0 "$motus" sweep kink.motus --vary k=2 --method verlet --step 0.1 --switches locate -o fixed.csv --json
that "... which JSON says" holds '.switches == "locate"'
that "... with the bits of the run" test "$(tail -n 1 fixed.csv | cut -d, -f3)" = "$("$motus" run kink.motus --set k=2 --method verlet --step 0.1 --switches locate --json | jq .state.x)"
gives "a smooth force has none" 0 "$motus" sweep osc.motus --vary F=0.1 --method dop853 --switches step -o smooth.csv --json
that "... and says so" holds '.switches == null'
printf "k = 1\nx'' = -max(0, k x)^1.5\nx(0) = 1\nx'(0) = 0\nuntil 2\n" >beyond.motus
gives "a force that may be undefined beyond a switch" 0 "$motus" sweep beyond.motus --vary k=1,2 --method dop853 -o beyond.csv --json
that "... is led across" eval "holds '.switches == \"step\"' && says 'the force may be undefined beyond one' '$err'"
refuses "--resume of something else" 2 "is not the beginning of a sweep" "$motus" sweep "${ask[@]}" -o values.csv --resume
gives "--force" 0 "$motus" sweep line.motus --vary a=1 -o part.csv --force
that "... replaces" eval "[ \$(rows part.csv | wc -l) = 1 ]"

# Interrupted by a limit on the size of files, by a full disk, by signals.
long=(osc.motus --vary F=0:0.5:3000 --record "final,energy" --until 0.05)
sweep "${long[@]}" -o long.csv -q
resume_long() { sweep "${long[@]}" -o "$1" --resume -q && cmp long.csv "$1"; }
(ulimit -f 100; sweep "${long[@]}" -o full.csv) >"$out" 2>"$err"
that "a file that cannot grow: exit status 1, and why" eval "[ $? = 1 ] && says 'cannot write full.csv: File too large' '$err'"
that "... what is there, and how to go on" eval "says 'of 3000 trajectories are in full.csv' '$err' && says --resume '$err'"
that "... whole rows, as many as it says" eval "[ -z \"\$(tail -c 1 full.csv | tr -d '\n')\" ] && [ \$(rows full.csv | wc -l) = \$(grep -o '^motus: [0-9]* of' '$err' | tr -dc 0-9) ]"
that "... all of them right" cmp -n "$(stat -c %s full.csv)" full.csv long.csv
that "... finished to the same bytes" resume_long full.csv
refuses "a full disk" 1 "cannot write /dev/full: No space left" "$motus" sweep line.motus --vary a=1 -o /dev/full
sweep line.motus --vary a=1 >/dev/full 2>"$err"
that "a full standard output" eval "[ $? = 1 ] && says 'standard output' '$err'"
mkdir small
if mount -t tmpfs -o size=64k none small 2>/dev/null; then
    sweep "${long[@]}" -o small/full.csv >"$out" 2>"$err"
    that "a full file system" eval "[ $? = 1 ] && says 'No space left' '$err' && [ \$(rows small/full.csv | wc -l) -gt 100 ]"
    cp small/full.csv full.csv
    that "... all of them right" cmp -n "$(stat -c %s full.csv)" full.csv long.csv
    rm small/full.csv
    sweep "${long[@]}" -o small/full.npy >"$out" 2>"$err"
    that "... a .npy too" eval "[ \$(((\$(stat -c %s small/full.npy) - 128) % 56)) = 0 ] && head -c 128 small/full.npy | grep -aqF \"(\$(((\$(stat -c %s small/full.npy) - 128) / 56)), 7)\""
    umount small
    that "... finished elsewhere" resume_long full.csv
fi
# Slow on any machine: many steps, by the interpreter, one trajectory at a time.
slow=(osc.motus --vary F=0:0.2:20000 --until 20 --machine interpreter --threads 1 --lanes 1)
for signal in KILL INT TERM HUP; do
    [ -n "$(trap -p "$signal")" ] && continue           # the parent process ignores it, so the program does too
    rm -f stopped.csv
    (trap - INT; exec "$motus" sweep "${slow[@]}" -o stopped.csv >"$out" 2>"$err") &
    child=$!
    for _ in $(seq 500); do [ "$(wc -l 2>/dev/null <stopped.csv)" -gt 5 ] 2>/dev/null && break; sleep 0.02; done
    kill -$signal $child
    wait $child 2>/dev/null
    status=$?
    that "SIG$signal: the program dies of it" test $status = $((128 + $(kill -l $signal)))
    count=$(rows stopped.csv | wc -l)
    that "... and leaves rows ($count)" test "$count" -gt 0 -a "$count" -lt 20000
    if [ $signal != KILL ]; then
        that "... whole ones" eval "[ -z \"\$(tail -c 1 stopped.csv | tr -d '\n')\" ]"
        that "... and says how to go on" eval "says '$count of 20000 trajectories are in stopped.csv; the same command with --resume continues' '$err'"
    fi
    sweep osc.motus --vary "F=@stopped.csv:F" --until 20 --record final -q >"$out"
    that "... right ones" cmp <(rows stopped.csv | head -n "$count" | cut -d, -f 1-4) <(rows | cut -d, -f 1-4)
done
cp stopped.csv twice.csv && cp stopped.csv.check twice.csv.check
(exec "$motus" sweep "${slow[@]}" -o twice.csv --resume >/dev/null 2>&1) &
child=$!
for _ in $(seq 500); do [ "$(wc -l 2>/dev/null <twice.csv)" -gt $((count + 5)) ] && break; sleep 0.02; done
refuses "two at one file" 1 "is being written by another program" "$motus" sweep "${slow[@]}" -o twice.csv --resume
kill $child
wait $child 2>/dev/null
sweep "${long[@]}" -q 2>"$err" | head -n 3 >"$out"
that "a reader that goes away" eval "[ \$(wc -l <'$out') = 3 ] && empty '$err'"

# --- why trajectories stop ------------------------------------------------------------------------------------------------------
# CAUSE, the lines of a model with a parameter c, the values of c: every trajectory ends as its run without errors does,
# however it is computed.
model() { local name=$1; shift; printf '%s\n' "$@" >"$name.motus"; }
model pole "x'' = c*6*x^2" "c = 1" "x(0) = 1" "x'(0) = 2"
model relaxes "x'' = -1e10*(x' - cos(t)) + c" "c = 0" "x(0) = 1" "x'(0) = 1"
model rubs "x'' = -x - c*sign(x')" "c = 0.5" "x(0) = 3" "x'(0) = 0"
model pushes "y'' = -9.81*c" "c = 1" "y(0) = 1" "y'(0) = 0" "when y = 0 falling as bounce: y' = -y', record" "when y' > 0 as back: y' = -y'"
model solves "x'' = -c*x^3" "c = 1" "x(0) = 10" "x'(0) = 0"
model noise "x'' = -c*x" "e' = x'*((x+0.3)-0.3-x)" "c = 1" "x(0) = 1" "x'(0) = 0" "e(0) = 0"
model grows "x'' = c*x" "c = 1" "x(0) = 1" "x'(0) = 1"
model pol "x'' = c*1000*(1 - x^2)*x' - x" "c = 1" "x(0) = 2" "x'(0) = 0"
model prints "x'' = -c*sign(x) + 0.1*cos(t)" "c = 1" "x(0) = 1" "x'(0) = 0"
model fast "x'' = -c*x + sin(1e8*t)" "c = 1" "x(0) = 1" "x'(0) = 0"
# "time cause" of the trajectories of out, and of the run with c
ends() { rows "$1" | awk -F, '{ print $(NF-1), $NF }'; }
end_of() { "$motus" run "$1" --set "c=$2" "${@:3}" --error none --json | jq -sr '.[-1] | if .diagnosis then "\(.diagnosis.time) \(.diagnosis.cause)" else " " end'; }
same_ends() {
    local cause=$1 values=$2 how machine c
    shift 2
    for c in ${values//,/ }; do end_of "$1" "$c" "${@:2}"; done >runs.ends
    that "$cause: $* fails by it" grep -q " $cause\$" runs.ends
    for machine in "--machine interpreter --threads 1" "--machine compiled" "--machine compiled --lanes 1 --threads 2"; do
        "$motus" sweep "$@" --vary "c=$values" $machine -q >"$out"
        that "... $machine: as the runs" cmp <(ends "$out") runs.ends
    done
}
same_ends singular 1,1.5,0 pole.motus --until 3 --method dop853
same_ends singular 1,1.5,0 pole.motus --until 3 --method rk4 --step 0.01
same_ends stiff 0,1 relaxes.motus --until 1000 --method dopri5
same_ends stiff 1,2 pol.motus --until 20 --method rk4 --step 0.01
same_ends discontinuous 0.5,0 rubs.motus --until 30 --method dop853 --switches step
same_ends events 1,2 pushes.motus --until 3 --method dop853
same_ends newton 1,0.001 solves.motus --until 30 --method gauss4 --step 2
same_ends rounding 1,2 noise.motus --until 30 --method dopri5
same_ends infinite 1,0.5 grows.motus --until 800 --method dop853
sweep prints.motus --vary c=1:2:3 --accuracy 1e-5 --shortest-step 0.05 --until 10 -q >"$out"
that "with errors told: the cause of steps that end at switches" is "$(ends "$out" | awk '{ print $2 }' | tr "\n" " ")" "  discontinuous "
sweep fast.motus --vary c=1,2 --until 1e6 --method dopri5 --most-steps 1000 -q >"$out"
that "a failure of which no cause is known has a time and no word" eval "[ \"\$(ends '$out' | grep -c '^[0-9.e-]* \$')\" = 2 ]"
causes=(pole.motus --vary c=1,0,1.5,2 --until 3 --method dop853)
sweep "${causes[@]}" -o causes.csv --json >"$out"
row_checks causes.csv causes.rows
that "JSON counts the causes" holds '.stopped == 3 and .stopped_by == {"singular": 3}'
resumed_causes() {
    local n
    for n in $(seq "$(rows causes.csv | wc -c)"); do
        head -c "-$n" causes.csv >cut.csv && cp causes.rows cut.csv.check
        sweep "${causes[@]}" -o cut.csv --resume --json >"$out" && cmp causes.csv cut.csv && holds '.stopped == 3 and .stopped_by == {"singular": 3}' || { echo "without $n bytes"; return 1; }
    done
}
that "... after a cut at every byte of the rows too" resumed_causes
sweep "${causes[@]}" -o causes.npy -q
that "a .npy has their numbers" eval "[ \"\$(od -An -v -t f8 -w48 -j 128 causes.npy | awk '{ print \$NF + 0 }' | tr '\n' ' ')\" = '1 0 1 1 ' ] && jq -e '.causes[1] == \"singular\" and .causes[0] == \"\"' causes.npy.json"
sweep "${causes[@]}" -o causes.npy --resume --json >"$out"
that "... and JSON counts those that are found" holds '.stopped_by == {"singular": 3} and .resumed == 4'

# --- which event ended them -----------------------------------------------------------------------------------------------------
model drops "e = 0.5" "c = 1" "y'' = -1" "y(0) = c" "y'(0) = 0" "when y = 0 falling as bounce: y' = -e y'" "when y > 0.9 and t > 2 as high: stop" "when t = 3 as third: record" "until 6"
drops=(drops.motus --vary e=0.5,0.9,1,0.3 --record "t, ended, y" --method dop853 --tolerance 1e-9)
sweep "${drops[@]}" -o drops.csv -q 2>"$err"
that "--record ended is a column before stopped" is "$(names drops.csv)" "index,e,t,y,ended,stopped,stopped_by"
that "... accumulated, nothing, stopped, accumulated" is "$(rows drops.csv | cut -d, -f5 | tr '\n' ' ')" "bounce  high bounce "
ended_of() { local e; for e in 0.5 0.9 1 0.3; do "$motus" run drops.motus --set e=$e --method dop853 --tolerance 1e-9 --until 6 --error none --json 2>"$err" | jq -r '.ended // ""'; done; }
that "... as the runs" cmp <(rows drops.csv | cut -d, -f5) <(ended_of)
for how in "--threads 1" "--threads 2" "--machine interpreter" "--machine compiled"; do
    # shellcheck disable=SC2086
    sweep "${drops[@]}" $how -o same.csv --force -q 2>"$err"
    that "the same bytes with $how" cmp drops.csv same.csv
done
row_checks drops.csv drops.rows
resumed_ends() {
    local n
    for n in $(seq "$(rows drops.csv | wc -c)"); do
        head -c "-$n" drops.csv >cut.csv && cp drops.rows cut.csv.check
        sweep "${drops[@]}" -o cut.csv --resume -q 2>"$err" && cmp drops.csv cut.csv || { echo "without $n bytes"; return 1; }
    done
}
that "... after a cut at every byte of the rows too" resumed_ends
sed '$s/bounce/bounces/' drops.csv >wrong.csv && cp drops.rows wrong.csv.check
sweep "${drops[@]}" -o wrong.csv --resume -q 2>"$err"
that "a row with an event that there is not is computed again" cmp drops.csv wrong.csv
refuses "without ended it is another sweep" 2 "drops.csv was made by another sweep" "$motus" sweep "${drops[@]}" --record "t, y" -o drops.csv --resume
sweep "${drops[@]}" -o drops.npy -q 2>"$err"
that "a .npy has their numbers" is "$(od -An -v -t f8 -w56 -j 128 drops.npy | awk '{ print $5 + 0 }' | tr '\n' ' ')" "1 0 2 1 "
that "... and their words beside it" eval "jq -e '.events == [\"\", \"bounce\", \"high\", \"third\"] and .columns[4] == \"ended\"' drops.npy.json"
sweep "${drops[@]}" --errors -o errors.csv -q 2>"$err"
that "... behind the errors" is "$(names errors.csv)" "index,e,t,y,y.error,significant,ended,stopped,stopped_by"
that "... the same" cmp <(rows errors.csv | cut -d, -f7) <(rows drops.csv | cut -d, -f5)
sweep "${drops[@]}" --record ended -o only.csv -q 2>"$err"
that "ended alone" is "$(rows only.csv | tr '\n' ' ')" "0,0.5,bounce,, 1,0.9,,, 2,1,high,, 3,0.3,bounce,, "
sweep drops.motus --vary e=0.5,1 --record ended --accuracy 1e-6 -q >"$out" 2>"$err"
that "... with an accuracy" is "$(rows | tr '\n' ' ')" "0,0.5,bounce,, 1,1,high,, "
sweep osc.motus --vary F=0.1,0.2 --record ended --until 1 -q >"$out" 2>"$err"
that "... of a model without events, empty" is "$(rows | tr '\n' ' ')" "0,0.1,,, 1,0.2,,, "
model own "x'' = -x" "x(0) = 1" "x'(0) = 0" "ended = 2*x" "f = 1" "until 1" "step 0.1" "method rk4"
sweep own.motus --vary f=1 --record "ended, x" -q >"$out" 2>"$err"
that "a quantity of the model with that name goes first" eval "[ '$(names)' = index,f,ended,x,stopped,stopped_by ] && rows | awk -F, '{ exit \$3 != 2*\$4 }'"
refuses "it is not a number to reduce" 2 "there is no column ended" "$motus" sweep "${drops[@]}" --record "max(ended)" -o no.csv
model none "y'' = -1" "a = 1" "y(0) = sqrt(a)" "y'(0) = 0" "when y = 0 falling as bounce: record, stop" "method rk4" "step 0.25" "until 6"
sweep none.motus --vary a=1,-1 --record ended --threads 1 --events begins.csv -q >"$out" 2>"$err"
that "a trajectory without a beginning has no events of another one" eval "[ \$(grep -c '^[0-9]*,bounce' begins.csv) = 1 ] && [ '$(rows | cut -d, -f3 | tr '\n' ' ')' = 'bounce  ' ]"

# --- events of the command ------------------------------------------------------------------------------------------------------
added=(drops.motus --vary e=0.5,0.9 --record "t, ended" --method dop853 --tolerance 1e-9 --when "y' = 0 falling as top: stop after 2" --section "y = 0.3" --points 3)
sweep "${added[@]}" -o added.csv -q 2>"$err"
that "the first line has --when, --section and --points" is "$(head -n 1 added.csv)" \
    "# motus sweep drops.motus --vary e=0.5,0.9 --when 'y'\\'' = 0 falling as top: stop after 2' --section 'y = 0.3' --points 3 --record 't, ended' --method dop853 --tolerance 1e-09 --until 6"
sh -c "$(head -n 1 added.csv | sed "s|^# motus|'$motus'|") -q" >"$out" 2>"$err"
that "... and makes the same bytes" cmp added.csv "$out"
that "... what they add ends trajectories" is "$(rows added.csv | cut -d, -f4 | tr '\n' ' ')" "top section "
sweep "${added[@]}" -o added.npy -q 2>"$err"
that "... beside a .npy too" eval "jq -e '.command | contains(\"--section\") and contains(\"--when\")' added.npy.json"
sweep "${added[@]}" --skip 1 --points 2 -o same.csv --force -q 2>"$err"
that "points that are skipped count for the end alone" cmp added.csv same.csv
cp added.csv kept.csv
for change in "--when|y = 0.2 as low: record" "--section|y = 0.4" "--points|2"; do
    refuses "--resume with another ${change%%|*}" 2 "added.csv was made by another sweep" "$motus" sweep "${added[@]}" "${change%%|*}" "${change#*|}" -o added.csv --resume
    that "... the file stays" cmp added.csv kept.csv
done

# --- .npy ------------------------------------------------------------------------------------------------------------------------
gives ".npy" 0 "$motus" sweep "${ask[@]}" -o whole.npy --json
that "... is float64 in rows" eval "head -c 10 whole.npy | od -An -tx1 | tr -d ' ' | grep -qx 934e554d505901007600 && head -c 128 whole.npy | grep -aqF \"{'descr': '<f8', 'fortran_order': False, 'shape': (14, 7), }\""
that "... and nothing else" eval "[ \$(stat -c %s whole.npy) = \$((128 + 14*7*8)) ]"
number() { od -An -v -t f8 -w8 -j "$((128 + 8*($1*7 + $2)))" -N 8 whole.npy | tr -d ' '; }
that "... its numbers are those of the CSV" eval "[ \$(number 9 0) = 9 ] && rows whole.csv | sed -n 10p | tr ',' '\n' | head -n 5 >a && for k in 0 1 2 3 4; do number 9 \$k; done >b && paste a b | awk '{ d = \$1 - \$2; bad += d*d > 1e-28 } END { exit bad || NR != 5 }'"
that "... what did not stop says nan" eval "number 9 5 | grep -qi nan"
that "... the names stand beside it" eval "json whole.npy.json && jq -e '.columns == [\"index\",\"F\",\"w\",\"x\",\"max(energy)\",\"stopped\",\"stopped_by\"] and .trajectories == 14' whole.npy.json"
size=$(stat -c %s whole.npy)
row_checks whole.npy whole.rows 56
npy_resumed() {              # bytes left
    head -c "$1" whole.npy >cut.npy && cp whole.npy.json cut.npy.json && cp whole.rows cut.npy.check && sweep "${ask[@]}" -o cut.npy --resume -q && cmp whole.npy cut.npy
}
npy_everywhere() { local n; for n in "$@"; do npy_resumed "$n" || { echo "cut at $n"; return 1; }; done; }
that ".npy resumed after a cut at every byte of the last two rows" npy_everywhere $(seq $((size - 112)) "$size")
that "... in the head" npy_everywhere 0 1 64 127 128 129
(ulimit -c 0 -f 100; sweep "${long[@]}" -o killed.npy -q) >"$out" 2>&1
that ".npy killed in a write: its head tells how many rows are there" eval "n=\$(head -c 128 killed.npy | grep -aoE '\(([0-9]+), 7\)' | tr -dc '0-9,' | cut -d, -f1); [ \$n -gt 0 ] && [ \$((128 + n*56)) -le \$(stat -c %s killed.npy) ]"
sweep "${long[@]}" -o long.npy -q
that "... finished to the same bytes" eval "sweep \"\${long[@]}\" -o killed.npy --resume -q && cmp long.npy killed.npy && cmp long.npy.json killed.npy.json"
refuses "--resume of another .npy" 2 "was made by another sweep" "$motus" sweep "${ask[@]}" --step 0.02 -o whole.npy --resume
rm cut.npy.json
refuses "--resume of a .npy whose text is gone" 1 "cannot read cut.npy.json" "$motus" sweep "${ask[@]}" -o cut.npy --resume
cp whole.npy.json cut.npy.json
# Rows that were changed, or moved by bytes that were put in or taken out, are not taken.
changed() {                  # kind, a command that changes $1 at byte $2
    local kind=$1 at
    for at in 400 600 $(($(stat -c %s "whole.$kind") - 40)); do
        cp "whole.$kind" "cut.$kind"
        $python -c "
b = bytearray(open('cut.$kind', 'rb').read()); at = $at
while '$kind' == 'csv' and not 49 <= b[at] <= 57: at += 1
$2
open('cut.$kind', 'wb').write(b)"
        cp "$3" "cut.$kind.check"
        sweep "${ask[@]}" -o "cut.$kind" --resume 2>"$err" >"$out" && cmp "whole.$kind" "cut.$kind" && cmp "whole.$kind.check" "cut.$kind.check" && says "cut.$kind is damaged: only its first" "$err" || { echo "at $at: $(cat "$err")"; return 1; }
    done
}
row_checks whole.csv csv.rows
for kind in csv npy; do
    for rows in whole.$kind.check $([ $kind = csv ] && echo csv.rows || echo whole.rows); do
        that ".$kind with a digit that was changed, by $rows" changed $kind 'b[at] ^= 1' $rows
        that "... with a byte too many" changed $kind 'b[at:at] = b[at:at + 1]' $rows
        that "... with a byte too few" changed $kind 'del b[at]' $rows
        that "... with 8 bytes too many" changed $kind 'b[at:at] = b[at:at + 8]' $rows
    done
    cp whole.$kind cut.$kind && rm cut.$kind.check
    refuses "--resume of a .$kind without its checks" 2 "cut.$kind has rows, but cut.$kind.check is missing" "$motus" sweep "${ask[@]}" -o cut.$kind --resume
    that "... the file stays" cmp whole.$kind cut.$kind
    echo something >cut.$kind.check
    refuses "a file that has their name" 2 "cut.$kind.check is another file" "$motus" sweep "${ask[@]}" -o cut.$kind --force
done
refuses "a .npy that is there" 2 "whole.npy exists" "$motus" sweep "${ask[@]}" -o whole.npy

# --- JSON and text ------------------------------------------------------------------------------------------------------------
gives "--json" 0 "$motus" sweep blow.motus --vary k=-1,3 -o blow.csv --force --json
that "... is JSON" json "$out"
for key in model method step trajectories resumed steps machine compiled_from lanes threads note switches fast seconds wall stopped stopped_by output; do that "sweep: key $key" holds "has(\"$key\")"; done
that "sweep: what it says of itself" holds '.trajectories == 2 and .steps == 400 and .stopped == 1 and .output == "blow.csv" and .lanes >= 1 and .threads >= 1 and .seconds > 0 and .wall >= .seconds and .resumed == 0 and .fast == false and .method == "rk4" and .step == 0.01'
gives "for people" 0 "$motus" sweep line.motus --vary a=1:2:5 -o line.csv
that "... how many, how long" eval "says '5 trajectories' && says 'line.csv: 6 columns'"
gives "--quiet" 0 "$motus" sweep blow.motus --vary k=3 -o quiet.csv --quiet
that "... is quiet" eval "empty '$out' && empty '$err'"
gives "--threads and --lanes" 0 "$motus" sweep line.motus --vary a=1:2:64 -o t.csv --threads 1 --lanes 1 --json
that "... are taken" holds '.threads == 1 and .lanes == 1'
if command -v script >/dev/null; then
    script -qec "timeout 2 '$motus' sweep osc.motus --vary F=0:0.2:2000000 --until 20 --machine interpreter --threads 1 --lanes 1 -o bar.csv" /dev/null </dev/null >"$out" 2>&1
    that "a bar and a rate on a terminal" grep -qE 'sweep +[0-9]+ % \[[#.]{20}\] [0-9.e+]+ trajectories/s' "$out"
fi
# A clock that goes a hundred times as fast: two seconds are three minutes of a batch job.
cat >fast.c <<'C'
#define _GNU_SOURCE
#include <dlfcn.h>
#include <time.h>
int clock_gettime(clockid_t which, struct timespec *at)
{
    static int (*real)(clockid_t, struct timespec *);
    if (!real) real = (int (*)(clockid_t, struct timespec *))dlsym(RTLD_NEXT, "clock_gettime");
    const int code = real(which, at);
    at->tv_nsec *= 100, at->tv_sec *= 100;
    at->tv_sec += at->tv_nsec / 1000000000, at->tv_nsec %= 1000000000;
    return code;
}
C
if "${CC:-cc}" -shared -fPIC -O1 -w fast.c -o fast.so -ldl && ! nm "$motus" 2>/dev/null | grep -q __asan; then
    LD_PRELOAD=$PWD/fast.so timeout 3 "$motus" sweep osc.motus --vary F=0:0.2:2000000 --until 20 --machine interpreter --threads 1 --lanes 1 -o log.csv >"$out" 2>"$err"
    that "in the log of a batch job a line a minute" eval "[ \$(grep -cE '^motus: sweep +[0-9]+ %, [0-9.e+]+ trajectories/s(, [0-9]+ s left)?$' '$err') -ge 2 ] && [ \$(grep -c 'motus: sweep' '$err') -le 6 ]"
    LD_PRELOAD=$PWD/fast.so timeout 3 "$motus" sweep osc.motus --vary F=0:0.2:2000000 --until 20 --machine interpreter --threads 1 --lanes 1 -o log.csv -q --force >"$out" 2>"$err"
    that "... --quiet has none" eval "lacks 'sweep' '$err'"
fi

# --- plans --------------------------------------------------------------------------------------------------------------------
for kind in csv npy h5; do
    gives "a plan of a .$kind" 0 "$motus" sweep line.motus --vary a=1:2:200000 --record "x,x',max(x)" -o plan.$kind --plan --json
    that "... is JSON, and writes nothing" eval "json '$out' && absent plan.$kind"
    that "... of all trajectories and blocks" holds '.trajectories == 200000 and .blocks == 49 and .block == 4096'
    that "... from a sample of a ten-thousandth and more" holds '.sample.trajectories >= 20 and .sample.trajectories <= 200000 and .sample.seconds > 0'
    that "... by which the hours follow" holds '. as $p | all(.ranks[]; (.hours * 3600 - $p.sample.each * ([200000 / .ranks, 4096] | max)) | fabs < 1e-9)'
    bytes=$(jq .bytes "$out")
    if "$motus" sweep line.motus --vary a=1:2:200000 --record "x,x',max(x)" -o plan.$kind -q 2>"$err"; then
        that "... the file has that size, to 1 %" near "$bytes" "$(stat -c %s plan.$kind)" "$(($(stat -c %s plan.$kind) / 100))"
    else
        that "... this motus makes no archives" says "without HDF5" "$err"
    fi
done
gives "a plan for people" 0 "$motus" sweep line.motus --vary a=1:2:1e9 -o huge.npy --plan
that "... says blocks, size and the time on many ranks" eval "says '1000000000 trajectories, in 244141 blocks of 4096' && says 'huge.npy, 6 columns, 48 GB' && grep -qE '^ +4096 +[0-9.]+ (s|min|h) ' '$out'"
that "... and writes nothing" absent huge.npy
# It waits for no compiler: none is asked for so little work.
gives "a plan of one block" 0 timeout 15 "$motus" sweep line.motus --vary a=1:2:5 --plan
that "... has nothing for a second rank" says "more than 1 ranks have nothing to do"
gives "a plan of a file that is there" 0 eval 'cp t.csv t.copy && "$motus" sweep line.motus --vary a=1:2:5 --plan -o t.csv'
that "... does not touch it" cmp t.csv t.copy
refuses "a plan of an empty shard" 2 "this shard has no trajectories" "$motus" sweep line.motus --vary a=1:2:5 --plan --shard 2/2

# --- memory -------------------------------------------------------------------------------------------------------------------------
# Three million trajectories of twelve columns would be 288 MB.
gives "memory does not grow with the number of trajectories" 0 bash -c \
    "ulimit -v 200000; '$motus' sweep line.motus --vary a=0:1:3000000 --record \"x,x',max(x),min(x),mean(x),time_of_max(x),max(x'),min(x'),mean(x')\" --machine interpreter --threads 1 -q >/dev/null"

# --- bad requests -----------------------------------------------------------------------------------------------------------------
bad() {                      # name, words, arguments
    local name=$1 words=$2
    shift 2
    refuses "$name" 2 "$words" "$motus" sweep "$@" -o nothing.csv
    [ -e nothing.csv ] && { not_ok "... leaves no file"; rm nothing.csv; }
}
bad "nothing varies" "needs --vary or --random" osc.motus
bad "--vary without a name" "this is not NAME=VALUE" osc.motus --vary 0:1:3
bad "an empty name" "this is not NAME=VALUE" osc.motus --vary "=0:1:3"
bad "a blank name" "the name is missing" osc.motus --vary " =0:1:3"
bad "an unknown name" "G" osc.motus --vary G=0:1:3
bad "a quantity" "energy" osc.motus --vary energy=0:1:3
bad "a range without a count" "the count is missing" osc.motus --vary F=0:1
bad "too many colons" "this is not a range" osc.motus --vary F=0:1:2:3
bad "log at the end" "log has to come first" osc.motus --vary F=1:10:5:log
for count in 0 -1 1.5 x '' 99999999999999999999; do bad "a count of '$count'" "--vary F=0:1:$count" osc.motus --vary "F=0:1:$count"; done
bad "one value at two ends" "a count of 1 needs FROM and TO to be equal" osc.motus --vary F=0:1:1
for ends in 0:1 -1:1 1:0; do bad "equal ratios from $ends" "a log range needs two ends of the same sign" osc.motus --vary "F=log:$ends:3"; done
bad "300 decades" "300 decades" osc.motus --vary F=log:1e-200:1e200:3
for number in x nan inf 1e999 0,1:2 1/0 '' 'sqrt(-1)' '(1' 'a b' 't' "1; x''=2" '(1, 2)'; do bad "a number '$number'" "--vary F=$number" osc.motus --vary "F=$number:1:3"; done
bad "a line break in a number" "" osc.motus --vary $'F=1\nx(0)=2:1:3'
that "... why is said" says "hint:" "$err"
bad "a hole in a list" "nothing is not a constant" osc.motus --vary F=1,,2
bad "varied twice" "F is varied twice" osc.motus --vary F=1,2 --vary F=3,4
bad "the end for all, and for each" "leave one out" osc.motus --vary until=1,2 --until 3
bad "an end too far" "until, value 2 of 2" osc.motus --vary until=1,1e17
bad "an end within a step of equal ones" "until, value 2 of 2" osc.motus --vary until=1,1.001 --method verlet-literal
bad "set and varied" "F is both set and varied" osc.motus --vary F=1,2 --set F=3
bad "--zip of different lengths" "F has 2 values, w has 3" osc.motus --vary F=1,2 --vary w=1,2,3 --zip
bad "--zip of one" "--zip needs at least two" osc.motus --vary F=1,2 --zip
bad "too many" "trajectories" osc.motus --vary F=0:1:1e9 --vary w=0:1:1e9
bad "--random without --count" "--random needs --count" osc.motus --random F=0:1
bad "--count without --random" "--count needs --random" osc.motus --vary F=1,2 --count 3
bad "--seed without --random" "--seed needs --random" osc.motus --vary F=1,2 --seed 3
for seed in -1 x 1.5 18446744073709551616 ''; do bad "--seed '$seed'" "--seed" osc.motus --random F=0:1 --count 2 --seed "$seed"; done
bad "a distribution that is none" "this is not a distribution" osc.motus --random F=gamma:1:2 --count 2
bad "a negative deviation" "deviation is negative" osc.motus --random F=normal:1:-2 --count 2
bad "a draw of a list" "this is not a distribution" osc.motus --random F=1,2 --count 2
bad "an unknown record" "did you mean max(...)?" osc.motus --vary F=1,2 --record "mx(x)"
bad "a record of nothing known" "xx" osc.motus --vary F=1,2 --record "max(xx)"
bad "a record of an unknown name" "energi" osc.motus --vary F=1,2 --record energi
bad "a hole in --record" "a name is missing" osc.motus --vary F=1,2 --record x,,energy
bad "--every between steps" "not a multiple of the step" osc.motus --vary F=1,2 --record "max(x)" --every 0.013
for threads in 0 -1 x 99999999999; do bad "--threads $threads" "--threads" osc.motus --vary F=1,2 --threads "$threads"; done
bad "--machine abacus" "unknown value" osc.motus --vary F=1,2 --machine abacus
bad "a method that does not fit" "pefrl" "$root/models/damped-cubic.motus" --vary "x(0)=1,2" --method pefrl
bad "--columns" "motus sweep takes no --columns" osc.motus --vary F=1,2 --columns x
bad "--force and --resume" "exclude each other" osc.motus --vary F=1,2 --force --resume
refuses "--resume of standard output" 2 "--resume needs a file" "$motus" sweep osc.motus --vary F=1,2 --resume
gives "--json and rows on standard output" 2 "$motus" sweep osc.motus --vary F=1,2 --json
that "... is an error object" holds '.error.kind == "argument"'
refuses "the model as output" 2 "would be overwritten" "$motus" sweep osc.motus --vary F=1,2 -o osc.motus --force
refuses "the values as output" 2 "values.csv is read and would be overwritten" "$motus" sweep osc.motus --vary F=@values.csv:n -o values.csv --force
refuses "a folder as output" 1 "is a folder" "$motus" sweep osc.motus --vary F=1,2 -o small
refuses "a folder that is not there" 1 "cannot write" "$motus" sweep osc.motus --vary F=1,2 -o nowhere/x.csv
refuses "a .npy that is a device" 2 "not a regular file" bash -c "ln -s /dev/null null.npy && '$motus' sweep osc.motus --vary F=1,2 -o null.npy"
refuses "values from nowhere" 1 "cannot read nowhere.csv" "$motus" sweep osc.motus --vary F=@nowhere.csv:1 -o nothing.csv
refuses "values from a folder" 1 "cannot read small" "$motus" sweep osc.motus --vary F=@small:1 -o nothing.csv
bad "values without a column" "values.csv has several columns" osc.motus --vary F=@values.csv
bad "an unknown column" "values.csv has no column c" osc.motus --vary F=@values.csv:c
bad "a column too far" "values.csv has no column 7" osc.motus --vary F=@values.csv:7
bad "a column of words" "values.csv:3: x is not a finite number" osc.motus --vary F=@values.csv:3
printf 'F\n1\nnan\n' >nan.csv
bad "a value that is none" "nan.csv:3: nan is not a finite number" osc.motus --vary F=@nan.csv:F
: >void.csv
bad "no values" "void.csv holds no values" osc.motus --vary F=@void.csv:1
head -c 5000 /dev/urandom >noise.csv
bad "a file of noise" "noise.csv" osc.motus --vary F=@noise.csv:1
that "nothing was left behind" eval "absent nothing.csv && nothing_left ."

# --- a step that nobody gives -----------------------------------------------------------------------------------------------------
# At pi/2 the linearised pendulum does not move; on its way it has the rate sqrt(9.81), 3.13.
printf "x'' = -9.81 sin(x)\nx(0) = pi/2\nx'(0) = 0\n" >pendulum.motus
sweep pendulum.motus --vary "x(0)=pi/2,pi/3,1" --until 1000 >"$out" 2>"$err"
that "a sweep takes the fastest rate of its motions" eval "grep -qx 'step 0.02' '$err' && grep -q 'the fastest rate of the motions at the ends of what varies, 3\.' '$err'"
that "... and no pendulum leaves its swing" eval "column 3 | tr ' ' '\n' | awk 'NF && (\$1 > 1.58 || \$1 < -1.58) { exit 1 }'"
sed "s/^θ1(0).*/θ1(0) = pi\/2/; s/^θ2(0).*/θ2(0) = pi\/2/" "$root/models/double-pendulum.motus" | grep -v '^method\|^step\|^until' >double.motus
sweep double.motus --vary "θ1(0)=pi/2,1.5,1.6" --until 20 --json -o double.csv >"$out" 2>"$err"
that "a double pendulum goes to its end" holds '.stopped == 0 and .suggested.step <= 0.01'
# k is 1 in the model: the step is for the end of the sweep, whatever part of it is computed, in whatever order
printf "k = 1\nx'' = -k x\nx(0) = 1\nx'(0) = 0\nuntil 10\n" >stiffness.motus
for values in "k=1:100:200" "k=100:1:200" "k=@k.csv:k" "k=log:1:100:50"; do
    { echo k; seq 1 40; echo 100; seq 41 50; } >k.csv
    for part in 1/3 2/3 3/3; do
        sweep stiffness.motus --vary "$values" --shard $part -o /dev/null --force >/dev/null 2>"$err"
        that "the step is that of the stiffest, $values, part $part" grep -qx 'step 0.005' "$err"
    done
done
sweep stiffness.motus --random k=1:100 --count 50 -o /dev/null --force >/dev/null 2>"$err"
that "... of draws" grep -qx 'step 0.005' "$err"
sweep stiffness.motus --vary k=1:100:20 --vary "x(0)=1:2:20" --zip -o /dev/null --force >/dev/null 2>"$err"
that "... of axes that go together" grep -qx 'step 0.005' "$err"
printf "a = 1; b = 1; c = 1; d = 1; e = 1; f = 1\nx'' = -a b c d e f x\nx(0) = 1\nx'(0) = 0\nuntil 10\n" >six.motus
sweep six.motus --vary a=1:4:2 --vary b=1,2 --vary c=1,1 --vary d=1,1,1 --vary e=2,1 --vary f=1:2:2 -o /dev/null --force >/dev/null 2>"$err"
that "... of six axes" grep -qx 'step 0.01' "$err"

echo "$passed passed, $failed failed"
[ $failed = 0 ]
