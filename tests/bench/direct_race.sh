#!/usr/bin/env bash
# Race of direct light in the records against shadow rays, view after view of a hall with 760 shining polygons and an overcast sky
# (hall.py), as in the close-ups of Ribardiere, Carre, Bouatouch 2011:
#   tests/bench/direct_race.sh FOLDER [--views "hall table column"] [--width W] [--rays N] [--traced "64 256"] [--interleaved "16 64"]
#                              [--photons N] [--samples N] [--threads N]
# A line per view and way: records made for it (those of earlier views are kept), their seconds, those of the picture and both
# together, and the picture's error: RMS over the mean against two references of N paths a pixel (64; made once, kept in FOLDER),
# their noise taken out. Ways: cached, and so many shadow rays a lamp, traced for each pixel or shared by 4 x 4. Programs from PATH or
# build/release/bin; needs python3.
set -euo pipefail
[[ $# -ge 1 && $1 != -* ]] || { sed -n '2,10s/^# //p' "${BASH_SOURCE[0]}" >&2; exit 2; }
source "$(dirname "${BASH_SOURCE[0]}")/racing.sh"
folder=$1
shift
views="hall table column" width=800 rays=256 traced="64 256" interleaved="16 64" photons=400000 samples=64 threads=0
take_all_options "views width rays traced interleaved photons samples threads" "$@"
mkdir -p "$folder"
scene=$folder/hall.obj
python3 "$here/hall.py" "$scene"
light=(--sky overcast --portals auto --threads "$threads" --quiet)

records() { # CACHE OPTION...
  local cache=$1 add=()
  shift
  [[ ! -e $cache ]] || add=(--add-to "$cache")
  timed phos-irradiance "$scene" "$folder/hall.photons" "${light[@]}" --place view --camera "$view" --width "$width" \
    --estimate gather --rays "$rays" "$@" "${add[@]}" --stats "$folder/records.json" -o "$cache"
}
row() { printf '%-8s %-16s %8s %9s %9s %8s %7s\n' "$@"; }
draw() { # WAY CACHE RECORDS RECORDS_S OPTION...
  local way=$1 cache=$2 made=$3 records_s=$4 picture_s
  shift 4
  picture_s=$(timed phos-splat "$scene" "$cache" "${light[@]}" --camera "$view" --width "$width" --layers beauty,emission "$@" \
    -o "$folder/picture.exr")
  row "$view" "$way" "$made" "$records_s" "$picture_s" "$(calculate %.2f "$records_s + $picture_s")" \
    "$(true_error "$folder/picture.exr" "$folder/$view-$width" --layer beauty --ignore-emission)"
}

rm -f "$folder"/{cached,traced}.irradiance
phos-photons "$scene" "${light[@]}" --photons "$photons" --reuse -o "$folder/hall.photons"
for view in $views; do
  reference_pair "$folder/$view-$width" "$scene" "${light[@]}" --camera "$view" --width "$width" --samples "$samples" --adaptive
done
row view way records records_s picture_s all_s 'error%'
for view in $views; do
  cached_s=$(records "$folder/cached.irradiance" --footprint adaptive --direct cached)
  draw cached "$folder/cached.irradiance" "$(count_of records_new "$folder/records.json")" "$cached_s"
  traced_s=$(records "$folder/traced.irradiance")
  made=$(count_of records_new "$folder/records.json")
  for n in $traced; do draw "traced $n" "$folder/traced.irradiance" "$made" "$traced_s" --direct traced --light-samples "$n"; done
  for n in $interleaved; do
    draw "interleaved $n" "$folder/traced.irradiance" "$made" "$traced_s" --direct interleaved --light-samples "$n"
  done
done
