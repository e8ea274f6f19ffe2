#!/usr/bin/env bash
# Error against time of every way of estimating irradiance, on one scene and view:
#   tests/bench/error_against_time.sh SCENE FOLDER [--width W] [--samples N] [--threads N]
# Prints one line per setting: seconds for photons and for records, records, and the indirect layer's RMSE (without the references'
# noise) and bias relative to its mean. FOLDER keeps the two references of N samples (1024), made by phos-reference with other seeds
# where they are not there yet. Programs from PATH or build/release/bin.
set -euo pipefail
[[ $# -ge 2 ]] || { sed -n '2,6s/^# //p' "${BASH_SOURCE[0]}" >&2; exit 2; }
scene=$1 folder=$2
shift 2
width=200 threads=0 samples=1024
while (($# > 0)); do
  case $1 in --width) width=$2 ;; --threads) threads=$2 ;; --samples) samples=$2 ;; *) exit 2 ;; esac
  shift 2
done
PATH=$PATH:$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)/build/release/bin
mkdir -p "$folder"
view=(--width "$width" --height "$width")
quiet=(--quiet --progress never --threads "$threads")
name=$(basename "${scene%.*}")
reference=$folder/$name-reference
for seed in 0 1; do
  phos-reference "$scene" "${view[@]}" --samples "$samples" --seed $seed --reuse --quiet -o "$reference-$seed.exr"
done

number() { sed -n "s/.*\"$1\": *\([-+0-9.e]*\).*/\1/p" "$2" | head -1; }
line() { printf '%-10s %-46s %9s %9s %8s %8s %8s\n' "$@"; }

run() { # label, photons, options of phos-irradiance...
  local label=$1 photons=$2 inputs=("$scene") traced=0
  shift 2
  if ((photons > 0)); then
    phos-photons "$scene" "${quiet[@]}" --photons "$photons" --stats "$folder/p.json" -o "$folder/p.photons"
    inputs+=("$folder/p.photons") traced=$(number seconds.total "$folder/p.json")
  fi
  phos-irradiance "${inputs[@]}" "${quiet[@]}" "$@" --place view "${view[@]}" --stats "$folder/i.json" -o "$folder/i.irradiance"
  phos-splat "$scene" "$folder/i.irradiance" "${quiet[@]}" "${view[@]}" --pixel-samples 16 --direct none --gloss-samples 0 --splat cpu -o "$folder/i.exr"
  phos-compare "$folder/i.exr" "$reference-0.exr" --second-reference "$reference-1.exr" --layer indirect --json >"$folder/c.json"
  line "$label" "$photons paths, $*" "$traced" "$(number seconds.total "$folder/i.json")" "$(number records "$folder/i.json")" \
    "$(number relative_converged_rmse "$folder/c.json")" "$(number relative_bias "$folder/c.json")"
}

line estimator setting photons_s records_s records rmse bias
run default 400000
for paths in 200000 800000 3200000; do
  run hull "$paths" --estimate hull
  run kernel "$paths" --estimate kernel
done
for rays in 64 256 1024; do run gather 400000 --estimate gather --rays "$rays"; done
for side in 8 16 32; do run raster 400000 --estimate raster --raster-side "$side"; done
for accuracy in 0.2 0.6; do
  run hull 800000 --estimate hull --accuracy "$accuracy"
  run gather 400000 --estimate gather --rays 256 --accuracy "$accuracy"
done
