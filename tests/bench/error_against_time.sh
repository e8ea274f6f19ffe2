#!/usr/bin/env bash
# Error against time of every way of estimating irradiance, on one scene and view:
#   tests/bench/error_against_time.sh SCENE FOLDER [REFERENCE.exr] [--width W] [--threads N]
# Prints one line per setting: seconds for photons and for records, records, and the indirect layer's RMSE and bias relative to
# the mean of REFERENCE's (made by phos-reference, 1024 samples, where none is given). Programs from PATH or build/release/bin.
set -euo pipefail
[[ $# -ge 2 ]] || { sed -n '2,5s/^# //p' "${BASH_SOURCE[0]}" >&2; exit 2; }
scene=$1 folder=$2 reference=''
shift 2
[[ $# -gt 0 && $1 != --* ]] && { reference=$1; shift; }
width=200 threads=0
while (($# > 1)); do
  case $1 in --width) width=$2 ;; --threads) threads=$2 ;; *) exit 2 ;; esac
  shift 2
done
PATH=$PATH:$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)/build/release/bin
mkdir -p "$folder"
view=(--width "$width" --height "$width")
quiet=(--quiet --progress never --threads "$threads")
name=$(basename "${scene%.*}")
if [[ -z $reference ]]; then
  reference=$folder/$name-reference.exr
  phos-reference "$scene" "${view[@]}" --samples 1024 --reuse --quiet -o "$reference"
fi

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
  phos-compare "$folder/i.exr" "$reference" --layer indirect --json >"$folder/c.json"
  line "$label" "$photons paths, $*" "$traced" "$(number seconds.total "$folder/i.json")" "$(number records "$folder/i.json")" \
    "$(number relative_rmse "$folder/c.json")" "$(number relative_bias "$folder/c.json")"
}

line estimator setting photons_s records_s records rmse bias
for paths in 200000 800000 3200000; do
  run hull "$paths"
  run kernel "$paths" --estimate kernel
done
for rays in 64 256 1024; do
  run gather 400000 --estimate gather --rays "$rays"
  run raster 400000 --estimate raster --raster-side "$(awk "BEGIN { print int(sqrt($rays) + 0.5) }")"
done
for a in 0.4 0.1; do run gather 400000 --estimate gather --rays 256 --accuracy "$a"; done
