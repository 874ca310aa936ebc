#!/bin/bash
# A study on many nodes, by Dask; the folder must be on a disk that all nodes share:
#
#     sbatch many_nodes.sh STUDY.toml|FOLDER
#
# The scheduler and the study itself run on the first node, beside the workers. Two minutes before its time is up the
# study stops, and the job waits for its next turn; then it goes on.
#SBATCH --job-name=study
#SBATCH --ntasks=96
#SBATCH --cpus-per-task=1
#SBATCH --mem-per-cpu=2G
#SBATCH --time=12:00:00
#SBATCH --signal=B:USR1@120
#SBATCH --requeue
#SBATCH --open-mode=append

trap 'again=yes; kill -TERM "$study"' USR1
trap 'kill -TERM "$study"' TERM

export DASK_DISTRIBUTED__SCHEDULER__WORKER_SATURATION=1.0 # no task waits at a worker while another one is idle
place=$(mktemp --directory "$PWD/.dask-XXXXXX")
# Keys of this run: whoever lacks them can give work neither to the scheduler nor to a worker.
python -c 'import sys; from roughcontact.study.executors.keys import write_keys; write_keys(sys.argv[1])' "$place" ||
    { rm -r "$place"; exit 1; }
export DASK_DISTRIBUTED__COMM__REQUIRE_ENCRYPTION=True DASK_DISTRIBUTED__COMM__TLS__CA_FILE="$place/cert.pem"
for role in CLIENT SCHEDULER WORKER; do
    export "DASK_DISTRIBUTED__COMM__TLS__${role}__CERT=$place/cert.pem" "DASK_DISTRIBUTED__COMM__TLS__${role}__KEY=$place/key.pem"
done
# Status pages ask for no keys.
export DASK_DISTRIBUTED__SCHEDULER__HTTP__ROUTES='[]' DASK_DISTRIBUTED__WORKER__HTTP__ROUTES='[]'
dask scheduler --port 0 --no-dashboard --dashboard-address 127.0.0.1:0 --scheduler-file "$place/scheduler.json" 2> "$place/scheduler.log" &
scheduler=$!
until [ -s "$place/scheduler.json" ]; do sleep 1; done
srun dask worker --scheduler-file "$place/scheduler.json" --nthreads 1 --memory-limit 0 \
    --no-dashboard --dashboard-address 127.0.0.1:0 --death-timeout 120 --local-directory "${TMPDIR:-/tmp}" 2> "$place/workers.log" &
workers=$!

address=$(python -c 'import json, sys; print(json.load(open(sys.argv[1]))["address"])' "$place/scheduler.json")
roughcontact study run "$1" --executor dask --scheduler "$address" &
study=$!
# A trap interrupts the wait, but not the study.
while kill -0 "$study" 2> /dev/null; do
    wait "$study"
    status=$?
done
kill "$workers" "$scheduler"
wait "$workers" "$scheduler"
rm -r "$place"
if [ "$again" = yes ]; then scontrol requeue "$SLURM_JOB_ID"; fi
exit "$status"
