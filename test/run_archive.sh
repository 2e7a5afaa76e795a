#!/bin/bash
# Archives of runs: what other programs read in them, states, kills and what --resume makes of them, runs that go on.
#
# Each case is one line `ok` or `not ok`; the last line counts them. MOTUS is the program (build/motus).
cd "$(dirname "$0")/.." || exit 1
. test/cli/cases.sh
root=$PWD
cd "$place" || exit 1
if ! $python -c 'import h5py' 2>/dev/null; then
    ok "not run, since h5py is not installed: archives of runs"
    echo "$passed passed, $failed failed"
    exit 0
fi
cat >drive.motus <<'M'
k = 1
x'' = -k sin(x) - 0.1 x' + 0.2 cos(2 t)
x(0) = 1
x'(0) = 0
energy = x'^2/2 - k cos(x)
method rk4
step 1/32
until 400
M
if ! "$motus" run drive.motus -o run.h5 -q 2>"$err" && says "without HDF5" "$err"; then
    that "without HDF5 nothing is left" absent run.h5
    echo "$passed passed, $failed failed"
    exit $((failed > 0))
fi
run() { "$motus" run drive.motus --error none --quiet "$@"; }
# Waits until a run that was started has its archive.
begins() { for _ in $(seq 3000); do [ -s "$1" ] && break; sleep 0.02; done; }
# The choices of what is drawn: SEED=n repeats them.
RANDOM=${SEED:=$(($(date +%s) % 32768))}
echo "SEED=$SEED"

# --- what is in it --------------------------------------------------------------------------------------------------------------------
gives "a run into an archive" 0 "$motus" run drive.motus -o run.h5 --force
"$motus" run drive.motus -o run.csv -q
gives "h5py reads the numbers of the CSV" 0 $python - <<'P'
import csv, h5py
rows = list(csv.reader(line for line in open('run.csv') if not line.startswith('#')))
with h5py.File('run.h5') as f:
    assert list(f['run']) == ['row'] + rows[0], list(f['run'])
    for k, name in enumerate(rows[0]):
        assert [float(row[k]) for row in rows[1:]] == list(f['run'][name][()]), name
        assert f['run'][name].dims[0][0] == f['run/row']
    assert (f['blocks/done'][()] != 0).all() and f['model'][()].decode() == open('drive.motus').read()
    assert list(f['h5md'].attrs['version']) == [1, 1] and f['h5md/creator'].attrs['name'] == b'motus'
    assert f['observables/energy/value'] == f['run/energy'] and f['observables/energy/time'] == f['run/t']
P
gives "xarray reads it" 0 $python -c "
import xarray
d = xarray.open_dataset('run.h5', group='run', engine='netcdf4')
assert d.sizes['row'] == 12801 and float(d.t[-1]) == 400 and abs(float(d.x[-1])) < 4, d"
gives "the errors as columns" 0 "$motus" run drive.motus --errors -o errors.h5 -q --until 20
"$motus" run drive.motus --errors -o errors.csv -q --until 20
gives "... are those of the CSV" 0 $python - <<'P'
import csv, h5py
rows = list(csv.reader(line for line in open('errors.csv') if not line.startswith('#')))
with h5py.File('errors.h5') as f:
    assert list(f['run']) == ['row'] + rows[0], list(f['run'])
    for k, name in enumerate(rows[0]): assert [float(row[k]) for row in rows[1:]] == list(f['run'][name][()]), name
P
cat >many.motus <<'M'
r[i]'' = -r[i] (1 + i/10) + (0.1, 0, 0.2)   for i = 1..5
r[i](0) = (i, 0, -i)    for i = 1..5  # m, of each
r[i]'(0) = (0, 1, i/2)  for i = 1..5
u[i]'' = -u[i]  for i = 1..4
u[i](0) = i     for i = 1..4
u[i]'(0) = 0    for i = 1..4
size = sum(i = 1..5: |r[i]|)#m
method verlet
step 1/64
until 10
M
gives "families" 0 "$motus" run many.motus -o many.h5 -q
"$motus" run many.motus -o many.csv -q
gives "... are columns of many numbers, and particles of H5MD 1.1" 0 $python - <<'P'
import csv, h5py
rows = list(csv.reader(line for line in open('many.csv') if not line.startswith('#')))
at = {name: k for k, name in enumerate(rows[0])}
with h5py.File('many.h5') as f:
    r, v, u = f['run/r'], f["run/r'"], f['run/u']
    assert r.shape == (641, 5, 3) and v.shape == (641, 5, 3) and u.shape == (641, 4), (r.shape, u.shape)
    for i in range(5):
        for c in range(3):
            for sort, of in (("r[%d].%s", r), ("r[%d]'.%s", v)):
                k = at[sort % (i + 1, 'xyz'[c])]
                assert [float(row[k]) for row in rows[1:]] == list(of[:, i, c])
    for i in range(4): assert [float(row[at['u[%d]' % (i + 1)]]) for row in rows[1:]] == list(u[:, i])
    p = f['particles/r']
    assert p['position/value'] == r and p['velocity/value'] == v and p['position/time'] == f['run/t']
    assert p['position/step'].dtype.kind == 'i' and p['box'].attrs['dimension'] == 3
    assert list(p['box'].attrs['boundary']) == [b'none'] * 3 and 'u' not in f['particles']
    assert f['observables/size/value'].shape == (641,)
    assert [f['run'][name].attrs.get('comment') for name in ('t', 'r', "r'", 'size')] == [None, b'm, of each', None, b'm']
P

# --- motus archive --------------------------------------------------------------------------------------------------------------------
gives "motus archive" 0 "$motus" archive run.h5
that "... says what it has" eval "says 'rows         12801, in 4 blocks: all there' && says 'motus run drive.motus --method rk4'"
for file in run errors many; do
    gives "the rows of $file" 0 "$motus" archive $file.h5 -o rows.csv --force
    that "... are those of the CSV" eval "cmp <(grep -v '^#' rows.csv) <(grep -v '^#' $file.csv)"
done
gives "the model" 0 "$motus" archive run.h5 -o model.motus
that "... is the model" cmp model.motus drive.motus
gives "the state" 0 "$motus" archive run.h5 -o end.state
gives "... is a restart state" 0 "$motus" run drive.motus --method rk4 --restart end.state --until 500 --json
that "... that goes on" holds '.time == 500'
refuses "nothing else" 2 "the name must end in .csv, .motus or .state" "$motus" archive run.h5 -o x.npy
for file in run errors many; do
    gives "--verify all of $file" 0 "$motus" archive $file.h5 --verify all
    that "... all rows" says "rows, computed again, have the same bytes"
done
gives "--verify 10%" 0 "$motus" archive run.h5 --verify 10% --json --machine interpreter
that "... a tenth of the rows" eval "json '$out' && [ \"\$(jq .verified '$out')\" = 1281 ]"
cp run.h5 changed.h5
build=$(dirname "$motus")
if "${CC:-cc}" -std=c17 -O1 -I "$root/include" "$root/test/archive/change.c" "$build/libmotus-archive.a" "$build/libmotus.a" -lm -ldl -lpthread -o change 2>"$err"; then
    ./change changed.h5 1 5000
    gives "a number is changed, and the hash fits" 0 "$motus" archive changed.h5
    refuses "... --verify finds it" 1 "row 5000, x: " "$motus" archive changed.h5 --verify all
else
    echo "not run, since no C program links here: a number that is changed"
fi

# --- archives of other versions: test/archive/README.md -------------------------------------------------------------------------------
cp "$root/test/archive/swing.motus" .
"$motus" run swing.motus --until 800 --every "4 steps" --columns t,x --error none -o in-one-go.h5 -q
for file in "$root"/test/archive/run-*.h5; do
    name=$(basename "$file")
    cp "$file" "$name"
    gives "$name is verified" 0 "$motus" archive "$name" --verify all
    gives "... and goes on" 0 "$motus" run "$name" --until 800 -q
    that "... to the bytes that this version makes in one go" cmp "$name" in-one-go.h5
done
if [ -x change ]; then
    cp "$root/test/archive/run-0.0.9.h5" old.h5
    ./change old.h5 1 3
    refuses "where the bits are others it does not go on" 2 "was begun by motus 0.0.9, and this motus" "$motus" run old.h5 --until 800 -q
fi

# --- the same bytes -------------------------------------------------------------------------------------------------------------------
run -o a.h5
sleep 1.1
run -o b.h5 --threads 2 --machine interpreter
that "the bytes do not depend on the day, threads and machine" cmp a.h5 b.h5
run -o b.h5 --force --checkpoint "7 steps"
that "nor on states on the way" cmp a.h5 b.h5
run -o b.h5 --force --checkpoint "0.001s"
that "nor on their times" cmp a.h5 b.h5
run -o b.h5 --resume
that "--resume of a complete one changes nothing" cmp a.h5 b.h5
for every in "1/32" 0.5 0.3 "7 steps" "100 steps" 0.011 1000; do
    [ "$every" = 1/32 ] && rows=() || rows=(--every "$every")
    run "${rows[@]}" -o a.h5 --force
    for until in 200 177.77 0.01 399.99; do
        run "${rows[@]}" -o b.h5 --force --until $until
        gives "a row every $every, to $until, then to 400" 0 "$motus" run b.h5 --until 400 -q
        that "... the bytes of one run" cmp a.h5 b.h5
    done
done
run -o half.h5 --until 200
cp half.h5 kept.h5
run -o a.h5 --force
gives "a run goes on in another file" 0 "$motus" run half.h5 --until 400 -o b.h5 --force -q
that "... the bytes of one run" cmp a.h5 b.h5
that "... and the first stays as it is" cmp half.h5 kept.h5
gives "errors go on too" 0 eval '"$motus" run drive.motus -o e.h5 --until 200 -q && "$motus" run e.h5 --until 400 --json'
that "... from the very start" holds '.error.x > 0 and .error.x < 1e-7 and .time == 400'

# --- death ----------------------------------------------------------------------------------------------------------------------------
cat >ball.motus <<'M'
x'' = -sin(3 x)
y'' = -1
x(0) = 1
x'(0) = 0
y(0) = 1
y'(0) = 0
when y = 0 falling as bounce: y' = -y'
until 3000
M
# name, words: the run is killed and stopped at random times until it is complete; the bytes are those of a run that was not.
# A run that ends before it is killed says nothing and starts again.
signals=(KILL TERM INT)
survives() {
    local name=$1 kills=0 status=1 whole broken=0
    shift
    rm -f dead.h5
    "$motus" run "$@" --error none -q -o one.h5 --force
    whole=$(sum one.h5)
    for _ in $(seq 60); do
        (trap - INT EXIT; exec "$motus" run "$@" --error none -q -o dead.h5 --resume) 2>"$err" &
        sleep "0.0$((RANDOM % 50 + 10))"
        kill -${signals[RANDOM % 3]} $! 2>/dev/null && kills=$((kills + 1))
        wait $! 2>/dev/null
        status=$?
        if [ -s dead.h5 ]; then $python -c "import h5py; h5py.File('dead.h5')['blocks/done'][()]" 2>>"$err" || broken=$((broken + 1)); fi
        if [ $status = 0 ]; then
            [ $kills -ge 1 ] && break
            rm -f dead.h5
        fi
    done
    that "$name: killed again and again, the file opens each time" [ $broken = 0 ]
    that "... it was killed" [ $kills -ge 1 ]
    gives "... --resume ends it" 0 "$motus" run "$@" --error none -q -o dead.h5 --resume
    that "... with the same bytes" [ "$(sum dead.h5)" = "$whole" ]
    that "... and nothing beside it" eval "[ -z \"\$(ls | grep -E 'grown|new$')\" ]"
}
survives "fixed steps" drive.motus --until 40000 --checkpoint "5000 steps" --machine interpreter
survives "rows in time" drive.motus --until 20000 --every 0.3 --checkpoint "1000 steps" --machine interpreter
survives "adaptive steps" drive.motus --method dop853 --tolerance 1e-9 --until 20000 --checkpoint "3000 steps" --machine interpreter
survives "adaptive steps, rows in time" drive.motus --method dopri5 --tolerance 1e-9 --until 9000 --every 0.1 --checkpoint "1000 steps" --machine interpreter
survives "events" ball.motus --method verlet --step 1/64 --checkpoint "3000 steps" --machine interpreter
survives "events and adaptive steps" ball.motus --method dop853 --tolerance 1e-9 --checkpoint "1000 steps" --machine interpreter
survives "a family" many.motus --until 1500 --checkpoint "2000 steps" --machine interpreter
survives "events, rows in time" ball.motus --method verlet --step 1/64 --every 0.01 --until 1500 --machine interpreter
survives "backward" drive.motus --method dop853 --tolerance 1e-9 --set k=0 --until -60 --every 0.0003 --machine interpreter
rm -f full.h5
refuses "a file that cannot grow is named as the user does" 1 "cannot write full.h5: File too large" bash -c 'ulimit -f 600; exec "$@"' - "$motus" run drive.motus --method dopri5 --tolerance 1e-8 --until 1e5 --error none -q -o full.h5
refuses "... nor even begin" 1 "cannot write tiny.h5: File too large" bash -c 'ulimit -f 1; exec "$@"' - "$motus" run drive.motus --method dopri5 --tolerance 1e-8 --until 1e5 --error none -q -o tiny.h5
that "... and leaves nothing beside it" test ! -e tiny.h5.new
for signal in TERM INT; do
    rm -f stopped.h5
    (trap - INT EXIT; exec "$motus" run drive.motus --error none --until 1e7 --every "1000 steps" --machine interpreter -o stopped.h5) >"$out" 2>"$err" &
    begins stopped.h5
    kill -$signal $!
    wait $! 2>/dev/null
    that "SIG$signal leaves a state" eval "says 'continues' '$err'"
    gives "... motus archive tells of it" 0 "$motus" archive stopped.h5
done

# --- compressed -------------------------------------------------------------------------------------------------------------------------
gives "a run and its archive, compressed" 0 eval 'run -o plain.h5 && run -o packed.h5 --compress'
gives "... for h5py the same numbers" 0 $python - <<'P'
import h5py, numpy, os
a, b = h5py.File('plain.h5'), h5py.File('packed.h5')
for name in a['run']: assert numpy.array_equal(a['run'][name][()], b['run'][name][()]), name
assert numpy.array_equal(a['checkpoint/slots'][()], b['checkpoint/slots'][()]) and b['run/x'].compression == 'gzip'
assert os.path.getsize('packed.h5') < os.path.getsize('plain.h5')
P
gives "... motus archive verifies it" 0 "$motus" archive packed.h5 --verify all
gives "... goes on, in a new file" 0 "$motus" run packed.h5 --until 500 -o longer.h5 -q
gives "... and in its place" 0 "$motus" run packed.h5 --until 500 -q
gives "... as the other does" 0 "$motus" run plain.h5 --until 500 -q
that "... to the same bytes" eval "cmp plain.h5 packed.h5 && cmp plain.h5 longer.h5"
gives "... compressed again" 0 eval '"$motus" run packed.h5 --until 600 -q --compress && "$motus" run plain.h5 --until 600 -q'
that "... which is smaller" [ "$(stat -c %s packed.h5)" -lt "$(stat -c %s plain.h5)" ]
gives "... with the same rows" 0 eval '"$motus" archive packed.h5 -o packed.csv && "$motus" archive plain.h5 -o plain.csv && cmp packed.csv plain.csv'
gives "--resume of a compressed run that is complete" 0 eval 'run -o done.h5 --compress && cp done.h5 done2.h5 && run -o done.h5 --resume --compress'
that "... the same bytes" cmp done.h5 done2.h5
gives "a family, compressed" 0 "$motus" run many.motus --error none --until 20 -q -o many-packed.h5 --compress
gives "... is verified" 0 "$motus" archive many-packed.h5 --verify all
gives "... H5MD finds its particles" 0 $python -c "
import h5py
f = h5py.File('many-packed.h5'); r = [n for n in f['particles']][0]
assert f['particles'][r]['position/value'].compression == 'gzip' and f['particles'][r]['position/value'].ndim == 3"
refuses "--compress of a table" 2 "for a run into an archive" run -o run.csv --compress

# --- a file that is told of --------------------------------------------------------------------------------------------------------------
gives "xarray reads a family" 0 $python -W ignore -c "
import xarray
f = xarray.open_dataset('many.h5', group='run', engine='netcdf4')
assert f['r'].ndim == 3 and f['t'].dims == ('row',), f"
gives "a run that conserves its energy" 0 "$motus" run "$root/models/pendulum.motus" --error none --until 500 -o told.h5 --json
jq -c '[.invariants[].final]' "$out" >told.json
gives "... when it is complete" 0 "$motus" run told.h5 --json
that "... tells the same energy at the end" eval "[ \"\$(jq -c '[.invariants[].final]' '$out')\" = \"\$(cat told.json)\" ] && holds '.invariants | to_entries[0].value | .final != .initial'"
gives "a run that adapts its steps and goes on" 0 eval 'run --method dop853 --tolerance 1e-9 --until 50 -o lands.h5 && "$motus" run lands.h5 --until 90 -q && "$motus" run lands.h5 --until 99 -q'
gives "... is verified up to its first end" 0 "$motus" archive lands.h5 --verify all --json
that "... and says how far" holds '.verified > 100 and .verified < .rows'
gives "a block before the state is damaged" 0 $python -c "
import h5py
with h5py.File('told.h5') as f: at = f['run/t'].id.get_offset()
with open('told.h5', 'r+b') as f: f.seek(at + 80); f.write(b'x')"
gives "... motus archive says so" 0 "$motus" archive told.h5
that "... and that it cannot go on" says "cannot continue this file"
refuses "... nor does it" 2 "no state with all the rows before it" "$motus" run told.h5 --until 600
: >empty.h5
refuses "an empty file" 2 "is empty" "$motus" archive empty.h5
(trap - INT EXIT; exec "$motus" run drive.motus --error none --until 1e7 --every "1000 steps" --machine interpreter -o usr1.h5) >"$out" 2>"$err" &
begins usr1.h5
kill -USR1 $!
wait $! 2>/dev/null
that "SIGUSR1 leaves a state, too" eval "says 'continues' '$err'"

# --- what else goes wrong ----------------------------------------------------------------------------------------------------------------
mkdir bin
printf '#!/bin/sh\nexit 3\n' >bin/gnuplot
chmod +x bin/gnuplot
gives "a drawing that fails" 1 env PATH="$place/bin:$PATH" "$motus" run drive.motus -o drawn.h5 -q --plot drawn.svg
that "... leaves the archive" "$motus" archive drawn.h5 --verify all
refuses "a state in place of the archive" 2 "is read and would be overwritten" "$motus" run drawn.h5 -o other.h5 --save-state drawn.h5
refuses "events in place of it" 2 "is read and would be overwritten" "$motus" run drawn.h5 -o other.h5 --events drawn.h5
gives "words with blanks and a line end" 0 "$motus" run drive.motus --set "k=	2" --when "x = 0:
 record" --until 5 -o words.h5 -q
gives "... are the same words in the file" 0 "$motus" run words.h5 --until 9 -q
gives "... and compute the same" 0 "$motus" archive words.h5 --verify all
chmod 600 words.h5
gives "a file that grows" 0 "$motus" run words.h5 --until 12 -q
that "... keeps its permissions" [ "$(stat -c %a words.h5)" = 600 ]
"$motus" run drive.motus --until 1e8 --every 1000 -o locked.h5 -q --machine interpreter >/dev/null 2>&1 &
begins locked.h5
refuses "two programs do not write one file" 1 "is being written by another program" run -o locked.h5 --resume
kill -9 $! 2>/dev/null; wait $! 2>/dev/null
that "... and the first keeps it" [ -s locked.h5 ]

# --- what is refused ------------------------------------------------------------------------------------------------------------------
refuses "an archive that is there" 2 "exists" run -o a.h5
refuses "--resume of another run" 2 "was made by another run" "$motus" run drive.motus --error none --set k=2 -q -o a.h5 --resume
that "... which stays as it is" cmp a.h5 b.h5
refuses "--resume of a table" 2 "for a run into an archive" run -o run.csv --resume
refuses "--checkpoint of a table" 2 "for a run into an archive" run -o run.csv --checkpoint 10min
for when in 10 0min x "1.5 steps" "-1s" "10 days"; do refuses "--checkpoint $when" 2 "a time with its unit" run -o x.h5 "--checkpoint=$when"; done
refuses "another force for an archive" 2 "a.h5 decides it" "$motus" run a.h5 --set k=2 --until 500
refuses "another method" 2 "a.h5 decides it" "$motus" run a.h5 --method verlet --until 500
refuses "an end before the state" 2 "" "$motus" run a.h5 --until 100
that "... leaves it as it is" cmp a.h5 b.h5
"$motus" sweep drive.motus --vary "x(0)=1,2" --until 1 -o sweep.h5 -q
refuses "a sweep's archive does not run on" 2 "is not the archive of a run" "$motus" run sweep.h5 --until 500
refuses "nor is it resumed by a run" 2 "was made by another run" run -o sweep.h5 --resume
refuses "a run's archive is no sweep's" 2 "" "$motus" sweep drive.motus --vary "x(0)=1,2" --until 1 -o a.h5 --resume
head -c 100000 a.h5 >cut.h5
refuses "half an archive" 2 "is damaged" "$motus" run cut.h5 --until 500
refuses "a file that is not there" 1 "cannot open" "$motus" run none.h5 --until 500
refuses "a device" 2 "not a regular file" bash -c "ln -s /dev/null null.h5 && '$motus' run drive.motus -o null.h5"
gives "a run that fails leaves no archive" 1 "$motus" run drive.motus --set k=-1e308 -o fails.h5 -q
that "... none at all" absent fails.h5

echo "$passed passed, $failed failed"
[ $failed = 0 ]
