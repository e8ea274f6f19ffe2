#!/usr/bin/env bash
# First-bounce race: the whole way from .glb to .exr on one thread, and its error; beside it Blender's Cycles, if it is there
# (Debian packages blender and python3-numpy).
#   tests/bench/race.sh SCENE FOLDER [--places P] [--accuracy A] [--rays N] [--min-radius M] [--light-samples N] [--edge-samples N]
#                       [--side PIXELS] [--samples N] [--runs N] [--cycles SAMPLES]
# Light comes straight from lamps or over one surface. Records for P x P places of the view, then a picture of PIXELS x PIXELS.
# Errors are RMS over the mean, against two references of N paths a pixel (64) that are made once and kept in FOLDER, their noise
# taken out, emission left out. The defaults are those for sponza-flat at 3.6 %. Programs from PATH or build/release/bin.
set -euo pipefail
[[ $# -ge 2 && $1 != -* ]] || { sed -n '2,9s/^# //p' "${BASH_SOURCE[0]}" >&2; exit 2; }
source "$(dirname "${BASH_SOURCE[0]}")/racing.sh"
scene=$1 folder=$2
shift 2
places=112 accuracy=0.4 rays=256 min_radius=0.1 light_samples=7 edge_samples=16 side=1000 samples=64 runs=3 cycles=
take_all_options "places accuracy rays min_radius light_samples edge_samples side samples runs cycles" "$@"
need_file "$scene"
mkdir -p "$folder"
reference_pair "$folder/reference" "$scene" --bounces 2 --width "$side" --height "$side" --samples "$samples"
error_of() { true_error "$1" "$folder/reference" --layer beauty --ignore-emission; }
for ((run = 0; run < runs; ++run)); do
  records_s=$(timed phos-irradiance "$scene" --estimate gather --gather-bounces 1 --place view --width "$places" --height "$places" \
    --accuracy "$accuracy" --rays "$rays" --min-radius "$min_radius" --threads 1 --quiet -o "$folder/race.irradiance")
  picture_s=$(timed phos-splat "$scene" "$folder/race.irradiance" --width "$side" --height "$side" --accuracy 0.95 --splat cpu \
    --direct interleaved --pixel-samples 1 --light-samples "$light_samples" --edge-samples "$edge_samples" --layers beauty \
    --compression none --threads 1 --quiet -o "$folder/race.exr")
  printf 'phos: %.2f s (%.2f records, %.2f picture), error %s %%\n' "$(calculate %.3f "$records_s + $picture_s")" \
    "$records_s" "$picture_s" "$(error_of "$folder/race.exr")"
done
[[ -n $cycles ]] || exit 0
took=$(blender --background --python "$here/race_cycles.py" -- "$scene" "$folder/cycles.exr" "$side" "$cycles" 2>/dev/null |
  awk '/^rendered in/ { print $3 }')
[[ -n $took ]] || { echo "blender did not render" >&2; exit 1; }
printf 'Cycles, %s samples: %.1f s, error %s %%\n' "$cycles" "$took" "$(error_of "$folder/cycles.exr")"
