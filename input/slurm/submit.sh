#!/bin/bash
# Submits a whole study: the runs of a study as an array of jobs, and a job that collects their results in one file.
#    input/slurm/submit.sh CASE.nml [RUNS_A_TASK [TASKS_AT_A_TIME [sbatch options]]]
# The defaults are one run per task and fifty tasks at a time. The results are CASE/0001.h5, ... and CASE.h5.
set -eu

if [ $# -eq 0 ] || [[ ! "${2:-1} ${3:-1}" =~ ^[1-9][0-9]{0,8}\ [1-9][0-9]{0,8}$ ]]; then
   echo "usage: submit.sh CASE.nml [RUNS_A_TASK [TASKS_AT_A_TIME [sbatch options]]]" >&2
   exit 1
fi
# a name that begins with - is no option
[[ $1 != -* ]] || set -- "./$1" "${@:2}"
case=$1
each=${2:-1}
at_a_time=${3:-50}
scripts=$(readlink -f -- "$0")
scripts=${scripts%/*}
name=${case##*/}
name=${name%.*}

# an error in any run shows here and not in the log of a job; so does a case without a study
tiltpad --check --run 1 "$case" >/dev/null
tiltpad --check "$case" >/dev/null
runs=$(tiltpad --count "$case")
tasks=$(((runs + each - 1) / each))
# with several clusters sbatch says NUMBER;CLUSTER
array=$(sbatch --parsable --array="1-$tasks%$at_a_time" "${@:4}" "$scripts/sweep.sh" "$case" "$each")
collection=$(sbatch --parsable --dependency="afterany:${array%%;*}" "${@:4}" "$scripts/collect.sh" "$name")
echo "$case: $runs runs in $tasks tasks, job $array; then $name.h5, job $collection"
