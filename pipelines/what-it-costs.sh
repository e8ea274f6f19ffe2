#!/usr/bin/env bash
# Measures the cost of each part of the model, and the change of the picture without this part:
#   pipelines/what-it-costs.sh SCENE FOLDER [--photons N] [--rays N] [--accuracy A] [--width W] [--camera NAME] [--samples N]
# The script draws the scene with all parts, and then several times with one part left out or made cheaper. FOLDER/costs.csv gives for each part the
# seconds of the whole pipeline with and without it, and the change of the picture (root mean square over mean). The row `noise` is the change by
# another seed alone: smaller changes mean nothing. Parts that the scene does not require (see phos-scene) are not tried. FOLDER/*.png are the
# pictures.
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
[[ $# -ge 2 ]] || usage
scene=$1 folder=$2
shift 2
photons=200000 rays=256 accuracy=0.3 width=400 camera='' samples=4
take_all_options "photons rays accuracy width camera samples" "$@"
need_file "$scene"
need_programs
mkdir -p "$folder"
view=(--width "$width")
[[ -z $camera ]] || view+=(--camera "$camera")
stats=$folder/stats.json
required=$(phos-scene "$scene" --json)
requires() { grep -q "\"what\": \"$1\"" <<<"$required"; }

# The stages, each with its own options. `seconds` adds up their times.
records=(--estimate gather --accuracy "$accuracy" --rays "$rays")
stage() { # program, arguments...
  "$@" --quiet --stats "$stats"
  seconds=$(awk -v a="$seconds" -v b="$(figure seconds.total "$stats")" 'BEGIN { printf "%.3f", a + b }')
}
draw() { # name, options of phos-irradiance, ":", options of phos-splat
  local name=$1 of_records=() caches=("$folder/$1.irradiance")
  shift
  while (($# > 0)) && [[ $1 != : ]]; do of_records+=("$1"); shift; done
  (($# == 0)) || shift
  seconds=0
  stage phos-photons "$scene" --photons "$photons" -o "$folder/light.photons"
  if [[ $name == cached-gloss ]]; then
    stage phos-brdf "$scene" -o "$folder/gloss.brdf"
    stage phos-radiance "$scene" "$folder/light.photons" "$folder/gloss.brdf" --place view "${view[@]}" -o "$folder/gloss.radiance"
    caches+=("$folder/gloss.radiance" "$folder/gloss.brdf")
    of_records+=("$folder/gloss.radiance")
  fi
  stage phos-irradiance "$scene" "$folder/light.photons" --place view "${view[@]}" "${records[@]}" "${of_records[@]}" \
    -o "$folder/$name.irradiance"
  stage phos-splat "$scene" "${caches[@]}" "${view[@]}" --pixel-samples "$samples" "$@" -o "$folder/$name.exr"
  phos-picture "$folder/$name.exr" --quiet -o "$folder/$name.png"
}
change() { # name: the difference from the picture with all parts
  phos-compare "$folder/$1.exr" "$folder/all.exr" --layer beauty --ignore-emission --json >"$stats"
  figure relative_rmse "$stats"
}
compared() { # name, the part that is left out
  echo "$1,\"$2\",$whole,$seconds,$(change "$1")" >>"$folder/costs.csv"
}

draw all
whole=$seconds
echo "part,without it,seconds_with,seconds_without,change" >"$folder/costs.csv"
draw noise --seed 1 : --seed 1
compared noise "the same with another seed"
draw bounces --gather-bounces 1
compared bounces "one bounce of indirect light in place of all"
draw gathering --estimate hull
compared gathering "irradiance by counting photons in place of rays"
draw gradients --gradients none
compared gradients "records without gradients"
draw leak-test --leak-test ray : --leak-test ray
compared leak-test "nothing; the ray that tests for leaks through walls is added"
draw interleaved : --direct interleaved
compared interleaved "shadow rays shared by 4 x 4 pixels"
draw shadow-maps : --direct shadow-map
compared shadow-maps "shadow maps in place of shadow rays"
draw direct-light : --direct none
compared direct-light "no direct light"
if requires 'traced gloss' || requires 'radiance records'; then
  draw gloss : --gloss-samples 0
  compared gloss "no rays for gloss"
fi
if requires 'radiance records'; then
  draw cached-gloss : --gloss auto
  compared cached-gloss "gloss from radiance records in place of rays"
fi
if requires 'specular tracing'; then
  draw mirrors : --specular-depth 0
  compared mirrors "no mirrors and glass"
fi
rm -f "$stats"
cat "$folder/costs.csv"
