# Thesis, table 4.1: irradiance at 10,000 places of the cathedral, from the scene drawn on one plane above each, by three ways of standing in
# for directions beyond the plane; against rays over the whole hemisphere.
table_thesis_4_1() {
  local side border paper error scene
  if [[ -f $shared/sibenik-flat.glb && $size == full ]]; then
    scene=$shared/sibenik-flat.glb
  else
    made nave || { skipped 'nave' 'python3 makes it, and is not on PATH'; return 0; }
  fi
  side=$(pick 100 8)
  phos-reference "$scene" --bounces 0 --width "$side" --height "$side" --samples 1 "${common[@]}" -o "$work/places.exr"
  phos-picture "$work/places.exr" --layer position --quiet -o "$work/position.csv"
  phos-picture "$work/places.exr" --layer normal --quiet -o "$work/normal.csv"
  # Places with a normal: all that show a surface.
  paste -d, "$work/position.csv" "$work/normal.csv" | awk -F, 'NR == 1 { print "x,y,z,nx,ny,nz"; next }
    $8 ^ 2 + $9 ^ 2 + $10 ^ 2 > 0.98 { print $3 "," $4 "," $5 "," $8 "," $9 "," $10 }' >"$work/places.csv"
  light() {
    phos-irradiance "$scene" --at "$work/places.csv" --place every --gather-bounces 1 "$@" "${common[@]}" --reuse -o "$work/light.irradiance"
    phos-info "$work/light.irradiance" --dump irradiance
  }
  light --estimate gather --rays "$(pick 8192 256)" >"$work/truth.csv"
  for border in none:18.1 coverage:10.4 stretch:5.8; do
    paper=${border#*:} border=${border%:*}
    light --estimate raster --raster-side "$(pick 64 16)" --raster-border "$border" >"$work/$border.csv"
    error=$(awk -F, 'FNR == 1 { next } { e = 0.2126 * $1 + 0.7152 * $2 + 0.0722 * $3 } NR == FNR { truth[FNR] = e; sum += e; ++n; next }
      { squares += (e - truth[FNR]) ^ 2 } END { printf "%.2f", 100 * sqrt(squares / n) / (sum / n) }' "$work/truth.csv" "$work/$border.csv")
    case $border in
      none) paper_name='the plane alone' ;;
      coverage) paper_name="the plane's mean stands for the rest (LC04)" ;;
      stretch) paper_name='border pixels stretched (the thesis)' ;;
    esac
    judged less "$paper_name" % "$paper" "$error" "RMS over the mean, $(($(wc -l <"$work/places.csv") - 1)) places of $(basename "$scene" .glb), first bounce"
  done
}
