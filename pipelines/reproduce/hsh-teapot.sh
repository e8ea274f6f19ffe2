# HSH paper, figures 6 and 7: Newell's teapot, lit by an environment through HSH and SH.
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
  skipped 'one point lamp (fig. 6)' 'no option lights a reflection by a point lamp through harmonics'
  skipped 'rotation of harmonics (fig. 3)' 'no program shows it; tests/bench/hsh_rotation_table.cpp prints its accuracy'
}
