#!/bin/bash
# Submits a whole study as an array of jobs, the last of which makes the file of the study:
#    input/slurm/submit.sh CASE.nml [BLOCKS [TASKS_AT_A_TIME [sbatch options]]]
# A task performs one of the blocks of the runs. The defaults are a hundred blocks, or as many as there are runs, and fifty
# tasks at a time. The result is CASE.h5, and CASE/0001.h5, ... where runs keep samples.
set -eu

if [ $# -eq 0 ] || [[ ! "${2:-1} ${3:-1}" =~ ^[1-9][0-9]{0,8}\ [1-9][0-9]{0,8}$ ]]; then
   echo "usage: submit.sh CASE.nml [BLOCKS [TASKS_AT_A_TIME [sbatch options]]]" >&2
   exit 1
fi
# a name that begins with - is no option
[[ $1 != -* ]] || set -- "./$1" "${@:2}"
case=$1
blocks=${2:-100}
at_a_time=${3:-50}
scripts=$(readlink -f -- "$0")
scripts=${scripts%/*}
name=${case##*/}
name=${name%.*}

# an error in any run shows here and not in the log of a job; so does a case without a study
tiltpad --check --run 1 "$case" >/dev/null
tiltpad --check "$case" >/dev/null
runs=$(tiltpad --count "$case")
blocks=$((blocks < runs ? blocks : runs))
# with several clusters sbatch says NUMBER;CLUSTER
array=$(sbatch --parsable --array="1-$blocks%$at_a_time" "${@:4}" "$scripts/sweep.sh" "$case")
echo "$case: $runs runs in $blocks blocks, job ${array%%;*}; the last to end makes $name.h5"
