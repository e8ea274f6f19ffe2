#!/bin/sh
# Runs a command of cluster.py on a node of Slurm; slurm.py and profiles/slurm/submit.sh hand this script to sbatch:
#   sbatch [options] job.sh CLUSTER.PY run FOLDER JOB | array FOLDER LIST | publish CONFIG FOLDER
# `exec` makes Python the process that Slurm's signals reach. PHOS_PYTHON: another Python than python3.
exec "${PHOS_PYTHON:-python3}" "$@"
