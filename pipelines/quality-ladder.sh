#!/usr/bin/env bash
# Draft, good and final picture of one view, from one cache that grows from each to the next:
#   pipelines/quality-ladder.sh SCENE FOLDER [--photons N] [--rays N] [--accuracy A] [--width W] [--camera NAME]
# Writes FOLDER/draft.exr, good.exr, final.exr (and .png), FOLDER/scene.irradiance, which only ever gets more records, and ladder.csv:
# records, seconds so far, and how far each picture is from the final one (root mean square, of the mean).
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
[[ $# -ge 2 ]] || usage
scene=$1 folder=$2
shift 2
photons=400000 rays=256 accuracy=0.15 width=800 camera=''
take_all_options "photons rays accuracy width camera" "$@"
need_file "$scene"
need_programs
mkdir -p "$folder"
base=$folder/$(basename "${scene%.*}")
name=()
[[ -z $camera ]] || name=(--camera "$camera")
stats=$folder/stats.json
sum() { awk -v a="$1" -v b="$2" 'BEGIN { printf "%.2f", a + b }'; }

# 1. Photons serve all three.
phos-photons "$scene" --photons "$photons" --quiet --stats "$stats" -o "$base.photons"
seconds=$(figure seconds.total "$stats")
rm -f "$base.irradiance"
rows=()

# 2. Each step looks closer: records where a picture of its own width sees none yet, read from less and less far away.
step() { # name, share of the width, reach of a record when read, samples of a pixel, shadow rays of a pixel
  local place=$((width / $2)) earlier=(--estimate gather --accuracy "$accuracy" --rays "$rays")
  ((place > 0)) || place=1
  [[ ! -f $base.irradiance ]] || earlier=(--add-to "$base.irradiance")
  # The least reach of a record is a pixel of the final picture, for that will read it too.
  earlier+=(--min-radius-pixels "$(awk -v a="$accuracy" -v n="$2" 'BEGIN { print 1 / (a * n) }')")
  phos-irradiance "$scene" "$base.photons" --place view "${name[@]}" --width "$place" "${earlier[@]}" --quiet --stats "$stats" \
    -o "$base.irradiance"
  local records fresh
  records=$(figure records "$stats") fresh=$(figure records_new "$stats") seconds=$(sum "$seconds" "$(figure seconds.total "$stats")")
  phos-splat "$scene" "$base.irradiance" "${name[@]}" --width "$width" --accuracy "$3" --pixel-samples "$4" --light-samples "$5" \
    --quiet --stats "$stats" -o "$folder/$1.exr"
  seconds=$(sum "$seconds" "$(figure seconds.total "$stats")")
  phos-picture "$folder/$1.exr" --quiet -o "$folder/$1.png"
  rows+=("$1,$records,$fresh,$seconds")
}
step draft 8 0.9 1 4
step good 3 0.6 4 16
step final 1 0.4 16 64

# 3. What each was worth.
echo "picture,records,new_records,seconds,rmse_to_final" >"$folder/ladder.csv"
for row in "${rows[@]}"; do
  phos-compare "$folder/${row%%,*}.exr" "$folder/final.exr" --layer beauty --ignore-emission --json >"$stats"
  echo "$row,$(figure relative_rmse "$stats")" >>"$folder/ladder.csv"
done
rm -f "$stats"
cat "$folder/ladder.csv"
