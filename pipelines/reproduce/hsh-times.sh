# HSH paper, table 1: the teapot drawn with HSH and SH of several orders. Their ratio is compared; frames a second of 2004 are not.
table_hsh_times() {
  made teapot || { skipped 'teapot' 'python3 makes it, and is not on PATH'; return 0; }
  local light=(--environment "$data/sky.hdr") width order hsh sh paper
  width=$(pick 700 40)
  phos-photons "$scene" "${light[@]}" --photons "$(pick 100000 1000)" "${common[@]}" --reuse -o "$work/teapot.photons"
  phos-irradiance "$scene" "$work/teapot.photons" "${light[@]}" "${common[@]}" --reuse -o "$work/teapot.irradiance"
  echo order,basis,seconds >"$work/seconds.csv"
  for paper in 2:220:223 3:138:160 5:26.2:29 8:3.1:3.28 10:1.6:1.73; do
    IFS=: read -r order hsh sh <<<"$paper"
    [[ $size == full || $order == [25] ]] || continue
    paper=$(ratio "$hsh" "$sh")
    phos-brdf "$scene" "${light[@]}" --max-order "$order" --too-sharp cut "${common[@]}" -o "$work/teapot.brdf"
    draw() {
      timed phos-splat "$scene" "$work/teapot.irradiance" "$work/teapot.brdf" "${light[@]}" --environment-mode "$1" --environment-order "$order" \
        --width "$width" --layers direct --pixel-samples 1 --splat cpu "${common[@]}" -o "$work/teapot.exr"
    }
    hsh=$(draw hsh)
    sh=$(draw sh)
    printf '%s,%s,%s\n' "$order" HSH "$hsh" "$order" SH "$sh" >>"$work/seconds.csv"
    judged more "order $order: speed of HSH over that of SH" - "$paper" "$(ratio "$sh" "$hsh")" \
      "$hsh and $sh s, whole program; $width pixels wide; the paper: frames a second on an ATI 9800 Pro"
  done
  phos-picture "$work/seconds.csv" --x order --y seconds --series basis --y-min 0 --title 'the teapot, drawn' -o "$work/seconds.svg"
}
