# Thesis, section 6.3 and figure 6.9: irradiance from photons by their convex hull and by a disc, towards a border of the floor of an empty
# Cornell box; against paths traced at the same places. And seconds of photons and records.
table_thesis_6_9() {
  local scene=$data/cornell-empty.glb photons=$(pick 320000 20000) seconds records way bias
  seconds=$(timed phos-photons "$scene" --photons "$photons" --stats "$work/photons.json" "${common[@]}" -o "$work/box.photons")
  row "seconds of $(figure stored "$work/photons.json") photons" s 3.49 "$seconds" - '500,000 photons in the thesis; another machine'
  # Lines of places from the middle of a wall's foot to the middle of the floor; the lamp above is left out of both.
  awk -v lines="$(pick 24 6)" 'BEGIN { print "x,y,z,nx,ny,nz"
    for (i = 0; i < 14; ++i) for (k = 0; k < lines; ++k) printf "%.6f,0,%.6f,0,1,0\n", 0.002 + 0.27 * (i / 13) ^ 2, 0.12 + 0.3 * (k + 0.5) / lines }' >"$work/places.csv"
  phos-sense "$scene" --exact --samples "$(pick 16384 256)" --points "$work/places.csv" "${common[@]}" -o "$work/truth.csv"
  echo 'estimator,distance,bias' >"$work/bias.csv"
  for way in hull disc; do
    local options=(--estimate hull)
    [[ $way == hull ]] || options=(--estimate kernel --kernel disc)
    phos-irradiance "$scene" "$work/box.photons" --at "$work/places.csv" --place every --paths all "${options[@]}" "${common[@]}" -o "$work/$way.irradiance"
    phos-info "$work/$way.irradiance" --dump irradiance >"$work/$way.values.csv"
    paste -d, "$work/truth.csv" "$work/$way.values.csv" | awk -F, -v way="$way" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "E_lx") c = i; x = 2; next }
      { e = 0.2126 * $(NF - 2) + 0.7152 * $(NF - 1) + 0.0722 * $NF; sum[$x] += e; truth[$x] += $c; if (!($x in seen)) { seen[$x] = 1; order[++n] = $x } }
      END { for (i = 1; i <= n; ++i) print way "," order[i] "," 100 * (sum[order[i]] / truth[order[i]] - 1) }' >>"$work/bias.csv"
    rm "$work/$way.values.csv"
    bias=$(awk -F, -v way="$way" '$1 == way { printf "%.1f", $3; exit }' "$work/bias.csv")
    eval "bias_$way=$bias"
    if [[ $way == hull ]]; then
      claimed 'bias at the border, convex hull' 'removed' "$bias %" "($bias < 0 ? -($bias) : $bias) < 10" '2 mm from the wall; mean of the places'
    else
      row 'bias at the border, disc' % - "$bias" - 'figure 6.9 shows dark borders, without numbers'
    fi
  done
  phos-picture "$work/bias.csv" --x distance --y bias --series estimator --x-label 'distance from the wall, m' --y-label 'bias, %' \
    --title 'irradiance from photons near a border' -o "$work/bias.svg"
  seconds=$(timed phos-irradiance "$scene" "$work/box.photons" --estimate hull --max-candidates "$(pick 0 2000)" --stats "$work/records.json" "${common[@]}" -o "$work/box.irradiance")
  records=$(count_of records "$work/records.json")
  judged less 'time of a record by the hull' ms 3.71 "$(calculate %.3f "1000 * $seconds / $records")" "$records records in $seconds s, whole program; 2066 in the thesis"
  seconds=$(timed phos-irradiance "$scene" "$work/box.photons" --estimate raster --raster-side 64 --max-candidates "$(pick 2000 20)" --stats "$work/records.json" "${common[@]}" -o "$work/drawn.irradiance")
  records=$(count_of records "$work/records.json")
  judged less 'time of a record by drawing the scene' ms 2.6 "$(calculate %.3f "1000 * $seconds / $records")" 'OSMesa on the CPU here, a GeForce 7800 in the thesis'
  for way in hull disc; do
    phos-irradiance "$scene" "$work/box.photons" --estimate "${way/disc/kernel}" --max-candidates "$(pick 0 2000)" "${common[@]}" -o "$work/$way.irradiance"
    phos-splat "$scene" "$work/$way.irradiance" --width "$(pick 400 40)" --splat cpu --direct none --pixel-samples 1 --layers beauty,indirect "${common[@]}" -o "$work/$way.exr"
    phos-picture "$work/$way.exr" --layer indirect --quiet -o "$work/$way.png"
  done
}
