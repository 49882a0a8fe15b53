#!/bin/bash
# Collects the results of a study in one file, after its jobs have ended, in any way:
#    sbatch --dependency=afterany:JOB input/slurm/collect.sh FOLDER
# writes FOLDER.h5; it marks runs that failed, and the log names those that are missing.
#SBATCH --ntasks=1 --cpus-per-task=1 --mem-per-cpu=4G
#SBATCH --time=01:00:00
#SBATCH --requeue --open-mode=append

if [ $# -ne 1 ]; then
   echo "usage: sbatch --dependency=afterany:JOB [sbatch options] collect.sh FOLDER" >&2
   exit 1
fi
# a name that begins with - is no option
[[ $1 != -* ]] || set -- "./$1" "${@:2}"
exec tiltpad-collect "$1" -o "${1%/}.h5"
