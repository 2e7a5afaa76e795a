#!/bin/bash
# Archives of sweeps: what other programs read in them, kills and what --resume makes of them, shards, damage, a full disk.
#
# Each case is one line `ok` or `not ok`; the last line counts them. MOTUS is the program (build/motus).
cd "$(dirname "$0")/.." || exit 1
. test/cli/cases.sh

swing_until 10 >"$place/swing.motus"
swing=$place/swing.motus
sweep() { "$motus" sweep "$swing" --vary "x(0)=0.1:3:30000" --record "final,max(energy)" "$@"; }

if ! sweep --quiet -o "$place/whole.h5" 2>"$err" && says "without HDF5" "$err"; then
    refuses "without HDF5 an archive is refused" 2 "without HDF5" "$motus" sweep "$swing" --vary "x(0)=0.1:3:3" -o "$place/none.h5"
    echo "$passed passed, $failed failed"
    exit $((failed > 0))
fi

# --- what is in it --------------------------------------------------------------------------------------------------------------------
gives "a sweep into an archive" 0 sweep -o "$place/whole.h5" --force
that "... says how many columns it has" says "whole.h5: 7 columns"
gives "the same as CSV" 0 sweep -o "$place/whole.csv" --quiet
gives "h5py reads it" 0 $python - "$place/whole.h5" "$place/whole.csv" "$swing" <<'P'
import csv, h5py, math, sys
archive, table, model = sys.argv[1:]
rows = list(csv.reader(line for line in open(table) if not line.startswith('#')))
with h5py.File(archive) as f:
    assert f.attrs['motus_archive'] == 1 and f['model'][()].decode() == open(model).read()
    assert b'motus sweep' in f.attrs['command'] and len(f.attrs['fingerprint']) == 16, dict(f.attrs)
    assert rows[0] == ['index', 'x(0)', 'x', "x'", 'max(energy)', 'stopped', 'stopped_by'], rows[0]
    assert list(f['sweep/trajectory'][()]) == list(range(30000))
    for k, name in enumerate(rows[0][1:5], 1):
        assert all(float(row[k]) == value for row, value in zip(rows[1:], f['sweep'][name][()])), name
    assert all(math.isnan(value) for value in f['sweep/stopped'][()]) and not f['sweep/stopped_by'][()].any()
    comments = [f['sweep'][name].attrs.get('comment') for name in ('trajectory', 'x(0)', 'x', "x'", 'max(energy)', 'stopped')]
    assert comments == [None, b'rad', b'rad', None, b'per mass', None], comments
    assert f['sweep/x'].dims[0][0] == f['sweep/trajectory'] and (f['blocks/done'][()] != 0).all() and len(f['blocks/done']) == 8
P
gives "xarray reads it, and pandas" 0 $python - "$place/whole.h5" <<'P'
import sys, xarray
data = xarray.open_dataset(sys.argv[1], group='sweep', engine='netcdf4')
assert data.sizes['trajectory'] == 30000 and list(data)[:3] == ['x(0)', 'x', "x'"], data
assert data['stopped_by'].attrs['flag_meanings'].split()[:2] == ['none', 'singular']
assert data.to_dataframe().index[-1] == 29999
P
that "its first lines tell what it is" eval "[ \"\$(head -c 16 '$place/whole.h5')\" = 'motus archive 1' ]"

gives "motus archive" 0 "$motus" archive "$place/whole.h5"
that "... says what it has" eval "says '30000, in 8 blocks: all there' && says 'x(0), x, ' && says 'motus sweep'"
gives "... as JSON" 0 "$motus" archive "$place/whole.h5" --json
that "... that is good" eval "json '$out' && [ \"\$(jq -c '[.rows, .blocks, .missing]' '$out')\" = '[30000,8,0]' ]"
gives "... its rows" 0 "$motus" archive "$place/whole.h5" -o "$place/rows.csv"
that "... are the CSV of the sweep" cmp "$place/rows.csv" "$place/whole.csv"
gives "... its model" 0 "$motus" archive "$place/whole.h5" -o "$place/model.motus"
that "... is the model" cmp "$place/model.motus" "$swing"
refuses "... nothing else" 2 "the name must end in .csv or .motus" "$motus" archive "$place/whole.h5" -o "$place/rows.npy"
refuses "... and no file that is there" 2 "exists" "$motus" archive "$place/whole.h5" -o "$place/rows.csv"
refuses "a table that is no archive" 2 "is not an archive of motus" "$motus" archive "$place/whole.csv"
# Trajectories that stop, that an event ends, and errors.
cat >"$place/fall.motus" <<'M'
a = 1
x'' = if(a > 3, 6 x^2, -a)
x(0) = 1
x'(0) = if(a > 3, 2, 0)
when x = 0 falling as ground: stop
method dop853
tolerance 1e-9
until 2
M
for more in "--record final,ended" "--record final --errors" "--record min(x),time --shard 1/1"; do
    # shellcheck disable=SC2086
    "$motus" sweep "$place/fall.motus" --vary "a=0.1,1,2,4" $more -o "$place/fall.h5" --force --quiet 2>/dev/null
    # shellcheck disable=SC2086
    "$motus" sweep "$place/fall.motus" --vary "a=0.1,1,2,4" $more -o "$place/fall.csv" --force --quiet 2>/dev/null
    gives "the rows of $more" 0 "$motus" archive "$place/fall.h5" -o "$place/rows.csv" --force
    that "... are the same CSV" cmp "$place/rows.csv" "$place/fall.csv"
done

# --- the same bytes -------------------------------------------------------------------------------------------------------------------
whole=$(sum "$place/whole.h5")
for how in "--threads 1" "--threads 3 --lanes 2" "--machine interpreter" "--machine compiled"; do
    # shellcheck disable=SC2086
    gives "a sweep with $how" 0 sweep -o "$place/again.h5" --force --quiet $how
    that "... has the same bytes" [ "$(sum "$place/again.h5")" = "$whole" ]
done
for k in 1 2 3 4 5; do sweep --quiet --shard $k/5 -o "$place/part%K.h5"; done
sweep --quiet --shard 1/5 -o "$place/rows%K.csv"
gives "shards are joined" 0 "$motus" merge "$place"/part[35241].h5 -o "$place/joined.h5"
that "... to the same bytes" [ "$(sum "$place/joined.h5")" = "$whole" ]
mkdir "$place/killed"
for wait in 02 04 07 1 15 2; do
    "$motus" merge "$place"/part[12345].h5 -o "$place/killed/joined.h5" --force --quiet >"$out" 2>&1 &
    sleep 0.$wait
    kill -KILL $! 2>/dev/null
    wait $! 2>/dev/null
done
that "a merge that is killed leaves nothing beside its file" eval "[ -z \"\$(ls '$place/killed' | grep joined.h5.joined)\" ]"
gives "more shards than blocks" 0 eval "for k in 1 2 3; do '$motus' sweep '$swing' --vary 'x(0)=0.1:3:50' --quiet --shard \$k/3 -o '$place/few%K.h5'; done && '$motus' merge '$place'/few[123].h5 -o '$place/few.h5' && '$motus' sweep '$swing' --vary 'x(0)=0.1:3:50' --quiet -o '$place/fifty.h5'"
that "... are joined too" [ "$(sum "$place/few.h5")" = "$(sum "$place/fifty.h5")" ]
refuses "a shard that is missing" 2 "1 of 5 shards are missing: 4" "$motus" merge "$place"/part[1235].h5 -o "$place/none.h5"
refuses "a shard that is named twice" 2 "are both shard 2/5" "$motus" merge "$place"/part[12345].h5 "$place/part2.h5" -o "$place/none.h5"
refuses "shards of two kinds" 2 "is a table of rows" "$motus" merge "$place/part1.h5" "$place/rows1.csv" -o "$place/none.h5"
refuses "no shard at all" 2 "is a whole sweep" "$motus" merge "$place/whole.h5" -o "$place/none.h5"
refuses "shards under the name of a table" 2 "the shards are archives" "$motus" merge "$place"/part[12345].h5 -o "$place/none.csv"
that "... and nothing is left" eval "[ -z \"\$(ls '$place' | grep none)\" ]"
gives "--partial joins what is there" 0 "$motus" merge "$place"/part[15].h5 -o "$place/partial.h5" --partial --json
that "... of eight blocks three" holds '.missing == 5 and .shards == 5'
gives "... and --resume computes the rest" 0 sweep -o "$place/partial.h5" --resume --json
that "... alone" [ "$(jq .resumed "$out")" = $((3 * 4096)) ]
that "... to the same bytes" [ "$(sum "$place/partial.h5")" = "$whole" ]
refuses "--partial of tables" 2 "only archives know" "$motus" merge "$place/rows1.csv" -o "$place/none.csv" --partial

# --- death ----------------------------------------------------------------------------------------------------------------------------
# Blocks of half a second, so that a kill finds some of them done.
longer=("$motus" sweep "$swing" --until 100 --vary "x(0)=0.1:3:30000" --record "final,max(energy)")
long() { "${longer[@]}" "$@"; }
gives "a longer sweep" 0 long -o "$place/long.h5"
whole=$(sum "$place/long.h5")
for signal in KILL TERM; do
    rm -f "$place/killed.h5"
    "${longer[@]}" --machine interpreter --lanes 1 --threads 1 --quiet -o "$place/killed.h5" 2>/dev/null &
    one=$!
    for _ in $(seq 200); do [ -e "$place/killed.h5" ] && [ "$(blocks "$place/killed.h5" 2>/dev/null || echo 0)" -ge 2 ] && break; sleep 0.05; done
    kill -$signal $one
    wait $one 2>/dev/null
    there=$(blocks "$place/killed.h5")
    that "a sweep killed by SIG$signal leaves some blocks, not all" eval "[ $there -ge 2 ] && [ $there -lt 8 ]"
    that "... and the rest is NaN" $python -c "
import h5py, numpy, sys
with h5py.File(sys.argv[1]) as f:
    done = f['blocks/done'][()] != 0
    for b in range(8): assert numpy.isnan(f['sweep/x'][4096 * b:4096 * (b + 1)]).any() != done[b], b
" "$place/killed.h5"
    gives "... motus archive says so" 0 "$motus" archive "$place/killed.h5"
    that "... and how many are missing" says "$((8 - there)) missing, the first of them"
    refuses "... and writes no CSV of it" 2 "are missing or damaged" "$motus" archive "$place/killed.h5" -o "$place/killed.csv"
    gives "... and is finished by --resume" 0 long -o "$place/killed.h5" --resume
    that "... which keeps those blocks" says ", $((there * 4096)) of them found in the file"
    that "... to the same bytes" [ "$(sum "$place/killed.h5")" = "$whole" ]
done
# Of dear trajectories blocks are small: by what a trajectory takes, which is counted, so that every command cuts the sweep alike.
dear=("$motus" sweep "$swing" --until 1e5 --method rk4 --step 0.125 --vary "x(0)=0.1:3:60" --record final)
gives "a sweep of dear trajectories" 0 "${dear[@]}" -o "$place/dear.h5" --quiet
gives "... has many blocks" 0 "$motus" archive "$place/dear.h5" --json
that "... of a power of two" holds '.rows == 60 and .blocks == 8 and .missing == 0'
"${dear[@]}" --machine interpreter --threads 1 --quiet -o "$place/killed-dear.h5" 2>/dev/null &
one=$!
for _ in $(seq 200); do [ -e "$place/killed-dear.h5" ] && [ "$(blocks "$place/killed-dear.h5" 2>/dev/null || echo 0)" -ge 1 ] && break; sleep 0.05; done
kill -KILL $one
wait $one 2>/dev/null
there=$(blocks "$place/killed-dear.h5")
that "... keeps some of them when it is killed" eval "[ $there -ge 1 ] && [ $there -lt 8 ]"
# Again where the signal met the end of a block.
for _ in 1 2 3; do
    "${dear[@]}" --machine interpreter --threads 1 --resume --quiet -o "$place/killed-dear.h5" 2>"$err" &
    one=$!
    sleep 1
    kill -STOP $one
    there=$(blocks "$place/killed-dear.h5")
    kill -TERM $one
    kill -CONT $one
    wait $one
    status=$?
    [ "$(blocks "$place/killed-dear.h5")" = "$there" ] && break
done
that "SIGTERM ends it in the middle of a block" eval "[ $(blocks "$place/killed-dear.h5") = $there ] && { [ $status = 1 ] || [ $status = 143 ]; }"
gives "... it is finished by --resume" 0 "${dear[@]}" -o "$place/killed-dear.h5" --resume --json
that "... which keeps what was there" holds ".resumed >= $((there * 8)) and .resumed < 60"
that "... to the same bytes" cmp "$place/killed-dear.h5" "$place/dear.h5"
few=("$motus" sweep "$swing" --until 500 --method rk4 --step 0.125 --vary "x(0)=0.1:3:2100" --record final --quiet)
gives "shards of it" 0 eval "for k in 1 2; do for kind in h5 csv; do ${few[*]@Q} --shard \$k/2 -o '$place'/dear%K.\$kind; done; done"
that "... say how large their blocks are" says "shard 2/2 in blocks of 2048" "$place/dear2.csv"
for kind in h5 csv; do
    gives "... are joined as $kind" 0 "$motus" merge "$place/dear1.$kind" "$place/dear2.$kind" -o "$place/dear-joined.$kind" --quiet
done
"${few[@]}" -o "$place/few.csv" && "${few[@]}" -o "$place/few-dear.h5"
that "... to the bytes of the sweep" eval "cmp '$place/dear-joined.h5' '$place/few-dear.h5' && cmp '$place/dear-joined.csv' '$place/few.csv'"
# A block in the middle whose bytes are not what they were is computed again.
gives "a byte is changed" 0 $python -c "
import h5py, sys
with h5py.File(sys.argv[1]) as f: at = f['sweep/x'].id.get_offset()
with open(sys.argv[1], 'r+b') as f: f.seek(at + 8 * 5000); f.write(b'x')
" "$place/killed.h5"
gives "--resume finds it" 0 long -o "$place/killed.h5" --resume
that "... keeps seven blocks of eight" says ", 25904 of them found in the file"
that "... and mends the other" [ "$(sum "$place/killed.h5")" = "$whole" ]
# Events of the trajectories behind a block that is missing are not lost: they are computed again.
turn=("$motus" sweep "$swing" --vary "x(0)=0.1:3:13000" --record final --when "x = 0: record" --quiet)
gives "an archive and a table of events" 0 "${turn[@]}" -o "$place/turn.h5" --events "$place/turn.csv"
cp "$place/turn.csv" "$place/turns.csv"
gives "... a byte of the second block is changed" 0 $python -c "
import h5py, sys
with h5py.File(sys.argv[1]) as f: at = f['sweep/x'].id.get_offset()
with open(sys.argv[1], 'r+b') as f: f.seek(at + 8 * 5000); f.write(b'x')
" "$place/turn.h5"
gives "... and --resume" 0 "${turn[@]}" -o "$place/turn.h5" --events "$place/turn.csv" --resume
that "... has all events" cmp "$place/turn.csv" "$place/turns.csv"
# Until all blocks are there their events are in segments, each with a hash.
gives "... the table is gone" 0 rm "$place/turn.csv"
gives "... it is computed again" 0 "${turn[@]}" -o "$place/turn.h5" --events "$place/turn.csv" --resume
that "... with the same bytes" cmp "$place/turn.csv" "$place/turns.csv"
# stops behind the second of four blocks, and leaves its segment in cut.csv.segments
cut_short() {
    rm -rf "$place/cut.h5" "$place/cut.csv" "$place/cut.csv.segments"
    "${turn[@]}" -o "$place/cut.h5" --events "$place/cut.csv" --machine interpreter --until 150 --threads 1 &
    job=$!
    for _ in $(seq 300); do [ "$(blocks "$place/cut.h5" 2>/dev/null || echo 0)" -ge 2 ] && break; sleep 0.02; done
    kill -9 $job
    wait $job 2>/dev/null
    there=$(blocks "$place/cut.h5")
}
further=("${turn[@]}" --until 150)
gives "a longer table of events" 0 "${further[@]}" -o "$place/further.h5" --events "$place/further.csv"
for damage in none "a byte of a block" "a byte of the line behind it" "all"; do
    cut_short
    that "killed, it leaves a segment and some blocks" eval "[ -s '$place/cut.csv.segments/segment-1' ] && [ $there -ge 2 ] && [ $there -lt 4 ] && [ ! -s '$place/cut.csv' ]"
    segment=$place/cut.csv.segments/segment-1 lost=1
    case $damage in
    none) lost=0 ;;
    "a byte of a block") printf 9 | dd of="$segment" bs=1 seek=3000 conv=notrunc 2>/dev/null ;;
    "a byte of the line behind it") sed -i 's/^# end of block 1, /# end of block 7, /' "$segment" ;;
    all) rm -r "$place/cut.csv.segments"; lost=$there ;;
    esac
    if [ "$damage" = none ]; then
        refuses "... without --resume the archive is there" 2 "exists" "${further[@]}" -o "$place/cut.h5" --events "$place/cut.csv"
        refuses "... nor may another sweep take the segments" 2 "cut.csv.segments exists" "${turn[@]}" -o "$place/cut2.h5" --events "$place/cut.csv"
        refuses "... also with --resume" 2 "events of another sweep" "${turn[@]}" -o "$place/turn.h5" --events "$place/cut.csv" --resume
    fi
    gives "damaged: $damage; --resume" 0 "${further[@]}" -o "$place/cut.h5" --events "$place/cut.csv" --resume --json
    that "... keeps the other blocks" holds ".resumed == $(((there - lost) * 4096))"
    that "... has all events" cmp "$place/cut.csv" "$place/further.csv"
    that "... and all rows" [ "$(sum "$place/cut.h5")" = "$(sum "$place/further.h5")" ]
    that "... and nothing beside them" absent "$place/cut.csv.segments"
done
refuses "a table that was shortened" 2 "is damaged: after byte" eval "head -n 500 '$place/further.csv' >'$place/cut.csv'; ${further[*]@Q} -o '$place/cut.h5' --events '$place/cut.csv' --resume"
gives "... is replaced by --force" 0 "${further[@]}" -o "$place/cut.h5" --events "$place/cut.csv" --force
that "... with the same bytes" cmp "$place/cut.csv" "$place/further.csv"
refuses "two columns of one name" 2 "two columns of the archive are named x" "$motus" sweep "$swing" --vary "x(0)=0.1,1" --record "final,x" -o "$place/twice.h5"
ln -s "$place/elsewhere.h5" "$place/link.h5"
gives "an archive behind a link" 0 "$motus" sweep "$swing" --vary "x(0)=0.1,1" -o "$place/link.h5" --quiet
that "... is where the link leads" eval "[ -L '$place/link.h5' ] && [ \"\$(head -c 5 '$place/elsewhere.h5')\" = motus ]"
refuses "--resume of another sweep" 2 "was made by another sweep" "$motus" sweep "$swing" --vary "x(0)=0.1:2:30000" --record "final,max(energy)" -o "$place/killed.h5" --resume
that "... touches nothing" [ "$(sum "$place/killed.h5")" = "$whole" ]
refuses "an archive that is there" 2 "exists" long -o "$place/killed.h5"

gives "a shard without a row, with events" 0 "${turn[@]}" --shard 5/5 -o "$place/none%K.h5" --events "$place/none%K.csv"
that "... has a table without one" says "# end of the events of trajectories: 0" "$place/none5.csv"
refuses "the archive is no table of events, whatever its name" 2 "is named for two outputs" "${turn[@]}" -o "$place/twice.h5" --events "$place/./twice.h5" --force
refuses "nor may it be among the segments" 1 "cannot remove" eval "mkdir -p '$place/in.csv.segments/segment-2'; ${turn[*]@Q} -o '$place/in.h5' --events '$place/in.csv' --force"
: >"$place/way.csv.segments"
refuses "a file where the segments are to be" 2 "way.csv.segments exists" "${turn[@]}" -o "$place/way.h5" --events "$place/way.csv"
that "... begins nothing" absent "$place/way.h5"
refuses "a table in a folder that is not there" 1 "cannot write" "${turn[@]}" -o "$place/way.h5" --events "$place/nowhere/way.csv"
that "... begins nothing" absent "$place/way.h5"
"${further[@]}" -o "$place/first.h5" --events "$place/both.csv" --machine interpreter --threads 1 &
job=$!
for _ in $(seq 100); do [ -e "$place/both.csv.segments/segment-1" ] && break; sleep 0.02; done
refuses "another sweep with the same table" 1 "is being written by another program" "${turn[@]}" -o "$place/second.h5" --events "$place/both.csv" --force
wait $job
that "... and the first one has all events" cmp "$place/both.csv" "$place/further.csv"
gives "an input with the name that an archive has until it is made" 0 cp "$swing" "$place/own.h5.new"
refuses "... is not overwritten" 2 "would be overwritten" "$motus" sweep "$place/own.h5.new" --vary k=1,2 -o "$place/own.h5"
gives "such an input beside an archive to which a link leads" 0 eval 'cp "$place/turn.h5" "$place/own.h5" && ln -s own.h5 "$place/lead.h5"'
refuses "... is not overwritten, either" 2 "would be overwritten" "$motus" sweep "$place/own.h5.new" --vary k=1,2 -o "$place/lead.h5" --force
gives "the number of a trajectory is changed" 0 $python -c "
import h5py, sys
with h5py.File(sys.argv[1]) as f: at = f['sweep/trajectory'].id.get_offset()
with open(sys.argv[1], 'r+b') as f: f.seek(at + 80); f.write(b'x')
" "$place/turn.h5"
refuses "... motus archive finds it" 2 "row 10 has the number 120 instead of 10" "$motus" archive "$place/turn.h5"
refuses "... and --resume" 2 "instead of 10" "${turn[@]}" -o "$place/turn.h5" --events "$place/turn.csv" --resume
# Merges of one name at the same time: one of them is refused, and the file is whole.
for _ in 1 2 3 4 5; do
    "$motus" merge "$place"/part[1-5].h5 -o "$place/same.h5" -q --force 2>/dev/null &
    "$motus" merge "$place"/part[1-5].h5 -o "$place/same.h5" -q --force 2>"$err"
    wait $!
    that "two merges at once leave one whole file" cmp "$place/same.h5" "$place/joined.h5"
done

# --- compressed -----------------------------------------------------------------------------------------------------------------------
gives "--compress" 0 long -o "$place/packed.h5" --compress
packed=$(sum "$place/packed.h5")
gives "... has the same numbers, attributes and scales" 0 $python - "$place/long.h5" "$place/packed.h5" <<'P'
import h5py, numpy, os, sys, xarray
a, b = [h5py.File(name) for name in sys.argv[1:]]
assert list(a['sweep']) == list(b['sweep'])
for name in a['sweep']: assert numpy.array_equal(a['sweep'][name][()], b['sweep'][name][()], equal_nan=a['sweep'][name].dtype.kind == 'f'), name
assert numpy.array_equal(a['blocks/done'][()], b['blocks/done'][()])
assert b['sweep/x'].dims[0][0] == b['sweep/trajectory'] and b['sweep/x'].compression == 'gzip'
assert {k: v for k, v in a.attrs.items() if k != 'motus_archive'} == {k: v for k, v in b.attrs.items() if k != 'motus_archive'}
assert os.path.getsize(sys.argv[2]) < os.path.getsize(sys.argv[1])
assert xarray.open_dataset(sys.argv[2], group='sweep', engine='netcdf4').sizes['trajectory'] == len(a['sweep/x'])
P
if command -v h5dump >/dev/null; then
    gives "... for h5dump, too" 0 eval "[ \"\$(h5dump -d /sweep/x -c 5 '$place/packed.h5' | grep '(0)')\" = \"\$(h5dump -d /sweep/x -c 5 '$place/long.h5' | grep '(0)')\" ]"
fi
gives "... by one thread" 0 long -o "$place/packed1.h5" --compress --threads 1 --machine interpreter
that "... the same bytes" [ "$(sum "$place/packed1.h5")" = "$packed" ]
gives "... of a sweep that is there" 0 eval "cp '$place/long.h5' '$place/packed1.h5' && long -o '$place/packed1.h5' --resume --compress"
that "... the same bytes" [ "$(sum "$place/packed1.h5")" = "$packed" ]
gives "... once more" 0 long -o "$place/packed1.h5" --resume --compress --json
that "... finds all of it" holds '.resumed == 30000'
that "... and touches nothing" [ "$(sum "$place/packed1.h5")" = "$packed" ]
gives "motus archive lists it" 0 "$motus" archive "$place/packed.h5"
that "... whose blocks are all there" says "in 8 compressed blocks: all there, and their hashes match"
gives "... verifies it" 0 "$motus" archive "$place/packed.h5" --verify all
gives "... writes its CSV" 0 "$motus" archive "$place/packed.h5" -o "$place/packed.csv"
gives "... as that of the other" 0 "$motus" archive "$place/long.h5" -o "$place/unpacked.csv"
that "... to the same bytes" cmp "$place/packed.csv" "$place/unpacked.csv"
gives "shards that are compressed" 0 eval 'for k in 1 2 3; do long --shard $k/3 -o "$place/small%K.h5" --compress; done'
gives "... are merged" 0 "$motus" merge "$place"/small[123].h5 -o "$place/merged.h5" --quiet
that "... to the same bytes" [ "$(sum "$place/merged.h5")" = "$whole" ]
gives "... and compressed again" 0 "$motus" merge "$place"/small[123].h5 -o "$place/merged.h5" --quiet --compress --force
that "... to the same bytes" [ "$(sum "$place/merged.h5")" = "$packed" ]
refuses "--compress of what is not complete" 2 "exclude each other" "$motus" merge "$place/small1.h5" -o "$place/partial.h5" --partial --compress --force
refuses "--compress of a table" 2 "--compress is for archives" long -o "$place/x.csv" --compress
# One byte in the middle: that block is damaged, and nothing is written into such a file.
gives "a byte of it is changed" 0 $python -c "
import h5py, sys
with h5py.File(sys.argv[1]) as f: place, size, left_out = map(int, f['blocks/packed'][2 * len(f['blocks/done']) + 1])
with open(sys.argv[1], 'r+b') as f:
    f.seek(place + size // 2); byte = f.read(1); f.seek(place + size // 2); f.write(bytes([byte[0] ^ 64]))
" "$place/packed1.h5"
gives "... motus archive finds the block" 2 "$motus" archive "$place/packed1.h5"
that "... and says so" eval "says ' 1 damaged, the first of them number 2' && says 'is damaged: 1 of its 8 blocks does not match its hash' '$err' && says ' --force --compress' '$err'"
refuses "... quietly, too" 2 "is damaged: 1 of its 8 blocks does not match its hash" "$motus" archive "$place/packed1.h5" --quiet
refuses "... --resume cannot mend it" 2 "of its blocks are damaged" long -o "$place/packed1.h5" --resume
gives "... --force does" 0 long -o "$place/packed1.h5" --force --compress
that "... to the same bytes" [ "$(sum "$place/packed1.h5")" = "$packed" ]

# --- computed again -------------------------------------------------------------------------------------------------------------------
gives "--verify all" 0 "$motus" archive "$place/long.h5" --verify all
that "... computes all blocks again" says "8 of these blocks, computed again, have the same bytes"
gives "--verify 1%" 0 "$motus" archive "$place/long.h5" --verify 1% --json --machine interpreter
that "... one of eight" eval "json '$out' && [ \"\$(jq .verified '$out')\" = 1 ]"
gives "of a shard" 0 "$motus" archive "$place/part3.h5" --verify all
that "... both blocks" says "2 of these blocks"
several=(--record "final,min(x),steps,ended" --when "x = 0 as zero: stop after 3" --set "x(0)=1.1" --random "x'(0)=normal:0:0.1" --vary "k=1,2" --count 3000 --seed 7)
for more in "--method dop853 --tolerance 1e-9" "--errors" "--accuracy 1e-8" "--shard 2/2 --until 3"; do
    # shellcheck disable=SC2086
    "$motus" sweep "$swing" "${several[@]}" $more -o "$place/it's one.h5" --force --quiet 2>/dev/null
    gives "a sweep with $more" 0 "$motus" archive "$place/it's one.h5" --verify all
    that "... is what its command computes" says "computed again"
done
for part in 0% 101% 1 x "%"; do refuses "--verify $part" 2 "this is not a part" "$motus" archive "$place/long.h5" --verify "$part"; done
build=$(dirname "$motus")
change=$place/change
if "${CC:-cc}" -std=c17 -O1 -I include test/archive/change.c "$build/libmotus-archive.a" "$build/libmotus.a" -lm -ldl -lpthread -o "$change" 2>"$err"; then
    cp "$place/long.h5" "$place/changed.h5"
    "$change" "$place/changed.h5" 1 5000
    gives "a number is changed, and the hash fits" 0 "$motus" archive "$place/changed.h5"
    refuses "... --verify finds it" 1 "1 of 8 blocks differ from what is computed; trajectory 5000, x: " "$motus" archive "$place/changed.h5" --verify all
else
    echo "not run, since no C program links here: a number that is changed"
fi
printf 'a\n0.5\n0.75\n' >"$place/a.csv"
(cd "$place" && "$motus" sweep "$swing" --vary "k=@a.csv:a" -o file.h5 -q)
gives "values of a file" 0 bash -c "cd '$place' && '$motus' archive file.h5 --verify all"
sed -i s/75/25/ "$place/a.csv"
refuses "... which has changed" 2 "has another fingerprint than the archive" bash -c "cd '$place' && '$motus' archive file.h5 --verify all"
rm "$place/a.csv"
refuses "... or is not there" 1 "cannot read" bash -c "cd '$place' && '$motus' archive file.h5 --verify all"

# --- archives of other versions: test/archive/README.md ----------------------------------------------------------------------------------
begun=(sweep test/archive/swing.motus --vary "x(0)=0.1:3:4100" --record "x,max(energy)")
for file in test/archive/begun-*.h5; do
    name=$(basename "$file")
    cp "$file" "$place/$name"
    gives "$name is verified" 0 "$motus" archive "$place/$name" --verify all
    that "... its first block" says "1 of these blocks, computed again, has the same bytes"
    gives "... and completed" 0 "$motus" "${begun[@]}" -o "$place/$name" --resume
    that "... the second alone" says "4100 trajectories, 4096 of them found"
    that "... to the bytes that its version makes" [ "$(sum "$place/$name")" = "$(grep " $name" test/archive/completed.sha256 | cut -c 1-64)" ]
done
cp test/archive/begun-0.0.9.h5 "$place/old.h5"
refuses "another sweep does not continue an archive of another version" 2 "was made by another sweep" "$motus" "${begun[@]}" --until 3 -o "$place/old.h5" --resume
if [ -x "$change" ]; then
    "$change" "$place/old.h5" 1 3
    refuses "nor where the bits are others" 2 "was begun by motus 0.0.9, and this motus" "$motus" "${begun[@]}" -o "$place/old.h5" --resume
fi

# --- files that are none --------------------------------------------------------------------------------------------------------------
resumes() { refuses "$1" 2 "$2" sweep -o "$place/bad.h5" --resume; }
echo "hello" >"$place/bad.h5"
resumes "a text" "is not an archive of motus"
head -c 3000 "$place/long.h5" >"$place/bad.h5"
resumes "the beginning of an archive" "is truncated"
head -c 500000 "$place/long.h5" >"$place/bad.h5"
resumes "half an archive" "is damaged"
sed '1s/archive 1/archive 7/' "$place/long.h5" >"$place/bad.h5"
refuses "an archive of a later version" 2 "has version 7 of the archives" sweep -o "$place/bad.h5" --resume
{ head -c 100 "$place/long.h5"; printf 9; tail -c +102 "$place/long.h5"; } >"$place/bad.h5"
resumes "another place of a column" "is damaged"

# --- a full disk ----------------------------------------------------------------------------------------------------------------------
mkdir "$place/small"
if mount -t tmpfs -o size=512k none "$place/small" 2>/dev/null; then
    refuses "a disk that is too small" 1 "No space left on device" sweep -o "$place/small/full.h5" --quiet
    that "... has nothing left on it" eval "[ -z \"\$(ls '$place/small')\" ]"
    umount "$place/small"
else
    echo "not run, since this user cannot mount: a full disk"
fi
refuses "a folder that is not there" 1 "cannot" sweep -o "$place/absent/full.h5" --quiet

echo "$passed passed, $failed failed"
[ $failed = 0 ]
