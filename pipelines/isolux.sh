#!/usr/bin/env bash
# Lines of equal illuminance on a horizontal workplane, seen from above:
#   pipelines/isolux.sh LUX.csv SPACING OUT.svg [LX,LX,...]
# LUX.csv is what phos-sense writes for --grid SPACING (m) --height; +Y is up. Levels: those given, or six or so of round numbers.
# Cells of four sensors get lines; where a sensor is left out (in a table, behind a wall) there are none.
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
[[ $# -eq 3 || $# -eq 4 ]] || usage
need_file "$1"
[[ $2 =~ ^[0-9.eE+-]+$ ]] || usage

awk -F, -v spacing="$2" -v asked="${4:-}" '
  function round(v) { return int(v + (v < 0 ? -0.5 : 0.5)) }
  function step_of(range,   decade, s) {
    decade = 10 ^ int(log(range) / log(10) + 100) / 1e100
    s = range / decade
    return (s < 1.5 ? 0.2 : s < 3 ? 0.5 : s < 7 ? 1 : 2) * decade
  }
  # Where the level lies between two corners of a cell: "x y" in units of cells.
  function cut(level, i, j, di, dj, k, l,   a, b, t) {
    a = lux[i + di, j + dj]; b = lux[i + k, j + l]; t = (level - a) / (b - a)
    return (i + di + t * (k - di)) * px " " (j + dj + t * (l - dj)) * px
  }
  NR == 1 { for (c = 1; c <= NF; ++c) column[$c] = c; if (!("E_lx" in column)) { bad = 1; exit }; next }
  {
    # Names may hold commas; the ten columns after them do not.
    x = $(NF - 9); z = $(NF - 7); e = $(NF - 3)
    if (n++ == 0) { x0 = x; z0 = z }
    if (x < x0) x0 = x
    if (z < z0) z0 = z
    xs[n] = x; zs[n] = z; es[n] = e
    if (e > most) most = e
  }
  END {
    if (bad || n == 0) { print "isolux.sh: the table has no column E_lx, or no sensor" > "/dev/stderr"; exit 3 }
    px = 20
    for (k = 1; k <= n; ++k) {
      i = round((xs[k] - x0) / spacing); j = round((zs[k] - z0) / spacing)
      lux[i, j] = es[k]
      if (i > w) w = i
      if (j > h) h = j
    }
    if (asked != "") count = split(asked, levels, ",")
    else if (most > 0) { s = step_of(most); for (level = s; level < most; level += s) levels[++count] = level }
    printf "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"%d %d %d %d\" font-family=\"sans-serif\" font-size=\"9\">\n", -px, -px, (w + 2) * px + 80, (h + 2) * px
    printf "<rect x=\"0\" y=\"0\" width=\"%d\" height=\"%d\" fill=\"#f4f4f4\" stroke=\"#888\"/>\n", w * px, h * px
    for (m = 1; m <= count; ++m) {
      level = levels[m] + 0; path = ""
      for (i = 0; i < w; ++i) for (j = 0; j < h; ++j) {
        if (!((i, j) in lux && (i + 1, j) in lux && (i, j + 1) in lux && (i + 1, j + 1) in lux)) continue
        a = lux[i, j] >= level; b = lux[i + 1, j] >= level; c = lux[i + 1, j + 1] >= level; d = lux[i, j + 1] >= level
        found = 0
        if (a != b) at[found++] = cut(level, i, j, 0, 0, 1, 0)
        if (b != c) at[found++] = cut(level, i, j, 1, 0, 1, 1)
        if (c != d) at[found++] = cut(level, i, j, 1, 1, 0, 1)
        if (d != a) at[found++] = cut(level, i, j, 0, 1, 0, 0)
        for (k = 0; k + 1 < found; k += 2) path = path "M" at[k] "L" at[k + 1]
      }
      colour = sprintf("hsl(%d,80%%,40%%)", 240 - 240 * (count > 1 ? (m - 1) / (count - 1) : 1))
      printf "<path d=\"%s\" fill=\"none\" stroke=\"%s\"><title>%g lx</title></path>\n", path, colour, level
      printf "<text x=\"%d\" y=\"%d\" fill=\"%s\">%g lx</text>\n", w * px + 8, 9 + 12 * (m - 1), colour, level
    }
    print "</svg>"
  }' "$1" >"$3.part" || { code=$?; rm -f "$3.part"; exit "$code"; }
mv "$3.part" "$3"
