#!/bin/bash
# A study on all cores of one node:
#
#     sbatch one_node.sh STUDY.toml|FOLDER
#
# Two minutes before its time is up the study stops, and the job waits for its next turn; then it goes on.
#SBATCH --job-name=study
#SBATCH --nodes=1
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=24
#SBATCH --mem-per-cpu=2G
#SBATCH --time=12:00:00
#SBATCH --signal=B:USR1@120
#SBATCH --requeue
#SBATCH --open-mode=append

trap 'again=yes; kill -TERM "$study"' USR1
trap 'kill -TERM "$study"' TERM

roughcontact study run "$1" --workers "$SLURM_CPUS_PER_TASK" &
study=$!
# A trap interrupts the wait, but not the study: it still has to stop its workers.
while kill -0 "$study" 2> /dev/null; do
    wait "$study"
    status=$?
done
if [ "$again" = yes ]; then scontrol requeue "$SLURM_JOB_ID"; fi
exit "$status"
