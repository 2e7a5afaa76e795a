#!/bin/bash
# Jobs that are killed at random times, and disks that are too small: every file opens, --resume computes what is missing and
# nothing else, and the bytes are those of a job that nothing happened to.
#
#   DEATHS=n   how many jobs are killed (8)      FULL=n   how many disks are too small (4)      SEED=n   of the random choices
#
# Each case is one line `ok` or `not ok`; the last line counts them. MOTUS is the program (build/motus), beside which motus-mpi lies.
cd "$(dirname "$0")/.." || exit 1
. test/cli/cases.sh
deaths=${DEATHS:-8} full=${FULL:-4}
RANDOM=${SEED:-1}
mpi=$(dirname "$motus")/motus-mpi
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
launch=(mpirun)
mpirun --version 2>/dev/null | grep -q "Open MPI" && launch+=(--quiet)

swing_until 100 >"$place/swing.motus"
words=(sweep "$place/swing.motus" --vary "x(0)=0.1:3:120000" --record "final,max(energy)" --threads 1 --quiet)
if ! "$motus" "${words[@]}" -o "$place/whole.h5" 2>"$err"; then
    that "without HDF5 a message says so; not run: deaths" says "without HDF5" "$err"
    echo "$passed passed, $failed failed"
    exit $((failed > 0))
fi
if ! $python -c 'import h5py' 2>/dev/null; then
    ok "a sweep into an archive; not run, since h5py is not installed: deaths"
    echo "$passed passed, $failed failed"
    exit 0
fi
whole=$(sum "$place/whole.h5")
# ... and with a table of events, of every second job
events=(--until 20 --when "x = 0: record" --events)
"$motus" "${words[@]}" "${events[@]}" "$place/whole.csv" -o "$place/told.h5"
told=$(sum "$place/told.h5")
blocks=30 ranks=$([ -x "$mpi" ] && command -v mpirun >/dev/null && echo 4 || echo 0)

# The number of ranks, 0: motus alone; then the words.
job() { local n=$1; shift; if [ "$n" = 0 ]; then exec "$motus" "$@"; else exec "${launch[@]}" -n "$n" "$mpi" "$@"; fi; }
processes() { pgrep -f "${words[0]} $place/swing.motus"; }

for ((k = 1; k <= deaths; k++)); do
    rm -rf "$place/dead.h5" "$place/dead.csv" "$place/dead.csv.segments"
    if [ $((k % 2)) = 1 ]; then job=("${words[@]}") want=$whole; else job=("${words[@]}" "${events[@]}" "$place/dead.csv") want=$told; fi
    n=$((RANDOM % (ranks + 1))) again=$((RANDOM % 2 ? n : RANDOM % (ranks + 1))) delay=$((RANDOM % 3000 + 30))
    (job $n "${job[@]}" --machine interpreter -o "$place/dead.h5") >"$out" 2>"$err" &
    one=$!
    sleep "$(printf '%d.%03d' $((delay / 1000)) $((delay % 1000)))"
    victim=$one what="the job"
    if [ $n -gt 0 ] && [ $((RANDOM % 2)) = 1 ]; then
        mapfile -t all < <(processes | grep -vx $one)
        [ ${#all[@]} -gt 0 ] && victim=${all[RANDOM % ${#all[@]}]} what="a rank"
    fi
    kill -9 "$victim" 2>/dev/null
    wait $one 2>/dev/null
    for _ in $(seq 100); do [ -z "$(processes)" ] && break; sleep 0.05; done
    there=0
    if [ -s "$place/dead.h5" ]; then there=$(blocks "$place/dead.h5" 2>"$err" || echo none); fi
    that "death $k: $n ranks, $what after $delay ms: the file opens, with $there of $blocks blocks" [ "$there" != none ]
    (job $again "${job[@]}" -o "$place/dead.h5" --resume --json) >"$out" 2>"$err"
    that "... --resume by $again ranks keeps what was whole" [ "$(jq .resumed "$out" 2>/dev/null)" = $((there * 4096 < 120000 ? there * 4096 : 120000)) ]
    that "... to the same bytes" [ "$(sum "$place/dead.h5")" = "$want" ]
    [ $((k % 2)) = 1 ] || that "... with the same events" cmp "$place/dead.csv" "$place/whole.csv"
    [ $((k % 2)) = 1 ] || that "... and nothing beside them" absent "$place/dead.csv.segments"
done

# --- disks that are too small -------------------------------------------------------------------------------------------------------------
cat >"$place/drive.motus" <<'M'
x'' = -sin(x) - 0.1 x' + 0.2 cos(2 t)
x(0) = 1
x'(0) = 0
method dop853
tolerance 1e-9
until 30000
M
run=(run "$place/drive.motus" --error none --quiet --checkpoint "2000 steps")
"$motus" "${run[@]}" -o "$place/run.h5"
long=$(sum "$place/run.h5")
mkdir "$place/small"
for ((k = 1; k <= full; k++)); do
    size=$((RANDOM % 7000 + 200))
    if ! mount -t tmpfs -o size=${size}k none "$place/small" 2>/dev/null; then
        echo "not run, since this user cannot mount: disks that are too small"
        break
    fi
    "$motus" "${words[@]}" -o "$place/small/full.h5" >"$out" 2>"$err"
    status=$?
    if [ $status = 0 ]; then that "disk $k of $size kB has room for a sweep" [ "$(sum "$place/small/full.h5")" = "$whole" ]
    else that "disk $k of $size kB has none for a sweep, and nothing is left on it" eval "[ $status = 1 ] && says 'No space left' '$err' && [ -z \"\$(ls '$place/small')\" ]"; fi
    rm -f "$place/small/"*
    "$motus" "${run[@]}" -o "$place/small/run.h5" >"$out" 2>"$err"
    status=$?
    if [ $status = 0 ]; then that "... it has room for a run" [ "$(sum "$place/small/run.h5")" = "$long" ]
    else
        that "... it has none for a run" eval "[ $status = 1 ] && says 'No space left' '$err'"
        rm -f "$place/moved.h5"
        [ -e "$place/small/run.h5" ] && cp "$place/small/run.h5" "$place/moved.h5"
        that "... whose file goes on where there is room" "$motus" "${run[@]}" -o "$place/moved.h5" --resume
        that "... to the same bytes" [ "$(sum "$place/moved.h5")" = "$long" ]
    fi
    umount "$place/small"
done

echo "$passed passed, $failed failed"
[ $failed = 0 ]
