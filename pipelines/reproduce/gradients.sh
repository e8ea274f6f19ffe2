# RR-5264, figure 5: indirect light of one bounce in an empty Cornell box, records with several kinds of gradients.
table_gradients() {
  local scene=$data/cornell-empty.glb width kind error ward=0 moved=0
  width=$(pick 400 40)
  reference_pair "$work/reference" "$scene" --bounces 2 --width "$width" --samples "$(pick 256 8)" --threads "$threads"
  for kind in none ward-heckbert krivanek analytic hybrid; do
    phos-irradiance "$scene" --estimate gather --gather-bounces 1 --place view --width "$width" --rays "$(pick 4096 64)" --accuracy 0.4 --radius harmonic \
      --gradients "$kind" --stats "$work/$kind.json" "${common[@]}" -o "$work/$kind.irradiance"
    phos-splat "$scene" "$work/$kind.irradiance" --width "$width" --splat cpu --direct none --pixel-samples 4 --layers indirect "${common[@]}" -o "$work/$kind.exr"
    phos-compare "$work/$kind.exr" "$work/reference-1.exr" --layer indirect --difference "$work/$kind.png" --quiet >/dev/null
    error=$(true_error "$work/$kind.exr" "$work/reference" --layer indirect)
    case $kind in
      ward-heckbert) ward=$error ;;
      krivanek) moved=$error ;;
    esac
    row "error with gradients \"$kind\"" % - "$error" - "$(count_of records "$work/$kind.json") records"
  done
  claimed 'gradients of RR-5264 and of Ward and Heckbert' 'similar' "$moved and $ward %" "$moved < 1.25 * $ward && $ward < 1.25 * $moved" \
    'the figure shows differences in colours, without numbers'
}
