#!/usr/bin/env bash
# Race of the zones of records (Ribardiere, Carre, Bouatouch 2011, table 1), all of them gathered, on one scene and view:
#   tests/bench/footprint_race.sh SCENE FOLDER [--ways "circle-min:0.4 circle-harmonic:0.2 adaptive:0.2:cached ..."] [--width W]
#                                 [--rays N] [--light-samples N] [--photons N] [--paths "16 64"] [--samples N] [--threads N] [--runs N]
# A line per way (footprint:accuracy, with :cached for direct light in the records) and run: records, seconds of photons, records and
# picture, and the error of the picture: RMS over the mean, against two references of N paths a pixel (256; made once, kept in
# FOLDER), their noise taken out. Then the same for phos-reference with so many paths a pixel. Programs from PATH or build/release/bin.
set -euo pipefail
[[ $# -ge 2 && $1 != -* ]] || { sed -n '2,7s/^# //p' "${BASH_SOURCE[0]}" >&2; exit 2; }
source "$(dirname "${BASH_SOURCE[0]}")/racing.sh"
scene=$1 folder=$2
shift 2
ways="circle-min:0.28 circle-min:0.56 circle-harmonic:0.28 circle-harmonic:0.56 adaptive:0.2 adaptive:0.4 adaptive:0.2:cached"
width=800 rays=1024 light_samples=128 photons=1000000 paths="8 32" samples=256 threads=0 runs=1
take_all_options "ways width rays light_samples photons paths samples threads runs" "$@"
need_file "$scene"
mkdir -p "$folder"
base=$folder/$(basename "${scene%.*}")-$width
common=(--threads "$threads" --quiet)

error_of() { true_error "$1" "$base" --layer beauty --ignore-emission; }
row() { printf '%-24s %8s %9s %9s %9s %8s %7s\n' "$@"; }

reference_pair "$base" "$scene" --width "$width" --samples "$samples" --adaptive --threads "$threads"
row way records photons_s records_s picture_s all_s 'error%'
for ((run = 0; run < runs; ++run)); do
  for way in $ways; do
    IFS=: read -r footprint accuracy direct <<<"$way"
    photons_s=$(timed phos-photons "$scene" --photons "$photons" "${common[@]}" -o "$base.photons")
    records_s=$(timed phos-irradiance "$scene" "$base.photons" --place view --width "$width" --estimate gather --rays "$rays" \
      --footprint "$footprint" --accuracy "$accuracy" --direct "${direct:-traced}" --stats "$base.json" "${common[@]}" \
      -o "$base.irradiance")
    lamps=(--direct interleaved --light-samples "$light_samples")
    [[ -z $direct ]] || lamps=()
    picture_s=$(timed phos-splat "$scene" "$base.irradiance" --width "$width" --splat cpu --pixel-samples 1 \
      --edge-samples 16 --layers beauty,emission "${lamps[@]}" "${common[@]}" -o "$base.exr")
    row "$way" "$(count_of records "$base.json")" "$photons_s" "$records_s" "$picture_s" \
      "$(calculate %.2f "$photons_s + $records_s + $picture_s")" "$(error_of "$base.exr")"
  done
  for n in $paths; do
    all_s=$(timed phos-reference "$scene" --width "$width" --samples "$n" --seed 9 "${common[@]}" -o "$base.exr")
    row "$n paths" - - - - "$all_s" "$(error_of "$base.exr")"
  done
done
