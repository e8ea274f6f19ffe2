#!/usr/bin/env bash
# What phos-plan promises and what comes out, scene by scene and error by error:
#   tests/bench/plan_table.sh FOLDER [--errors "20% 10% 5% 2%"] [--width W] [--samples N] [--threads N] SCENE...
# A line each: error asked for; first round of --run: settings ("adaptive": zones of the records), predicted error, error that
# phos-plan measured, predicted and real seconds of the pipeline; last round: how many there were, error and seconds (of what earlier
# rounds had not made); and the error of the last picture against two references of N paths a pixel (384), which are made once and
# kept in FOLDER. Programs from PATH or build/release/bin.
set -euo pipefail
[[ $# -ge 2 ]] || { sed -n '2,8s/^# //p' "${BASH_SOURCE[0]}" >&2; exit 2; }
folder=$1
shift
errors="20% 10% 5% 2%" width=400 samples=384 threads=0 scenes=()
while (($# > 0)); do
  case $1 in
    --errors) errors=$2 && shift 2 ;; --width) width=$2 && shift 2 ;;
    --samples) samples=$2 && shift 2 ;; --threads) threads=$2 && shift 2 ;;
    -*) exit 2 ;; *) scenes+=("$1") && shift ;;
  esac
done
PATH=$PATH:$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)/build/release/bin
mkdir -p "$folder"

row() { printf '%-16s %5s  %-42s %9s %7s %7s %7s  %2s %7s %7s %7s\n' "$@"; }
# Value k (from 1) of a key in what a run reports.
value() { sed -n '/^  "run"/,$p' "$3" | sed -n "s/^ *\"$1\": *\([-+0-9.e]*\),*$/\1/p" | sed -n "${2}p"; }
percent() { awk -v x="$1" 'BEGIN { printf "%.2f%%", 100 * x }'; }
short() { awk -v x="$1" 'BEGIN { printf "%.1f", x }'; }

row scene asked settings 'predicted' measured pred_s real_s n last last_s true
for scene in "${scenes[@]}"; do
  name=$(basename "${scene%.*}")
  for seed in 901 902; do
    phos-reference "$scene" --width "$width" --samples "$samples" --adaptive --seed $seed --threads "$threads" --reuse --quiet \
      -o "$folder/ref_${name}_${seed#90}.exr"
  done
  for error in $errors; do
    run=$folder/run_${name}_${error%\%}
    code=0
    phos-plan "$scene" --error "$error" --width "$width" --threads "$threads" --run -o "$run" --verbose 2>"$run.log" || code=$?
    if ((code > 1)); then
      row "$name" "$error" "$(tail -1 "$run.log")" '' '' '' '' '' '' '' ''
      continue
    fi
    plan=$run/plan.json n=$(grep -c '"predicted_error"' "$run/plan.json")
    settings="p$(value photons 1 "$plan") a$(value accuracy 1 "$plan") r$(value rays 1 "$plan")"
    settings+=" s$(value pixel_samples 1 "$plan") e$(value edge_samples 1 "$plan") l$(value light_rays 1 "$plan") g$(value gloss_rays 1 "$plan")"
    phos-compare "$run/image.exr" "$folder/ref_${name}_1.exr" --second-reference "$folder/ref_${name}_2.exr" --ignore-emission \
      --json >"$run/compare.json"
    settings+=$(sed -n '/^ *"footprint": "adaptive"/{s/.*/ adaptive/p;q}' "$plan")
    true_error=$(sed -n 's/.*"relative_converged_rmse": *\([-+0-9.e]*\).*/\1/p' "$run/compare.json" | head -1)
    row "$name" "$error" "$settings" "$(percent "$(value predicted_error 1 "$plan")")" "$(percent "$(value error 1 "$plan")")" \
      "$(short "$(value predicted_s 1 "$plan")")" "$(short "$(value seconds 1 "$plan")")" "$n" \
      "$(percent "$(value error "$n" "$plan")")" "$(short "$(value seconds "$n" "$plan")")" "$(percent "$true_error")"
  done
done
