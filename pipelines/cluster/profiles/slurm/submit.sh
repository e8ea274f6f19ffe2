#!/usr/bin/env bash
# Hands a job of Snakemake to Slurm, and prints its number: submit.sh JOBSCRIPT. The job runs cluster.py, without Snakemake. PHOS_SBATCH: further options
# of sbatch, like "--partition=night --account=light".
set -euo pipefail

cluster=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../..")
properties=$(sed -n 's/^# properties = //p' "$1")
value() { jq -r "$1" <<<"$properties"; }
folder=$(value .params.folder)
# shellcheck disable=SC2086  # several options
sbatch --parsable --job-name="phos-$(value .rule)" --requeue --chdir=/ --output=/dev/null --ntasks=1 --cpus-per-task="$(value .threads)" \
  --mem="$(value .resources.mem_mb)" --time="$(value .resources.minutes)" ${PHOS_SBATCH:-} \
  "$cluster/job.sh" "$cluster/cluster.py" run "$folder" "$(value .params.job)" | cut -d';' -f1
