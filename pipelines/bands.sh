#!/usr/bin/env bash
# Renders one picture in N bands of wavelength, and computes the light at sensors in these bands. It runs every stage ceil(N / 3) times:
#   pipelines/bands.sh SCENE FOLDER N [--spectrum NAME=FILE]... [--photons N] [--rays N] [--width W] [--camera NAME] [--samples N]
#                      [--points CSV] [-- OPTION...]
# Each OPTION (--sky clear, ...) goes to every stage. The script writes FOLDER/scene.exr and .png and, with --points, FOLDER/scene-lux.csv; scene stands
# for the name of SCENE without its ending.
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
[[ $# -ge 3 ]] || usage
scene=$1 folder=$2 number=$3
shift 3
[[ $number =~ ^[0-9]+$ ]] && ((number >= 3 && number <= 400)) || { echo "bands.sh: $number: give 3 to 400 bands" >&2; exit 2; }
photons=500000 rays=256 width=640 camera='' samples=4 points='' every=()
while (($# > 0)); do
  case $1 in
    --spectrum)
      [[ $# -ge 2 ]] || usage
      every+=(--spectrum "$2")
      shift 2 ;;
    --photons | --rays | --width | --camera | --samples | --points)
      [[ $# -ge 2 ]] || usage
      declare "${1#--}=$2"
      shift 2 ;;
    --)
      every+=("${@:2}")
      break ;;
    *) usage ;;
  esac
done
need_file "$scene"
need_programs
mkdir -p "$folder/triplets"
base=$folder/$(basename "${scene%.*}")
view=(--width "$width")
[[ -z $camera ]] || view+=(--camera "$camera")

triplets=$(((number + 2) / 3))
pictures=() tables=() dark=()
for ((k = 1; k <= triplets; ++k)); do
  part=$folder/triplets/$k
  bands=(--bands "$number" --triplet "$k")
  # Where no lamp shines there is nothing to compute.
  summary=$(phos-scene "$scene" "${bands[@]}" "${every[@]}" --json)
  if [[ $summary != *'"flux_lm"'* ]]; then
    echo "triplet $k of $triplets: dark"
    dark+=("$k")
    continue
  fi
  # 1. Photons. Their file holds the number of the triplet, which the later stages take from it. 2. Records where the camera looks, at the same
  # places in every triplet. 3. The picture. 4. The sensors.
  phos-photons "$scene" "${bands[@]}" "${every[@]}" --photons "$photons" --reuse --quiet -o "$part.photons"
  phos-irradiance "$scene" "$part.photons" "${every[@]}" --estimate gather --rays "$rays" --place view "${view[@]}" --reuse --quiet -o "$part.irradiance"
  phos-splat "$scene" "$part.irradiance" "${every[@]}" "${view[@]}" --pixel-samples "$samples" --reuse --quiet -o "$part.exr"
  pictures+=("$part.exr")
  if [[ -n $points ]]; then
    phos-sense "$scene" "$part.irradiance" "${every[@]}" --points "$points" --quiet -o "$part.csv"
    tables+=("$part.csv")
  fi
  echo "triplet $k of $triplets: done"
done
join=()
((${#dark[@]} == 0)) || join=(--dark "$(IFS=,; echo "${dark[*]}")")
phos-bands "${pictures[@]}" ${join[@]+"${join[@]}"} -o "$base.exr"
phos-picture "$base.exr" -o "$base.png"
echo "picture:  $base.exr"
echo "          $base.png"
if [[ -n $points ]]; then
  phos-bands "${tables[@]}" ${join[@]+"${join[@]}"} -o "$base-lux.csv"
  echo "sensors:  $base-lux.csv"
fi
