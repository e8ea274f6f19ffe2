#!/usr/bin/env bash
# Makes the pictures, films, sensor grids and studies of a configuration, on one machine or on many, to the same bytes:
#   pipelines/cluster.sh CONFIG FOLDER [--profile local|slurm|sbatch|parallel] [--jobs N] [--wait yes|no]
# CONFIG: see pipelines/cluster/config.yaml. FOLDER holds all files; every machine mounts it at the same path. Results are in FOLDER/results. The same
# command after an interruption, or after a change of CONFIG, makes what is missing; the contents of files decide, not their dates.
#   local      Snakemake on this machine, --jobs cores (all)
#   slurm      Snakemake, each job a job of Slurm, at most --jobs in the queue (1000)
#   sbatch     Slurm without Snakemake: array jobs that wait for one another. --wait yes (default no): until they are done
#   parallel   GNU parallel on this machine, --jobs at a time (all cores)
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
[[ $# -ge 2 && $1 != --* ]] || usage
config=$1 folder=$2
shift 2
profile=local jobs='' wait=no
take_all_options "profile jobs wait" "$@"
need_file "$config"
[[ -z $jobs || $jobs =~ ^[1-9][0-9]*$ ]] || { echo "cluster.sh: --jobs $jobs: give a whole number above 0" >&2; exit 2; }
[[ $wait == yes || $wait == no ]] || { echo "cluster.sh: --wait $wait: give yes or no" >&2; exit 2; }
here=$(realpath "$(dirname "${BASH_SOURCE[0]}")")/cluster
install='Debian: pipelines/install.sh --cluster'
need() { command -v "$1" >/dev/null || { echo "cluster.sh: --profile $profile: $1: not installed ($2)" >&2; exit 3; }; }
case $profile in
  local) need snakemake "$install, or --profile parallel" ;;
  slurm) need sbatch "$install, or apt-get install slurm-wlm munge; --profile local needs no Slurm"
    need snakemake "$install, or --profile sbatch" ;;
  sbatch) need sbatch "$install, or apt-get install slurm-wlm munge; --profile parallel needs no Slurm" ;;
  parallel) need parallel "$install" ;;
  *) echo "cluster.sh: --profile $profile: give local, slurm, sbatch or parallel" >&2; exit 2 ;;
esac
need python3 "$install"
need_programs
export PYTHONDONTWRITEBYTECODE=1  # the scripts may lie in a folder of the system
cluster() { python3 "$here/cluster.py" "$@"; }

cluster plan "$config" "$folder"
exec 9>"$folder/.lock"
flock --nonblock 9 || { echo "cluster.sh: $folder: another cluster.sh works in this folder; wait for it" >&2; exit 3; }
# Publishing, at the end, tells what is missing and why.
snake() { snakemake --snakefile "$here/Snakefile" --profile "$here/profiles/$profile" --directory "$folder" \
  --config file="$(realpath "$config")" folder="$(realpath "$folder")" "$@" --quiet rules progress >"$folder/log/snakemake.log" 2>&1 || true; }
if [[ -n $(cluster list "$config" "$folder") ]]; then
  case $profile in
    local) snake --cores "${jobs:-all}" ;;
    slurm)
      cluster probe "$folder"
      snake ${jobs:+--jobs "$jobs"} ;;
    sbatch)
      cluster probe "$folder"
      if [[ $wait == no ]]; then
        cluster submit "$config" "$folder"
        echo "the last job links the results to $folder/results; the same command submits what is then still missing"
        exit 0
      fi
      cluster submit "$config" "$folder" --wait ;;
    parallel)  # level after level: all jobs whose files to read are there
      before=''
      while ready=$(cluster list "$config" "$folder" --ready) && [[ -n $ready && $ready != "$before" ]]; do
        parallel --will-cite ${jobs:+--jobs "$jobs"} python3 "$here/cluster.py" run "$folder" {} <<<"$ready" 2>>"$folder/log/parallel.log" || true
        before=$ready
      done ;;
  esac
fi
cluster publish "$config" "$folder" || { [[ ! -s $folder/log/snakemake.log || $profile == parallel ]] || echo "cluster.sh: Snakemake's own messages: $folder/log/snakemake.log" >&2; exit 3; }
