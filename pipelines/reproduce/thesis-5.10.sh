# Thesis, figure 5.10: accuracy of light over time. Records of the first frame serve 20 frames, then new ones are made; without temporal
# gradients, with extrapolated and with interpolated ones, against light that is computed in each frame at the same places.
table_thesis_5_10() {
  source "$here/reproduce/films.sh"
  local scene=$data/cube-in-a-box.glb width=$(pick 160 24) first=20 last kind least mean
  last=$((first + $(pick 40 5)))
  local life=$(pick 20 3)
  film() { # NAME OPTION...
    phos-temporal "$scene" --frames "$first:$last" --width "$width" --gather-bounces 1 --rays "$(pick 1024 52)" --fade 0 "${@:2}" "${common[@]}" --reuse \
      -o "$work/$1.irradiance"
    draw_film "$work/$1" "$scene" "$work/$1.irradiance" "$first:$last" "$width"
  }
  film truth --lives rate --max-life 1 --temporal-gradients none --look-ahead none
  echo 'gradients,frame,accuracy' >"$work/accuracy.csv"
  for kind in none extrapolated interpolated; do
    film "$kind" --lives rate --max-life "$life" --temporal-accuracy 10 --temporal-gradients "$kind"
    phos-compare "$work/$kind/%04d.exr" "$work/truth/%04d.exr" --frames "$first:$last" --flicker --layer indirect --per-frame "$work/frames.csv" >/dev/null
    awk -F, -v kind="$kind" -v first="$first" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "relative_rmse") c = i; next } { print kind "," $1 - first "," 100 * (1 - $c) }' \
      "$work/frames.csv" >>"$work/accuracy.csv"
    read -r least mean < <(awk -F, -v kind="$kind" '$1 == kind { if (!n++ || $3 < least) least = $3; sum += $3 } END { printf "%.2f %.2f\n", least, sum / n }' "$work/accuracy.csv")
    if [[ $kind == interpolated ]]; then
      claimed 'least accuracy with interpolated gradients' 'above 98 %' "$least %" "$least > 98" "root mean square error of a frame; mean accuracy $mean %"
    else
      row "least accuracy, gradients \"$kind\"" % - "$least" - "mean accuracy $mean %; the figure is not in the text of the thesis"
    fi
  done
  phos-picture "$work/accuracy.csv" --x frame --y accuracy --series gradients --y-label 'accuracy, %' --title 'cube in a box' -o "$work/accuracy.svg"
}
