#!/usr/bin/env bash
# Renders one picture, end to end, keeping every intermediate file for reuse:
#   pipelines/render.sh SCENE FOLDER [--photons N] [--accuracy A] [--width W] [--camera NAME] [--rounds N] [--samples N]
# Needs the programs on PATH, or else in build/release/bin. Writes FOLDER/scene.photons, .irradiance, .exr, .png and -lux.png.
set -euo pipefail

usage() { sed -n '2,4s/^# //p' "${BASH_SOURCE[0]}" >&2; exit 2; }
[[ $# -ge 2 ]] || usage
scene=$1 folder=$2
shift 2
photons=2000000 accuracy=0.2 width=1000 camera='' rounds=3 samples=4
while (($# > 0)); do
  [[ $# -ge 2 ]] || usage
  case $1 in
    --photons) photons=$2 ;;
    --accuracy) accuracy=$2 ;;
    --width) width=$2 ;;
    --camera) camera=$2 ;;
    --rounds) rounds=$2 ;;
    --samples) samples=$2 ;;
    *) usage ;;
  esac
  shift 2
done
[[ -f $scene ]] || { echo "render.sh: $scene: no such file" >&2; exit 3; }

source "$(dirname "${BASH_SOURCE[0]}")/programs.sh"
name=$(basename "${scene%.*}")
mkdir -p "$folder"
file=$folder/$name
view=(--width "$width")
[[ -n $camera ]] && view+=(--camera "$camera")

# 1. Light: photons from the lamps, and a tree over them.
phos-photons "$scene" --photons "$photons" --reuse -o "$file.photons"
# 2. Cache: irradiance records where the photons are.
phos-irradiance "$scene" "$file.photons" --accuracy "$accuracy" --reuse -o "$file.irradiance"
# 3. Fill what this camera sees and no record covers, until nothing is missing.
cp "$file.irradiance" "$file.view.irradiance"
for ((round = 1; round <= rounds; ++round)); do
  phos-splat "$scene" "$file.view.irradiance" "${view[@]}" --pixel-samples "$samples" --direct none --gloss-samples 1 \
    --misses "$file.misses.csv" --quiet -o "$file.pass.exr"
  missing=$(($(wc -l <"$file.misses.csv") - 1))
  echo "round $round: $missing visible points without a record"
  ((missing > 0)) || break
  phos-irradiance "$scene" "$file.photons" --accuracy "$accuracy" --at "$file.misses.csv" \
    --add-to "$file.view.irradiance" -o "$file.view.irradiance"
done
rm -f "$file.pass.exr" "$file.misses.csv"
# 4. Picture.
phos-splat "$scene" "$file.view.irradiance" "${view[@]}" --pixel-samples "$samples" -o "$file.exr"
phos-picture "$file.exr" -o "$file.png"
phos-picture "$file.exr" --layer illuminance.Y --false-colour -o "$file-lux.png"
echo "picture:  $file.exr"
echo "          $file.png"
echo "lux:      $file-lux.png"
