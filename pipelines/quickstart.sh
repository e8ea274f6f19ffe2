#!/usr/bin/env bash
# Installs missing packages, builds phos, and renders a scene:
#   pipelines/quickstart.sh [SCENE]       default: Sponza if it is beside the project, else the Cornell box of data/
# Prints where the pictures are. A second run reuses packages, build and caches.
set -euo pipefail
start=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scene=${1:-}
[[ -z $scene || $scene == /* ]] || scene=$start/$scene
if [[ -z $scene ]]; then
  scene=data/cornell-measured.glb
  [[ -f ../shared/scenes/sponza.glb ]] && scene=../shared/scenes/sponza.glb
fi
pipelines/build.sh
echo "rendering $scene"
pipelines/render.sh "$scene" "$PWD/build/quickstart"
