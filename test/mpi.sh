#!/bin/bash
# motus-mpi: the same bytes on any number of ranks, kills of ranks and of mpirun, signals, and errors that are told once; by Open MPI and,
# where mpicc.mpich is installed, by MPICH.
#
# Each case is one line `ok` or `not ok`; the last line counts them. MOTUS is the program (build/motus), beside which motus-mpi lies.
cd "$(dirname "$0")/.." || exit 1
. test/cli/cases.sh
mpi=$(dirname "$motus")/motus-mpi

that "motus knows nothing of MPI" eval "! ldd '$motus' | grep -qiE 'mpi|pmix|hdf5'"
if [ ! -x "$mpi" ] || ! command -v mpirun >/dev/null; then
    echo "not run, since MPI is not installed: motus-mpi"
    echo "$passed passed, $failed failed"
    exit $((failed > 0))
fi
# Tests have more ranks than processors, and may be run by root.
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
# The number of ranks, then the words.
launch=(mpirun)
mpirun --version 2>/dev/null | grep -q "Open MPI" && launch+=(--quiet)
ranks() { local n=$1; shift; "${launch[@]}" -n "$n" "$mpi" "$@"; }

swing_until 100 >"$place/swing.motus"
swing=$place/swing.motus
words=(sweep "$swing" --vary "x(0)=0.1:3:100000" --record "final,max(energy)")

gives "--mpi-check" 0 ranks 3 --mpi-check
that "... says what each rank is" eval "[ \$(grep -c '^rank [012]: motus [0-9.]*, bits [0-9a-f]*, ' '$out') = 3 ] && says '3 ranks, '"
that "... and that they compute the same bits" eval "[ \$(grep -o 'bits [0-9a-f]*' '$out' | sort -u | wc -l) = 1 ]"
gives "descriptors 0 to 2 closed: a file gets no report" 0 "$motus" run "$swing" -o "$place/open.csv"
"$mpi" run "$swing" -o "$place/closed.csv" <&- >&- 2>&-
that "... of motus-mpi" eval "[ $? = 0 ] && cmp <(sed 's/open[.]csv/closed.csv/' '$place/open.csv') '$place/closed.csv'"
gives "alone, without mpirun" 0 "$mpi" run "$swing" --json
that "... it computes what motus does" eval "[ \"\$(jq -c .state '$out')\" = \"\$('$motus' run '$swing' --json | jq -c .state)\" ]"
gives "a verb that ranks do not share" 0 ranks 3 check "$swing"
that "... is done once" eval "[ \$(grep -c 'equations' '$out') = 1 ]"

# --- the same bytes -------------------------------------------------------------------------------------------------------------------
gives "the sweep by motus" 0 "$motus" "${words[@]}" -o "$place/one.h5" --threads 1
whole=$(sum "$place/one.h5")
for n in 1 2 3 4 7; do
    gives "by $n ranks" 0 ranks $n "${words[@]}" -o "$place/many.h5" --force --json
    that "... one report" json "$out"
    that "... of all ranks, which did all" eval "[ \"\$(jq -c '[(.ranks | length), ([.ranks[].trajectories] | add), ([.ranks[].blocks] | add)]' '$out')\" = '[$n,100000,25]' ]"
    that "... the same bytes" [ "$(sum "$place/many.h5")" = "$whole" ]
done
gives "a shard by ranks, the other by motus" 0 eval 'ranks 3 "${words[@]}" --shard 1/2 -o "$place/part%K.h5" --quiet && "$motus" "${words[@]}" --shard 2/2 -o "$place/part%K.h5" --quiet && "$motus" merge "$place"/part[12].h5 -o "$place/joined.h5" --quiet'
that "... the same bytes" [ "$(sum "$place/joined.h5")" = "$whole" ]
unequal=(sweep models/kepler.motus --vary "r'.y(0)=0.3:1.2:9000" --record final --method dop853 --tolerance 1e-9 --until 20)
gives "trajectories of unequal cost by motus" 0 "$motus" "${unequal[@]}" -o "$place/unequal1.h5" --quiet
gives "... and by ranks" 0 ranks 3 "${unequal[@]}" -o "$place/unequal3.h5" --quiet
that "... the same bytes" [ "$(sum "$place/unequal3.h5")" = "$(sum "$place/unequal1.h5")" ]

# ... and events, which ranks write to segments
hits=(sweep "$swing" --vary "x(0)=0.1:3:30000" --record "final,max(energy)" --until 20 --when "x = 0: record")
gives "a table of rows and one of events, by motus" 0 "$motus" "${hits[@]}" -o "$place/hits.csv" --events "$place/hits0.csv" --quiet
gives "an archive and a table of events, by motus" 0 "$motus" "${hits[@]}" -o "$place/hits1.h5" --events "$place/hits1.csv" --quiet
that "... the same events" cmp "$place/hits0.csv" "$place/hits1.csv"
for n in 2 3 7; do
    gives "... by $n ranks" 0 ranks $n "${hits[@]}" -o "$place/hits.h5" --events "$place/hits.csv" --force --quiet
    that "... the same rows" [ "$(sum "$place/hits.h5")" = "$(sum "$place/hits1.h5")" ]
    that "... and the same events, with nothing beside them" eval "cmp '$place/hits.csv' '$place/hits1.csv' && [ ! -e '$place/hits.csv.segments' ]"
done

# Few rows: ranks begin to write before the first one has made everything, or have nothing to do.
few=(sweep "$swing" --vary "x(0)=0.1:3:5000" --record final --when "x = 0: record" --threads 1 --quiet --force)
gives "... of few rows, by motus" 0 "$motus" "${few[@]}" -o "$place/few1.h5" --events "$place/few1.csv"
for k in 1 2 3 4 5 6; do
    gives "... by 4 ranks, $k" 0 ranks 4 "${few[@]}" -o "$place/few.h5" --events "$place/few.csv"
    that "... the same events" cmp "$place/few.csv" "$place/few1.csv"
done

# Of dear trajectories blocks are so small that all ranks have some.
gives "dear trajectories by 3 ranks" 0 ranks 3 sweep "$swing" --until 1e5 --method rk4 --step 0.125 --vary "x(0)=0.1:3:30" --record final --threads 1 -o "$place/dear.h5" --json
that "... of which more than one has some" holds '[.ranks[] | select(.trajectories > 0)] | length > 1'
printf '%s\n' 'k = 1' "x'' = -k x" 'x(0) = 1' "x'(0) = 0" 'until 10' >"$place/stiff.motus"
# --- errors, once ---------------------------------------------------------------------------------------------------------------------
# name, exit status, words of the message, number of ranks, words: told by one rank
once() {
    local name=$1 want=$2 message=$3 got
    shift 3
    timeout 60 "${launch[@]}" -n "$1" "$mpi" "${@:2}" >"$out" 2>"$err"
    got=$?
    that "$name" [ $got = "$want" ]
    that "... one message" eval "[ \$(grep -c '^motus: \|^[^ ].*:[0-9]*:[0-9]*: ' '$err') = 1 ] && says '$message' '$err'"
}
once "a model that is not there" 1 "cannot read" 3 sweep "$place/none.motus" --vary a=1,2 -o "$place/x.h5"
once "an archive that is there" 2 "exists" 3 "${words[@]}" -o "$place/many.h5"
once "a table" 2 "together can write rows only to an archive" 3 "${words[@]}" -o "$place/x.csv"
once "events to a pipe" 2 "events only to a file" 2 "${hits[@]}" -o "$place/x.h5" --events -
once "a picture" 2 "cannot draw a picture" 2 sweep models/henon-heiles.motus --vary "y(0)=0:0.3:9" --section "x = 0 rising" --until 9 -o "$place/x.h5" --plot "$place/x.svg"
once "another sweep" 2 "was made by another sweep" 2 "${words[@]}" --until 10 -o "$place/many.h5" --resume
once "a folder that is not there" 1 "cannot write" 4 "${words[@]}" -o "$place/none/x.h5"
once "an accuracy that is not reached" 1 "is not reached" 2 sweep "$place/stiff.motus" --vary "k=1,1e5" --accuracy 1e-15 --record final -o "$place/x.h5"
gives "--json before the verb" 0 timeout 60 "${launch[@]}" -n 2 "$mpi" --json "${words[@]}" -o "$place/x.h5" --force
gives "help" 0 ranks 3 sweep --help
that "... once" eval "[ \$(grep -c 'motus sweep MODEL' '$out') = 1 ]"
once "a word that there is not" 2 "unknown option" 3 "${words[@]}" --nonsense
mkdir "$place/small"
if mount -t tmpfs -o size=1m none "$place/small" 2>/dev/null; then
    once "a full disk" 1 "No space left" 3 "${words[@]}" -o "$place/small/x.h5"
    umount "$place/small"
else
    echo "not run, since this user cannot mount: a full disk"
fi

# --- death ----------------------------------------------------------------------------------------------------------------------------
slow=("${words[@]}" --machine interpreter --threads 1 --quiet)
# Kills what is asked for when some blocks are there; the exit status is in $status, the blocks in $there.
dies() {
    local signal=$1 whom=$2 job all
    rm -f "$place/killed.h5"
    "${launch[@]}" -n "$3" "$mpi" "${slow[@]}" -o "$place/killed.h5" >"$out" 2>"$err" &
    job=$!
    for _ in $(seq 300); do [ -e "$place/killed.h5" ] && [ "$(blocks "$place/killed.h5" 2>/dev/null || echo 0)" -ge 2 ] && break; sleep 0.05; done
    all=$(pgrep -f "$mpi ${slow[0]} $swing" | grep -vx $job)
    # shellcheck disable=SC2086
    case $whom in mpirun) kill -"$signal" $job ;; *) kill -"$signal" "$(shuf -n 1 -e $all)" ;; esac
    wait $job
    status=$?
    for one in $all; do for _ in $(seq 100); do kill -0 "$one" 2>/dev/null || break; sleep 0.05; done; done
    there=$(blocks "$place/killed.h5")
}
# The signal, whom it hits, of how many ranks, and how many go on (0: motus alone).
dies_and_goes_on() {
    local signal=$1 whom=$2 n=$3 again=$4
    dies "$signal" "$whom" "$n" 2>/dev/null
    that "SIG$signal to $whom of $n leaves some blocks, not all" eval "[ $there -ge 2 ] && [ $there -lt 25 ]"
    [ "$signal" = KILL ] || that "... ends with status 1" [ $status = 1 ]
    # Open MPI's mpirun passes SIGUSR1 on; of SIGTERM it makes an end of the job, and may lose what ranks print.
    if [ "$signal" = USR1 ]; then
        that "... and says how to go on, once" eval "[ \$(grep -c 'with --resume continues' '$err') = 1 ]"
    fi
    if [ "$again" = 0 ]; then gives "... --resume by motus" 0 "$motus" "${words[@]}" -o "$place/killed.h5" --resume --json
    else gives "... --resume by $again ranks" 0 ranks "$again" "${words[@]}" -o "$place/killed.h5" --resume --json; fi
    that "... computes no block again that was whole" [ "$(jq .resumed "$out")" = $((there * 4096)) ]
    that "... the same bytes" [ "$(sum "$place/killed.h5")" = "$whole" ]
}
dies_and_goes_on KILL rank 3 2
dies_and_goes_on KILL mpirun 2 3
dies_and_goes_on KILL rank 2 0
dies_and_goes_on TERM mpirun 3 1
dies_and_goes_on USR1 mpirun 2 0

# --- MPICH ----------------------------------------------------------------------------------------------------------------------------
build=$(dirname "$motus")
if command -v mpicc.mpich >/dev/null && command -v mpirun.mpich >/dev/null && [ -e "$build/libmotus-cli.a" ]; then
    ours=$mpi system=("${launch[@]}") mpi=$place/motus-mpich launch=(mpirun.mpich)
    gives "it compiles with MPICH" 0 mpicc.mpich -std=c17 -D_XOPEN_SOURCE=700 -Wall -Wextra -Wpedantic -Werror -I. -Iinclude mpi/*.c \
        "$build/libmotus-cli.a" "$build/libmotus-archive.a" "$build/libmotus.a" -lm -ldl -lpthread "-Wl,-rpath,$build" -o "$mpi"
    gives "... --mpi-check" 0 ranks 2 --mpi-check
    that "... by MPICH" says "2 ranks, MPICH"
    for n in 1 2 3 4 7; do
        gives "... $n ranks" 0 ranks $n "${words[@]}" -o "$place/many.h5" --force --quiet
        that "... the same bytes" [ "$(sum "$place/many.h5")" = "$whole" ]
    done
    once "... a model that is not there" 1 "cannot read" 3 sweep "$place/none.motus" --vary a=1,2 -o "$place/y.h5"
    once "... another sweep" 2 "was made by another sweep" 2 "${words[@]}" --until 10 -o "$place/many.h5" --resume
    dies_and_goes_on KILL rank 3 2
    dies_and_goes_on KILL mpirun 2 0
    mpi=$ours launch=("${system[@]}")
    dies KILL rank 2 2>/dev/null
    mpi=$place/motus-mpich launch=(mpirun.mpich)
    gives "what ranks of Open MPI have begun, those of MPICH go on with" 0 ranks 3 "${words[@]}" -o "$place/killed.h5" --resume --quiet
    that "... the same bytes" [ "$(sum "$place/killed.h5")" = "$whole" ]
else
    echo "not run, since it is not installed: MPICH"
fi

echo "$passed passed, $failed failed"
[ $failed = 0 ]
