#!/usr/bin/env bash
# Renders a glossy scene from several cameras, one after another. The pictures share one growing cache:
#   pipelines/glossy-views.sh SCENE FOLDER CAMERA... [--photons N] [--width W] [--accuracy A] [--rays N] [--samples N]
# Each view adds only the records that earlier views did not make; FOLDER/records.csv counts the records of each view. The pictures are
# FOLDER/CAMERA.exr and .png, the caches FOLDER/scene.irradiance and .radiance; scene stands for the name of SCENE without its ending. Only broad gloss
# is cached (see phos-brdf); other gloss is traced.
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
[[ $# -ge 3 ]] || usage
scene=$1 folder=$2
shift 2
photons=400000 width=400 accuracy=0.3 rays=4096 samples=4
take_options "photons width accuracy rays samples" "$@"
cameras=(${rest[@]+"${rest[@]}"})
[[ " ${cameras[*]-} " != *' -'* ]] || usage
((${#cameras[@]} > 0)) || usage
need_file "$scene"
need_programs
mkdir -p "$folder"
base=$folder/$(basename "${scene%.*}")

# 1. Photons, and the lobes of the glossy materials.
phos-photons "$scene" --photons "$photons" --reuse -o "$base.photons"
phos-brdf "$scene" --reuse -o "$base.brdf"
# 2. View by view: the records that the view lacks are added to the caches, and its picture is drawn.
rm -f "$base.irradiance" "$base.radiance"
count() { figure "$1" "$folder/stats.json"; }
echo "camera,radiance_records,radiance_new,irradiance_records,irradiance_new" >"$folder/records.csv"
for camera in "${cameras[@]}"; do
  view=(--place view --camera "$camera" --width "$width" --stats "$folder/stats.json")
  earlier=()
  [[ ! -f $base.radiance ]] || earlier=(--add-to "$base.radiance")
  phos-radiance "$scene" "$base.photons" "$base.brdf" "${view[@]}" --accuracy "$accuracy" --rays "$rays" "${earlier[@]}" \
    -o "$base.radiance"
  line=$camera,$(count records),$(count records_new)
  earlier=()
  [[ ! -f $base.irradiance ]] || earlier=(--add-to "$base.irradiance")
  phos-irradiance "$scene" "$base.photons" "$base.radiance" "${view[@]}" "${earlier[@]}" -o "$base.irradiance"
  echo "$line,$(count records),$(count records_new)" >>"$folder/records.csv"
  phos-splat "$scene" "$base.irradiance" "$base.radiance" "$base.brdf" --camera "$camera" --width "$width" --pixel-samples "$samples" \
    -o "$folder/$camera.exr"
  phos-picture "$folder/$camera.exr" -o "$folder/$camera.png"
done
rm -f "$folder/stats.json"
cat "$folder/records.csv"
