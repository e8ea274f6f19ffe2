#!/usr/bin/env bash
# Films an animated scene: makes one cache for all frames, a picture of each frame and, where ffmpeg is installed, a video.
#   pipelines/film.sh SCENE FOLDER [--frames A:B] [--photons N] [--rays N] [--width W] [--camera NAME] [--samples N]
# Without --frames, all frames are filmed. The script writes FOLDER/scene.irradiance, FOLDER/frames/0000.exr and .png ..., and FOLDER/scene.mp4; scene
# stands for the name of SCENE without its ending.
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
[[ $# -ge 2 ]] || usage
scene=$1 folder=$2
shift 2
frames='' photons=100000 rays='' width=640 camera='' samples=4
take_all_options "frames photons rays width camera samples" "$@"
need_file "$scene"
need_programs
mkdir -p "$folder/frames"
base=$folder/$(basename "${scene%.*}")
if [[ -z $frames ]]; then
  count=$(phos-scene "$scene" --json | figure frames)
  ((count > 0)) || { echo "film.sh: $scene: is not animated; pipelines/render.sh renders it, or give --frames" >&2; exit 2; }
  frames=0:$((count - 1))
fi
view=(--width "$width")
[[ -z $camera ]] || view+=(--camera "$camera")

# 1. The cache: records that live through the frames, where the camera sees them.
phos-temporal "$scene" --frames "$frames" "${view[@]}" --photons "$photons" ${rays:+--rays "$rays"} --reuse -o "$base.irradiance"
# 2. A picture of each frame. Pictures of an interrupted run are kept.
phos-splat "$scene" "$base.irradiance" --frames "$frames" "${view[@]}" --pixel-samples "$samples" --reuse -o "$folder/frames/%04d.exr"
# 3. The same pictures as PNG, all with one exposure.
phos-picture "$folder/frames/%04d.exr" --frames "$frames" -o "$folder/frames/%04d.png"
echo "frames:   $folder/frames"
if command -v ffmpeg >/dev/null; then
  phos-picture "$folder/frames/%04d.exr" --frames "$frames" -o "$base.mp4"
  echo "video:    $base.mp4"
fi
