#!/bin/bash
# Shards of a sweep and motus merge: the bytes of the one sweep, whatever the division, the order and the interruptions; and what is refused.
#
# Each case is one line `ok` or `not ok`; the last line counts them. MOTUS is the program (build/motus).
cd "$(dirname "$0")/.." || exit 1
. test/cli/cases.sh
cd "$place" || exit 1

cat >swing.motus <<'M'
g = 1
theta'' = -g sin(theta)
theta(0) = 1
theta'(0) = 0
method verlet
step 0.5
until 4
M
cat >ball.motus <<'M'
e = 0.5
y'' = -1
y(0) = 1
y'(0) = 0
when y = 0 falling as bounce: record, y' = -e y'
method rk4
step 0.25
M
sweep() { "$motus" sweep "$@"; }
same() { cmp "$1" "$2"; }

# --- the bytes of the one sweep -------------------------------------------------------------------------------------------------
# 9000 trajectories are two blocks of 4096 and one of 808; of five shards two have none
vary=(swing.motus --vary "g=0.5:2:9000" --record "final, max(theta)" -q)
sweep "${vary[@]}" -o all.csv
sweep "${vary[@]}" -o all.npy
for count in 2 3 5; do
    for kind in csv npy; do
        rm -f part*
        for ((k = 1; k <= count; k++)); do sweep "${vary[@]}" --shard $k/$count -o "part%K.$kind"; done
        files=($(ls part*.$kind | sort -r))
        gives "$count shards as $kind are merged" 0 "$motus" merge "${files[@]}" -o merged.$kind --force
        that "  to the bytes of one sweep" same merged.$kind all.$kind
        that "  with their checks" same merged.$kind.check all.$kind.check
        if [ $kind = npy ]; then that "  with what is beside it" same merged.npy.json all.npy.json; fi
    done
done
that "a shard without a block has a head and no row" test "$(grep -c -v '^#' <(sweep "${vary[@]}" --shard 5/5))" = 1
for k in 1 2 3; do sweep "${vary[@]}" --shard $k/3 --threads $k --lanes 1 --machine interpreter -o "alone%K.csv"; done
"$motus" merge alone*.csv -o merged.csv --force -q
that "threads, lanes and machine of a shard change no byte" same merged.csv all.csv
gives "to standard output" 0 "$motus" merge alone*.csv -o - -q
that "  the same bytes" same "$out" all.csv
gives "as JSON" 0 "$motus" merge alone*.csv -o merged.csv --force --json
that "  one value" json "$out"
that "  with its shards" says '"shards": 3, "trajectories": 9000'
gives "shard 2 says what it has" 0 "$motus" sweep "${vary[@]::5}" --shard 2/3 -o "said.csv"
that "  4096 of 9000" says "4096 trajectories of 9000, shard 2/3"

# --- interruptions --------------------------------------------------------------------------------------------------------------
head -c 100000 alone2.csv >cut.csv && cp alone2.csv.check cut.csv.check
refuses "an interrupted shard is not merged" 2 "ends before its last trajectory: shard 2/3" "$motus" merge alone1.csv cut.csv alone3.csv -o no.csv
that "  and nothing is written" absent no.csv
gives "the same command with --resume" 0 "$motus" sweep "${vary[@]}" --shard 2/3 --resume -o cut.csv
that "  completes it to the same bytes" same cut.csv alone2.csv
refuses "another shard does not continue it" 2 "made by another sweep" "$motus" sweep "${vary[@]}" --shard 1/3 --resume -o cut.csv
refuses "nor does the whole sweep" 2 "made by another sweep" "$motus" sweep "${vary[@]}" --resume -o cut.csv
refuses "nor does a shard continue the whole sweep" 2 "made by another sweep" "$motus" sweep "${vary[@]}" --shard 1/3 --resume -o all.csv
refuses "nor of a .npy" 2 "made by another sweep" "$motus" sweep "${vary[@]}" --shard 1/3 --resume -o all.npy
# killed at any time, a shard is finished to the same bytes
long=(swing.motus --vary "g=0.5:2:12288" --until 400 -q)
sweep "${long[@]}" --shard 2/2 -o whole.csv
for delay in 0.01 0.02 0.04 0.08; do
    rm -f killed.csv killed.csv.check
    "$motus" sweep "${long[@]}" --shard 2/2 -o killed.csv &
    sleep $delay
    kill -9 $! 2>/dev/null
    wait $! 2>/dev/null
    sweep "${long[@]}" --shard 2/2 -o killed.csv --resume
    that "killed after $delay s and resumed" same killed.csv whole.csv
    that "  with their checks" same killed.csv.check whole.csv.check
done

# --- events ---------------------------------------------------------------------------------------------------------------------
vary=(ball.motus --vary "e=0.1:0.9:9000" --until 3 --record "y" -q)
sweep "${vary[@]}" -o rows.csv --events events.csv
for k in 1 2; do sweep "${vary[@]}" --shard $k/2 -o "row%K.csv" --events "event%K.csv"; done
gives "events of shards are merged" 0 "$motus" merge event2.csv event1.csv -o merged.csv --force
that "  to the bytes of one sweep" same merged.csv events.csv
that "  with their checks" same merged.csv.check events.csv.check
gives "and the rows" 0 "$motus" merge row2.csv row1.csv -o merged.csv --force
that "  too" same merged.csv rows.csv
sed '$d' event2.csv >cut.csv
refuses "events that do not end are not merged" 2 "ends before its last trajectory: shard 2/2" "$motus" merge event1.csv cut.csv -o no.csv
head -n 700 row2.csv >row-cut.csv && cp row2.csv.check row-cut.csv.check
head -n 3700 event2.csv >event-cut.csv && cp event2.csv.check event-cut.csv.check
sweep "${vary[@]}" --shard 2/2 -o row-cut.csv --events event-cut.csv --resume
that "rows and events of a shard are continued" same row-cut.csv row2.csv
that "  both" same event-cut.csv event2.csv
refuses "rows and events are two kinds" 2 "is a table of rows, but event2.csv is a table of events" "$motus" merge row1.csv event2.csv -o no.csv

# --- what ended trajectories ----------------------------------------------------------------------------------------------------
vary=(ball.motus --vary "e=0.1:0.9:9000" --until 3 --record "ended, y" --when "y > 0.5 and t > 2 as high: stop" -q)
for kind in csv npy; do
    sweep "${vary[@]}" -o ends.$kind
    for k in 1 2; do sweep "${vary[@]}" --shard $k/2 -o "end%K.$kind" --threads $k; done
    gives "shards with ended as $kind are merged" 0 "$motus" merge end2.$kind end1.$kind -o merged.$kind --force
    that "  to the bytes of one sweep" same merged.$kind ends.$kind
done
that "  with what is beside it" same merged.npy.json ends.npy.json
that "  the numbers have words there" eval "jq -e '.events == [\"\", \"bounce\", \"high\"]' ends.npy.json"
that "  each of the ends is there" test "$(grep -v '^#' ends.csv | tail -n +2 | cut -d, -f4 | sort -u | tr '\n' ' ')" = " bounce high "
vary=(ball.motus --vary "e=0.1:0.9:9000" --until 3 --record "y" -q)

# --- what is refused ------------------------------------------------------------------------------------------------------------
refuses "a missing shard is named" 2 "1 of 3 shards are missing: 2" "$motus" merge alone1.csv alone3.csv -o no.csv
cp alone1.csv cut1.csv
refuses "a shard given twice is named" 2 "alone1.csv and cut1.csv are both shard 1/3" "$motus" merge alone1.csv cut1.csv alone2.csv -o no.csv
refuses "a shard of another division" 2 "is shard 1/3, but row1.csv is shard 1/2" "$motus" merge alone1.csv row1.csv -o no.csv
sweep ball.motus --vary "e=0.1:0.9:9001" --until 3 --record y -q --shard 1/2 -o other.csv
refuses "a shard of another sweep" 2 "other.csv and row2.csv are from different sweeps" "$motus" merge other.csv row2.csv -o no.csv
refuses "a whole sweep" 2 "all.csv is a whole sweep, not a shard" "$motus" merge all.csv -o no.csv
refuses "a whole .npy" 2 "is not a shard, according to the .json beside it" "$motus" merge all.npy -o no.npy
refuses "a model" 2 "swing.motus is not the table of a sweep" "$motus" merge swing.motus -o no.csv
refuses "a file that is not there" 1 "cannot read none.csv" "$motus" merge none.csv -o no.csv
refuses "no file" 2 "no file to merge" "$motus" merge -o no.csv
refuses "no name for the merged file" 2 "-o is missing" "$motus" merge row1.csv row2.csv
refuses "one that exists" 2 "rows.csv exists" "$motus" merge row1.csv row2.csv -o rows.csv
refuses "a part as output" 2 "row2.csv is read and would be overwritten" "$motus" merge row1.csv row2.csv -o row2.csv --force
refuses "CSV as .npy" 2 "the shards are CSV" "$motus" merge row1.csv row2.csv -o no.npy
sed '6s/^[0-9]*/7/' row2.csv >damaged.csv
refuses "a row that is not in its place" 2 "damaged.csv is damaged: the row of trajectory" "$motus" merge row1.csv damaged.csv -o no.csv
{ cat row2.csv; tail -n 1 row2.csv; } >damaged.csv
refuses "a row too many" 2 "it continues after its last trajectory" "$motus" merge row1.csv damaged.csv -o no.csv
that "nothing of what was refused is written" absent no.csv
# What has another digit than its sweep wrote, or has bytes too many, is refused; what has no checks is taken, and that is said.
changed() {                  # file, copy, what is done to the digit b[at]
    cp "$1" "$2" && cp "$1.check" "$2.check" && $python -c "
b = bytearray(open('$2', 'rb').read()); at = len(b)*2//3
while not 49 <= b[at] <= 57: at += 1
$3
open('$2', 'wb').write(b)"
}
for change in 'b[at] ^= 1' 'b[at:at] = b[at:at + 1]' 'del b[at]'; do
    changed row2.csv damaged.csv "$change"
    refuses "rows changed by $change" 2 "damaged.csv is damaged: after byte" "$motus" merge row1.csv damaged.csv -o no.csv
    changed event2.csv damaged.csv "$change"
    refuses "events changed by $change" 2 "damaged.csv is damaged: after byte" "$motus" merge event1.csv damaged.csv -o no.csv
done
changed end2.npy damaged.npy 'b[at] ^= 1' && cp end2.npy.json damaged.npy.json
refuses "rows of a .npy" 2 "damaged.npy is damaged: after byte" "$motus" merge end1.npy damaged.npy -o no.npy
cp row2.csv damaged.csv && rm damaged.csv.check
gives "rows without checks" 0 "$motus" merge row1.csv damaged.csv -o merged.csv --force
that "  are said" says "damaged.csv.check is missing: the rows could not be checked" "$err"
for wrong in 0/3 4/3 3 a/3 3/ 1/3x 1/0 -1/3 1/99999999999999999999; do
    refuses "--shard $wrong" 2 "this is not a shard" "$motus" sweep "${vary[@]}" --shard "$wrong"
done
refuses "too many shards" 2 "at most 1000000 shards" "$motus" sweep "${vary[@]}" --shard 1/1000001

# --- Slurm ----------------------------------------------------------------------------------------------------------------------
array() { SLURM_ARRAY_TASK_ID=$1 SLURM_ARRAY_TASK_COUNT=$2 SLURM_ARRAY_TASK_MIN=$3 SLURM_ARRAY_TASK_MAX=$4 "${@:5}"; }
gives "a task of an array is a shard" 0 array 2 2 1 2 "$motus" sweep "${vary[@]}" --shard slurm -o "task%K.csv"
that "  with its number in the name" same task2.csv row2.csv
refuses "a task submitted again by itself is not" 2 "this array has tasks 7 to 7 (1 of them)" array 7 1 7 7 "$motus" sweep "${vary[@]}" --shard slurm
refuses "nor is an array from 0" 2 "this array has tasks 0 to 9 (10 of them)" array 3 10 0 9 "$motus" sweep "${vary[@]}" --shard slurm
refuses "nor a command outside an array" 2 "SLURM_ARRAY_TASK_ID is not a number in the environment" "$motus" sweep "${vary[@]}" --shard slurm

echo "$passed passed, $failed failed"
[ $failed = 0 ]
