#!/usr/bin/env bash
# Lines of equal illuminance on a horizontal workplane, seen from above:
#   pipelines/isolux.sh LUX.csv SPACING OUT.svg [LX,LX,...]
# LUX.csv is what phos-sense writes for --grid SPACING (m) --height; +Y is up. OUT may end in .png. Levels: those given, or a few round
# numbers. Cells of four sensors get lines; where a sensor is left out (in a table, behind a wall) there are none.
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
[[ $# -eq 3 || $# -eq 4 ]] || usage
need_file "$1"
[[ $2 =~ ^[0-9.eE+-]+$ ]] || usage
need_programs
phos-picture "$1" --contours E_lx --spacing "$2" ${4:+--levels "$4"} --quiet -o "$3"
