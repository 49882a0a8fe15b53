#!/bin/bash
# The results of a sweep in one file, once its jobs have ended, however they ended:
#    sbatch --dependency=afterany:JOB input/slurm/collect.sh FOLDER
# writes FOLDER.h5; a member that failed or is missing is marked there and told in the log.
#SBATCH --ntasks=1 --cpus-per-task=1 --mem-per-cpu=4G
#SBATCH --time=01:00:00
#SBATCH --requeue --open-mode=append

if [ $# -ne 1 ]; then
   echo "usage: sbatch --dependency=afterany:JOB [sbatch options] collect.sh FOLDER" >&2
   exit 1
fi
exec tiltpad-collect "$1" -o "${1%/}.h5"
