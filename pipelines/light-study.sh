#!/usr/bin/env bash
# Makes a lighting study of a room, to an error that you ask for:
#   pipelines/light-study.sh SCENE FOLDER [--error E] [--grid METRES] [--workplane METRES] [--margin METRES] [--width W] [--camera NAME]
#                            [--levels LX,LX,...] [--pilot S]
# The script plans a picture and the illuminance of a workplane, makes both, and measures their error. By default the error is 5 %, and the
# workplane lies 0.8 m above the floor with a sensor every 0.5 m. FOLDER/report.md holds mean and least illuminance, uniformity, and the measured
# error. Beside it stand the pictures image.png, lux.png (illuminance in false colours) and isolux.svg (lines of equal illuminance). Exit code 1:
# the error was not met.
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
[[ $# -ge 2 ]] || usage
scene=$1 folder=$2
shift 2
error=5% grid=0.5 workplane=0.8 margin=0 width=800 camera='' levels='' pilot=10
take_all_options "error grid workplane margin width camera levels pilot" "$@"
need_file "$scene"
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
need_programs
mkdir -p "$folder"
view=(--width "$width")
[[ -z $camera ]] || view+=(--camera "$camera")

# 1. The plan is made, carried out, measured and corrected. Code 1: the error was not met; the report says this.
status=0
phos-plan "$scene" --error "$error" --quantity both "${view[@]}" --grid "$grid" --workplane "$workplane" --margin "$margin" \
  --pilot-seconds "$pilot" --run -o "$folder" || status=$?
((status <= 1)) || exit "$status"
# 2. The uniformity of the workplane, from the same cache.
phos-sense "$scene" "$folder/light.irradiance" --points "$folder/sensors.csv" --summary "$folder/lux.json" --quiet -o "$folder/lux.csv"
# 3. Pictures: the room as the camera sees it, the illuminance in false colours, and lines of equal illuminance on the workplane.
phos-picture "$folder/image.exr" --quiet -o "$folder/image.png"
phos-picture "$folder/image.exr" --layer illuminance --false-colour --quiet -o "$folder/lux.png"
"$here/isolux.sh" "$folder/lux.csv" "$grid" "$folder/isolux.svg" ${levels:+"$levels"}

# 4. The report.
lux() { figure "$1" "$folder/lux.json"; }
verdict=$(figure verdict "$folder/plan.json")
{
  echo "# $(basename "${scene%.*}")"
  echo
  echo "The workplane lies $workplane m above the floor, with a sensor every $grid m:"
  echo
  echo "| sensors | mean lx | least lx | greatest lx | U0 = least / mean | Ud = least / greatest |"
  echo "|---|---|---|---|---|---|"
  echo "| $(lux number) | $(lux mean_lx) | $(lux min_lx) | $(lux max_lx) | $(lux U0) | $(lux Ud) |"
  echo
  echo "Accuracy: $verdict. The files plan.sh and plan.json hold the plan and its reasons."
  echo
  echo "![as seen](image.png) ![illuminance](lux.png) ![isolux](isolux.svg)"
} >"$folder/report.md"
cat "$folder/report.md"
exit "$status"
