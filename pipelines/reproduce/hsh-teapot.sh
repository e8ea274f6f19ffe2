# HSH paper, figures 3, 6 and 7: Newell's teapot, lit by a point lamp and by an environment through HSH and SH, and rotated HSH.

# lit NAME OPTION...: draws the two teapots by a point lamp to NAME.exr, with its errors in NAME.json.
lit() {
  local name=$1
  shift
  phos-brdf "$scene" --figure "$work/$name.exr" --figure-lamp=-6,9,9 --figure-intensity 30000 --figure-orders 7 --width "$(pick 700 60)" \
    --pixel-samples "$(pick 4 1)" --max-order 7 --too-sharp cut --resolution "$(pick 32 12)" "$@" "${common[@]}" --stats "$work/$name.json" \
    -o "$work/teapots.brdf"
}
# lit_error NAME MATERIAL BASIS: root mean square over the mean, %.
lit_error() {
  jq -r --arg m "$2" --arg b "$3" '.figure[] | select(.material == $m and .basis == $b) | 100 * .relative_rmse' "$work/$1.json" | xargs printf '%.2f'
}

# Figure 6, with the lobe alone in the harmonics as in the paper, and with the lobe times the cosine, which pictures need.
by_a_lamp() {
  local weight title material hsh sh
  for weight in none cosine; do
    title="figure 6, $([[ $weight == none ]] && echo 'lobe alone' || echo 'lobe times cosine')"
    lit "lamp-$weight" --figure-weight "$weight"
    for material in 'Phong cos^5' 'Ward 0.2 / 0.5'; do
      hsh=$(lit_error "lamp-$weight" "$material" hsh) sh=$(lit_error "lamp-$weight" "$material" sh)
      claimed "$title, $material: error by HSH and by SH" 'HSH is closer' "$hsh and $sh %" "$hsh < $sh" \
        'order 7, one point lamp without shadows, against the lobe itself'
    done
    phos-picture "$work/lamp-$weight.exr" --operator linear --key 25 --quiet -o "$work/lamp-$weight.png"
  done
  captioned lamp-none.png "from above: the lobe itself, HSH of order 7, SH of order 7; Phong on the left, Ward on the right. $(ward_warning)"
  captioned lamp-cosine.png 'the same, with the lobe times the cosine in the harmonics'
}

# Figure 3 draws how HSH are rotated; here the lamp's HSH are rotated from a frame that looks at the lamp to the frame of each point.
by_rotated_light() {
  local rotation phong ward why
  for rotation in via-sh digon zero-fill constant-fill even-fill; do
    [[ $size == full || $rotation == zero-fill ]] || continue
    lit "rotation-$rotation" --figure-rotation "$rotation"
    phong=$(lit_error "rotation-$rotation" 'Phong cos^5' hsh) ward=$(lit_error "rotation-$rotation" 'Ward 0.2 / 0.5' hsh)
    why='order 7, the point lamp of figure 6, lobe times cosine; the paper states no error'
    [[ $rotation != constant-fill ]] || why+='; seven bands give the lamp a luminance 90 degrees beside it, which goes on below that horizon'
    row "figure 3, rotation $rotation: error of HSH, Phong and Ward" % - "$phong and $ward" - "$why"
    phos-picture "$work/rotation-$rotation.exr" --operator linear --key 25 --quiet -o "$work/rotation-$rotation.png"
    captioned "rotation-$rotation.png" 'from above: the lobe itself, rotated HSH, SH (which rotate without error)'
  done
}

table_hsh_teapot() {
  made teapot obj || { skipped 'teapot' 'python3 makes it, and is not on PATH'; return 0; }
  local environment=$shared/env/uffizi.hdr order hsh sh
  [[ -f $environment ]] || environment=$data/sky.hdr
  for order in $(pick '7 10' '7'); do
    "$here/hsh-figures.sh" "$work/order-$order" "$scene" "$environment" --order "$order" --width "$(pick 700 40)" --samples "$(pick 4 1)" \
      --rays "$(pick 256 16)" --photons "$(pick 200000 2000)" >/dev/null 2>>"$folder/log.txt"
    error() { awk -F, -v p="$1" '$1 == p && $2 == "open" { printf "%.2f", 100 * $4 }' "$work/order-$order/errors.csv"; }
    hsh=$(error hsh) sh=$(error sh)
    claimed "order $order: error by HSH and by SH" 'HSH is closer' "$hsh and $sh %" "$hsh < $sh" \
      'Phong 20 under an environment, against 20 bands; SH rings below the horizon'
    cp "$work/order-$order/hsh.png" "$work/hsh-order-$order.png"
    cp "$work/order-$order/sh.png" "$work/sh-order-$order.png"
  done
  cp "$work/order-$order/traced.png" "$work/traced.png"
  made teapots
  by_a_lamp
  by_rotated_light
}
