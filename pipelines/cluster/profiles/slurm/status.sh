#!/usr/bin/env bash
# Prints the state of a job of Slurm for Snakemake: running, success or failed. Slurm forgets finished jobs after a while (MinJobAge); sacct then tells,
# where the site keeps accounts.
set -euo pipefail

state=$(scontrol --oneliner show job "$1" 2>/dev/null | sed -n 's/.* JobState=\([A-Z_]*\).*/\1/p' || true)
[[ -n $state ]] || state=$(sacct --noheader --allocations --parsable2 --format=State --jobs="$1" 2>/dev/null | head -1 || true)
case $state in
  COMPLETED) echo success ;;
  PENDING | CONFIGURING | RUNNING | COMPLETING | SUSPENDED | REQUEUED | REQUEUE* | RESIZING | STAGE_OUT | SIGNALING | STOPPED) echo running ;;
  *) echo failed ;;
esac
