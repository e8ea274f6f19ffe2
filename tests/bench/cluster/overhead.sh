#!/usr/bin/env bash
# What the workflow adds to jobs of 1 s, 10 s and 100 s, on two nodes of a Slurm that this script starts and stops, and on this machine by GNU parallel
# and Snakemake, two jobs at a time. The jobs sleep.
#   tests/bench/cluster/overhead.sh [FOLDER-OF-PROGRAMS] [--seconds "S..."] [--jobs N] [--profiles "P..."]     --seconds "1 10 100", --jobs 8
# The table: wall seconds, seconds of an ideal run (what the jobs took, two at a time), the difference for each job, and its share of the job.
set -euo pipefail
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
source "$project/pipelines/common.sh"
source "$project/tests/pipelines/cluster/site.sh"
PATH=${1:-$project/build/release/bin}:$PATH
seconds='1 10 100' jobs=8 profiles='parallel local sbatch slurm'
(($# == 0)) || take_all_options "seconds jobs profiles" "${@:2}"
scratch=$(mktemp -d /var/tmp/phos-overhead.XXXXXX)
trap 'site_stop; rm -rf "$scratch"' EXIT
trap 'exit 143' HUP INT TERM
[[ $profiles != *s[bl]* ]] || site_start "$scratch/site"
cd "$scratch"
real=$(command -v phos-photons)
mkdir slow
PATH=$scratch/slow:$PATH
echo "profile,job_s,jobs,wall_s,ideal_s,overhead_s_per_job,overhead_share"
for length in $seconds; do
  # phos-photons that sleeps before it traces a few photons
  printf '#!/bin/sh\n[ "$1" = --options-json ] || sleep %s\nexec %s "$@"\n' "$length" "$real" >slow/phos-photons
  chmod +x slow/phos-photons
  cat >slow.yaml <<END
scenes: {box: $project/data/cornell-empty.glb}
settings: {toy: {photons: --photons 1000 --caustic-photons 0, shards: $jobs}}
grids: {desk: {grid: --grid 0.2 --height 0.1, irradiance: --estimate gather --gather-bounces 1 --rays 16}}
END
  for profile in $profiles; do
    folder=$profile-$length more=(--jobs 2)
    [[ $profile != slurm ]] || more=()
    [[ $profile != sbatch ]] || more=(--wait yes)
    begin=$(date +%s.%N)
    "$project/pipelines/cluster.sh" slow.yaml "$folder" --profile "$profile" "${more[@]}" >said 2>&1 || { cat said >&2; exit 1; }
    end=$(date +%s.%N)
    awk -F, -v OFS=, -v profile="$profile" -v length_s="$length" -v wall="$(awk "BEGIN { print $end - $begin }")" '
      NR == 1 { next }
      { ++jobs; if ($1 ~ /^photons/) shards += $3; else others += $3 }
      END {
        ideal = shards / 2 + others; over = (wall - ideal) / jobs
        print profile, length_s, jobs, sprintf("%.1f", wall), sprintf("%.1f", ideal), sprintf("%.2f", over), sprintf("%.3f", over / length_s)
      }' "$folder/log/jobs.csv"
  done
done
