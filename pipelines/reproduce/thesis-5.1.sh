# Thesis, table 5.1 and figure 5.7: irradiance of the next frame as records of this one foretell it, by moving the hits of their rays and
# without; against records of the same places whose light is computed in the next frame.
table_thesis_5_1() {
  local scene=$data/cube-in-a-box.glb width=$(pick 200 24) first way
  echo 'way,error' >"$work/errors.csv"
  for first in $(pick '20 120 220 320' '20'); do
    film() { # NAME OPTION...
      local name=$1
      shift
      phos-temporal "$scene" --frames "$first:$((first + 1))" --width "$width" --estimate gather --gather-bounces 1 --rays "$(pick 2048 52)" --fade 0 \
        "$@" "${common[@]}" --reuse -o "$work/$name-$first.irradiance"
      phos-splat "$scene" "$work/$name-$first.irradiance" --frame $((first + 1)) --width "$width" --splat cpu --direct none --pixel-samples 1 \
        --layers illuminance "${common[@]}" -o "$work/frame.exr"
      phos-picture "$work/frame.exr" --layer illuminance --quiet -o "$work/$name.values"".csv"
    }
    # Records last both frames, whatever changes; the second light of a pair is never computed.
    film reprojection --lives rate --max-life 2 --temporal-accuracy 10 --temporal-gradients extrapolated --look-ahead reproject
    film none --lives rate --max-life 2 --temporal-accuracy 10 --temporal-gradients none --look-ahead none
    film truth --lives rate --max-life 1 --temporal-gradients none --look-ahead none
    for way in reprojection none; do
      awk -F, -v way="$way" 'FNR == 1 { next } NR == FNR { truth[FNR] = $3; next } truth[FNR] > 0 { d = 100 * ($3 / truth[FNR] - 1); print way "," (d < 0 ? -d : d) }' \
        "$work/truth.values.csv" "$work/$way.values.csv" >>"$work/errors.csv"
    done
  done
  rm -f "$work"/*.values.csv
  for way in reprojection none; do
    grep "^$way," "$work/errors.csv" | cut -d, -f2 | sort -g >"$work/sorted.txt"
    local label='with reprojection' most=30 mean=2.9 median=1.6
    [[ $way == reprojection ]] || label='without' most=32 mean=3.7 median=2.4
    read -r ours_mean ours_median ours_most < <(awk '{ v[NR] = $1; sum += $1 } END { printf "%.2f %.2f %.2f\n", sum / NR, v[int((NR + 1) / 2)], v[NR] }' "$work/sorted.txt")
    judged less "error $label, mean" % $mean "$ours_mean" 'cube in a box at pixels, first bounce; the scene and frames of the table are not named'
    judged less "error $label, median" % $median "$ours_median" 'of the same'
    judged less "error $label, most" % $most "$ours_most" 'of the same'
    [[ $way == none ]] || moved=$ours_mean
    # Share of pixels below an error, as figure 5.7.
    awk -v way="$label" '{ v[NR] = $1 } END { for (e = 0; e <= 10; e += 0.25) { while (k < NR && v[k + 1] <= e) ++k; print way "," e "," 100 * k / NR } }' "$work/sorted.txt" >"$work/share-$way.part"
  done
  { echo 'way,error,share'; cat "$work/share-reprojection.part" "$work/share-none.part"; } >"$work/shares.csv"
  rm -f "$work"/share-*.part "$work/sorted.txt"
  phos-picture "$work/shares.csv" --x error --y share --series way --y-min 0 --y-max 100 --x-label 'error, %' --y-label 'share of pixels, %' \
    --title 'light of the next frame' -o "$work/shares.svg"
  claimed 'mean error over that without reprojection' 'less than 1 (0.78)' "$(ratio "$moved" "$ours_mean")" "$moved < $ours_mean" 'reprojection helps'
}
