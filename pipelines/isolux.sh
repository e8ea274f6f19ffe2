#!/usr/bin/env bash
# Draws lines of equal illuminance on a horizontal workplane, seen from above:
#   pipelines/isolux.sh LUX.csv SPACING OUT.svg [LX,LX,...]
# LUX.csv is the table that phos-sense writes for --grid SPACING (m) --height; +Y is up. OUT may end in .png. LX,LX,... are the illuminances of
# the lines; without them the lines are at a few round numbers. A cell of the grid needs four sensors: where a sensor is left out (inside a table,
# behind a wall), the lines have a gap.
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
[[ $# -eq 3 || $# -eq 4 ]] || usage
need_file "$1"
[[ $2 =~ ^[0-9.eE+-]+$ ]] || usage
need_programs
phos-picture "$1" --contours E_lx --spacing "$2" ${4:+--levels "$4"} --quiet -o "$3"
