#!/usr/bin/env bash
# Makes a draft, a good and a final picture of one view, from one cache that grows from each picture to the next:
#   pipelines/quality-ladder.sh SCENE FOLDER [--photons N] [--rays N] [--accuracy A] [--width W] [--camera NAME]
# The script writes FOLDER/draft.exr, good.exr and final.exr (and .png), the cache FOLDER/scene.irradiance (scene stands for the name of SCENE without
# its ending), and the table FOLDER/ladder.csv. The table gives for each picture the number of records, the seconds so far, and the difference from
# the final picture (root mean square over mean).
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

# 1. The photons serve all three pictures.
phos-photons "$scene" --photons "$photons" --quiet --stats "$stats" -o "$base.photons"
seconds=$(figure seconds.total "$stats")
rm -f "$base.irradiance"
rows=()

# 2. Each step looks closer. It adds records where a picture of the width of this step finds none yet, and reads the records at shorter distances.
step() { # name, share of the width, reach of a record when read, samples of a pixel, shadow rays of a pixel
  local place=$((width / $2)) earlier=(--estimate gather --accuracy "$accuracy" --rays "$rays")
  ((place > 0)) || place=1
  [[ ! -f $base.irradiance ]] || earlier=(--add-to "$base.irradiance")
  # The least reach of a record is a pixel of the final picture, because the final picture reads this record too.
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

# 3. The difference of each picture from the final one.
echo "picture,records,new_records,seconds,rmse_to_final" >"$folder/ladder.csv"
for row in "${rows[@]}"; do
  phos-compare "$folder/${row%%,*}.exr" "$folder/final.exr" --layer beauty --ignore-emission --json >"$stats"
  echo "$row,$(figure relative_rmse "$stats")" >>"$folder/ladder.csv"
done
rm -f "$stats"
cat "$folder/ladder.csv"
