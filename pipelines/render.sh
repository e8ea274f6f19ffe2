#!/usr/bin/env bash
# Renders one picture from a scene file, with the settings that the scene requires, and keeps the photons and records for reuse:
#   pipelines/render.sh SCENE FOLDER [--quality draft|good|final] [--width W] [--camera NAME] [options of the scene, e.g. --sky clear]
#                       [--photons N] [--accuracy A] [--rays N] [--samples N] [--rounds N]
# --quality sets the error of the picture over its mean: about 10 % (draft), 5 % (good, the default) or 2 % (final). The options of the second line
# override the settings that follow from the quality: paths from the lamps, accuracy and gathered rays of a record, samples of a pixel, and the most
# rounds in which missing records are added. The programs must be on PATH, or where they were built or installed. The script writes FOLDER/scene.photons,
# .irradiance (records where the camera looks), .view.irradiance (the same, with records where the picture missed some), .exr, .png and -lux.png
# (illuminance in false colours); scene stands for the name of SCENE without its ending.
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
[[ $# -ge 2 ]] || usage
scene=$1 folder=$2
shift 2
quality=good width=1000 camera='' photons='' accuracy='' rays='' samples='' rounds=3
take_options "quality width camera photons accuracy rays samples rounds" "$@"
light=(${rest[@]+"${rest[@]}"})
for ((i = 0; i < ${#light[@]}; i += 2)); do  # options of the scene, each with a value
  [[ ${light[i]} == --* && $((i + 1)) -lt ${#light[@]} ]] || usage
done
case $quality in
  draft) error=0.1 pixels=4 ;;
  good) error=0.05 pixels=2 ;;
  final) error=0.02 pixels=1 ;;
  *) echo "render.sh: --quality $quality: give draft, good or final" >&2; exit 2 ;;
esac
need_file "$scene"

need_programs
name=$(basename "${scene%.*}")
mkdir -p "$folder"
file=$folder/$name
view=(--width "$width")
[[ -z $camera ]] || view+=(--camera "$camera")

# 1. The requirements of the scene, and the settings that are usual for the error. No pilot is run.
plan=$(phos-plan "$scene" --error "$error" --pilot-seconds 0 "${view[@]}" "${light[@]}" --json --quiet)
setting() { figure "$1" <<<"$plan"; }
[[ $plan != *'"--portals"'* || " ${light[*]} " == *' --portals '* ]] || light+=(--portals auto)
photons=${photons:-$(printf %.0f "$(setting photons)")} accuracy=${accuracy:-$(setting accuracy)} samples=${samples:-$(setting pixel_samples)}
estimate=(--estimate hull)
[[ $plan != *'"gather"'* ]] || estimate=(--estimate gather --rays "${rays:-$(setting rays)}" --error "$(awk -v e="$error" 'BEGIN { print e / 2 }')")
direct=(--direct interleaved --noise "$error")
edges=$(($(setting edge_samples) > samples ? $(setting edge_samples) - samples : 0))

# The least radius of a record, in pixels: smaller details get their light from the records next to them.
least=$(awk -v p="$pixels" -v a="$accuracy" 'BEGIN { print p / a }')

file_options "${light[@]}"
# 2. Photons from the lamps, and a kd-tree over them.
phos-photons "$scene" "${light[@]}" --photons "$photons" --reuse -o "$file.photons"
# 3. The cache: irradiance records where the camera looks.
phos-irradiance "$scene" "$file.photons" "${files[@]}" --place view "${view[@]}" "${estimate[@]}" --accuracy "$accuracy" \
  --min-radius-pixels "$least" --reuse -o "$file.irradiance"
# 4. More records at the points that the picture sees and no record covers, until none is missing or the rounds are done.
cp "$file.irradiance" "$file.view.irradiance"
for ((round = 1; round <= rounds; ++round)); do
  phos-splat "$scene" "$file.view.irradiance" "${files[@]}" "${view[@]}" --pixel-samples "$samples" --edge-samples $((edges + edges % 2)) \
    --direct none --gloss-samples 1 --layers weight --misses "$file.misses.csv" --quiet -o "$file.pass.exr"
  missing=$(($(wc -l <"$file.misses.csv") - 1))
  echo "round $round: $missing visible points without a record"
  ((missing > 0)) || break
  phos-irradiance "$scene" "$file.photons" "${files[@]}" --at "$file.misses.csv" --add-to "$file.view.irradiance" -o "$file.view.irradiance"
done
rm -f "$file.pass.exr" "$file.misses.csv"
# 5. The picture.
phos-splat "$scene" "$file.view.irradiance" "${files[@]}" "${view[@]}" --pixel-samples "$samples" --edge-samples $((edges + edges % 2)) \
  "${direct[@]}" -o "$file.exr"
phos-picture "$file.exr" -o "$file.png"
phos-picture "$file.exr" --layer illuminance.Y --false-colour -o "$file-lux.png"
echo "picture:  $file.exr"
echo "          $file.png"
echo "lux:      $file-lux.png"
