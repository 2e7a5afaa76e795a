#!/bin/bash
# The scripts of doc/cluster.md, as they are printed: GNU parallel, Snakemake, a Slurm array of which one task is killed and started
# again, and an MPI job of Slurm. All end with the bytes of one sweep. Slurm has one node, this machine, for the time of the test.
#
# Each case is one line `ok` or `not ok`; the last line counts them. MOTUS is the program (build/motus), beside which motus-mpi lies.
cd "$(dirname "$0")/.." || exit 1
. test/cli/cases.sh
motus=$(realpath "$motus")
export PATH=$(dirname "$motus"):$PATH
page=$PWD/doc/cluster.md
# The code block behind the line that is $1; of several such lines the first.
script() {
    awk -v name="$1" '
        $0 == name && !found { found = 1; next }
        found && /^```/ { if (inside) exit; inside = 1; next }
        inside { print }' "$page"
}
work() { rm -rf "$place/work"; mkdir "$place/work"; cd "$place/work" || exit 1; cp "$root/models/pendulum.motus" .; }
missing() { command -v "$1" >/dev/null && return 1; echo "not run, since it is not installed: $1"; }

work
script 'On one machine `motus sweep` uses all processors:' >one.sh
gives "the sweep on one machine" 0 sh -e one.sh
cp swings.h5 "$place/swings.h5"
whole=$(sum "$place/swings.h5")
that "... has a million trajectories" [ "$(head -c 100 swings.h5 | sed -n 's/^rows 0*//p')" = 1000000 ]

if ! missing parallel; then
    work
    script '### GNU parallel' >parallel.sh
    gives "shards by GNU parallel" 0 bash -e parallel.sh
    that "... the same bytes" [ "$(sum swings.h5)" = "$whole" ]
fi
if ! missing snakemake; then
    work
    script '`Snakefile`:' >Snakefile
    gives "shards by Snakemake" 0 snakemake --cores 2 --quiet
    that "... the same bytes" [ "$(sum swings.h5)" = "$whole" ]
fi

# --- Slurm ----------------------------------------------------------------------------------------------------------------------------
if missing slurmctld || missing slurmd || missing munged || [ "$(id -u)" != 0 ]; then
    echo "not run, since that needs Slurm, munge and root: the array"
    echo "$passed passed, $failed failed"
    exit $((failed > 0))
fi
slurm=$place/slurm
mkdir -p "$slurm/state" "$slurm/spool"
head -c 128 /dev/urandom >"$slurm/key"
chmod 400 "$slurm/key"
end_slurm() { for one in slurmd slurmctld munged; do [ -f "$slurm/$one.pid" ] && kill "$(cat "$slurm/$one.pid")"; done 2>/dev/null; sleep 1; }
trap 'end_slurm; rm -rf "$place"' EXIT
name=$(hostname -s)
cat >"$slurm/slurm.conf" <<C
ClusterName=test
SlurmctldHost=$name(127.0.0.1)
AuthType=auth/munge
AuthInfo=socket=$slurm/munge.sock
CredType=cred/munge
SlurmUser=root
SlurmdUser=root
StateSaveLocation=$slurm/state
SlurmdSpoolDir=$slurm/spool
SlurmctldPidFile=$slurm/slurmctld.pid
SlurmdPidFile=$slurm/slurmd.pid
SlurmctldLogFile=$slurm/slurmctld.log
SlurmdLogFile=$slurm/slurmd.log
SlurmctldPort=17817
SlurmdPort=17818
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
MinJobAge=600
SchedulerParameters=batch_sched_delay=0,requeue_setup_env_fail
NodeName=$name NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
C
export SLURM_CONF=$slurm/slurm.conf
if ! { munged --force --key-file="$slurm/key" --socket="$slurm/munge.sock" --pid-file="$slurm/munged.pid" --log-file="$slurm/munged.log" --seed-file="$slurm/seed" &&
    slurmctld && sleep 1 && slurmd; } >"$out" 2>&1; then
    echo "not run, since Slurm does not start here: the array"; sed 's/^/    /' "$out"
    echo "$passed passed, $failed failed"
    exit $((failed > 0))
fi
for _ in $(seq 60); do [ "$(sinfo -h -o %T 2>/dev/null)" = idle ] && break; sleep 0.5; done
# Waits until a job is over, at most so many seconds.
over() { for _ in $(seq $((4 * $2))); do [ -z "$(squeue -h -j "$1" 2>/dev/null)" ] && return 0; sleep 0.25; done; return 1; }

work
script '`swings.sbatch`:' >swings.sbatch
gives "a Slurm array" 0 sbatch --parsable swings.sbatch
job=$(cat "$out")
# shellcheck disable=SC2016
that "... and behind it the merge" sbatch --parsable --dependency="afterok:$job" --wrap 'motus merge part*.h5 -o swings.h5'
that "... is done" over "$((job + 1)),$job" 120
for _ in $(seq 100); do [ -e swings.h5 ] && break; sleep 0.25; done
that "... the same bytes" [ "$(sum swings.h5)" = "$whole" ]

# By the interpreter, so that a task takes some seconds: one is killed by the controller and starts again.
work
script '`swings.sbatch`:' | sed 's/--quiet/--machine interpreter --lanes 1 --quiet/; s/1e6/2e5/; s/--until 10/--until 40/; s/^#SBATCH --requeue/&\n#SBATCH --open-mode=append/' >swings.sbatch
gives "the sweep in short" 0 motus sweep pendulum.motus --vary "theta(0)=0.1:3:2e5" --record final --until 40 -o short.h5
job=$(sbatch --parsable swings.sbatch)
for _ in $(seq 200); do [ -s part2.h5 ] && break; sleep 0.1; done
sleep 1
that "a task is killed and requeued" scontrol requeue "${job}_2"
sleep 1
scontrol release "${job}_2" 2>/dev/null
scontrol update JobId="${job}_2" StartTime=now 2>/dev/null
that "... and the array is done all the same" over "$job" 300
gives "... its files are joined" 0 motus merge part*.h5 -o swings.h5
that "... to the same bytes" [ "$(sum swings.h5)" = "$(sum short.h5)" ]
that "... the task was started twice" [ "$(scontrol show job "${job}_2" | grep -o 'Restarts=[0-9]*')" = Restarts=1 ]

# Slurm's warning: the task ends behind its block, and its command goes on by itself.
work
script '`swings.sbatch`:' | sed 's/--quiet/--machine interpreter --lanes 1/; s/1e6/2e5/; s/--until 10/--until 40/; s/^#SBATCH --array.*/#SBATCH --array=1-2/' >swings.sbatch
job=$(sbatch --parsable swings.sbatch)
for _ in $(seq 200); do [ -s part1.h5 ] && break; sleep 0.1; done
sleep 1
that "a task is warned" scancel --batch --signal=USR1 "${job}_1"
that "... and ends" over "${job}_1" 60
that "... behind a block, with status 1" eval "grep -q 'with --resume continues' slurm-${job}_1.out && scontrol show job ${job}_1 | grep -q 'ExitCode=1:0'"
scancel "$job"
over "$job" 30

if [ -x "$(dirname "$motus")/motus-mpi" ] && ! missing mpirun; then
    work
    export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
    script '`swings-mpi.sbatch`:' >swings-mpi.sbatch
    gives "an MPI job of Slurm" 0 sbatch --parsable --wait swings-mpi.sbatch
    that "... the same bytes" [ "$(sum swings.h5)" = "$whole" ]
fi

cd "$root" || exit 1
echo "$passed passed, $failed failed"
[ $failed = 0 ]
