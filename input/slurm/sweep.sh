#!/bin/bash
# The runs of a study, as an array of jobs or all in one job:
#    sbatch --array=1-BLOCKS%AT_A_TIME input/slurm/sweep.sh CASE.nml
#    sbatch --cpus-per-task=CORES input/slurm/sweep.sh CASE.nml
#    sbatch --array=TASK input/slurm/sweep.sh CASE.nml BLOCKS
# The last makes one task of an array of BLOCKS tasks again. Each task performs a block of the runs on its cores, into a
# file of its own; the last one to end makes the study, CASE.h5, in the folder of submission. A job that is requeued or
# submitted again continues from the last checkpoints and skips complete runs. A run that fails does not stop the others.
#SBATCH --ntasks=1 --cpus-per-task=1 --mem-per-cpu=1G
#SBATCH --time=01:00:00
#SBATCH --signal=B:USR1@60
#SBATCH --requeue --open-mode=append

if [ $# -eq 0 ] || [ $# -gt 2 ]; then
   echo "usage: sbatch [sbatch options] sweep.sh CASE.nml [BLOCKS]" >&2
   exit 1
fi

# ---- the same in case.sh: Slurm runs a copy of a job script, so each script must be complete ----
signal=
program=
signalled=

# Slurm sends USR1 shortly before the time limit, and TERM for preemption, requeue or scancel. After TERM Slurm itself
# requeues the job or ends it.
trap 'pass_on USR1' USR1
trap 'pass_on TERM' TERM
# shellcheck disable=SC2317 # called by the traps
pass_on() {
   signal=$1
   signalled=yes
   [ -n "$program" ] && kill -s "$1" "$program" 2>/dev/null
}

# Runs a command and passes on the signals that come to this script; the status is that of the command.
run() {
   "$@" &
   program=$!
   # a signal may have come before the program ran
   [ -n "$signal" ] && kill -s "$signal" "$program"
   wait "$program"
   status=$?
   # a signal ends the wait, but not the program
   while [ -n "$signalled" ]; do
      signalled=
      wait "$program"
      status=$?
   done
   program=
   return "$status"
}

# Ends the job. A job that was stopped by its time limit goes back into the queue. A task of an array needs both its
# numbers for this, because the job number of one of the tasks is that of the whole array.
finish() {
   task=${SLURM_ARRAY_TASK_ID:+${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID}
   [ "$1" -gt 3 ] && [ "$signal" = USR1 ] && scontrol requeue "${task:-$SLURM_JOB_ID}"
   exit "$1"
}
# ---- end of what is the same ----

# a name that begins with - is no option
[[ $1 != -* ]] || set -- "./$1" "${@:2}"
run tiltpad --jobs "$SLURM_CPUS_ON_NODE" --block "${SLURM_ARRAY_TASK_ID:-1}/${2:-${SLURM_ARRAY_TASK_COUNT:-1}}" "$1"
finish $?
