# RR-5264, figure 7: a Cornell box whose back wall is Phong 22, from three views that share one cache; and the same by glossy rays. Both read
# light from one map of photons.
table_views() {
  local scene=$data/cornell-glossy22.glb width base=$work/box camera add seconds none cached traced error traced_error all of left
  width=$(pick 850 40)
  phos-photons "$scene" --photons "$(pick 400000 5000)" "${common[@]}" --reuse -o "$base.photons"
  phos-brdf "$scene" --too-sharp cut "${common[@]}" --reuse -o "$base.brdf"
  rm -f "$base.radiance"
  draw() { phos-splat "$scene" "$base.irradiance" "$@" --camera "$camera" --width "$width" --splat cpu --light-samples 1 --layers glossy "${common[@]}"; }
  for camera in measured left-view right-view; do
    add=()
    [[ ! -f $base.radiance ]] || add=(--add-to "$base.radiance")
    phos-irradiance "$scene" "$base.photons" --place view --camera "$camera" --width "$width" "${common[@]}" --reuse -o "$base.irradiance"
    seconds=$(timed phos-radiance "$scene" "$base.photons" "$base.brdf" --place view --camera "$camera" --width "$width" --rays "$(pick 4000 256)" \
      --accuracy 0.3 --gloss cached "${add[@]}" --stats "$base.json" "${common[@]}" -o "$base.radiance")
    none=$(timed draw --gloss traced --gloss-samples 0 -o "$base-none.exr")
    cached=$(timed draw "$base.radiance" "$base.brdf" --gloss cached --accuracy 0.6 -o "$work/$camera.exr")
    traced=$(timed draw --gloss traced --gloss-samples "$(pick 256 16)" -o "$base-traced.exr")
    phos-picture "$work/$camera.exr" --layer glossy --quiet -o "$work/$camera.png"
    reference_pair "$work/$camera" "$scene" --camera "$camera" --width "$width" --samples "$(pick 64 4)" --threads "$threads"
    error=$(true_error "$work/$camera.exr" "$work/$camera" --layer glossy)
    traced_error=$(true_error "$base-traced.exr" "$work/$camera" --layer glossy)
    case $camera in
      measured)
        all=$(count_of records "$base.json") of=25.8 left=260
        judged less 'records of the centre view' - 1121 "$all" 'accuracy 0.3 here; the paper states none'
        judged less 'size of a radiance record' bytes 1338 "$(calculate %.0f "$(stat -c %s "$base.radiance") / $all")" \
          "1.5 MB for 1121 records; here $(pick 'with two gradients and a standard error, as floats' 'and a head that weighs at toy size')" ;;
      *)
        of=11.2 paper=250
        [[ $camera == left-view ]] || of=10.3 paper=198
        judged less "further records of the $camera, % of the centre's" % "$(calculate %.1f "$paper / 11.21")" \
          "$(calculate %.1f "100 * $(count_of records_new "$base.json") / $all")" 'these views differ from the paper'"'"'s a little' ;;
    esac
    row "$camera: seconds of records and of drawing them" s "$of" "$(calculate %.2f "$seconds + $cached - $none")" - 'another machine; a Pentium 4 of 2.26 GHz in the paper'
    row "$camera: error of the glossy layer" % - "$error" - "by rays $traced_error %"
    judged more "$camera: time of rays over that of records, at equal error" - "$(ratio "$left" "$of")" \
      "$(ratio "$(equal_seconds "$(calculate %.3f "$traced - $none")" "$traced_error" "$error")" "$(calculate %.3f "$seconds + $cached - $none")")" \
      'the paper compares by eye; rays here are drawn by importance, by a faster ray tracer'
  done
}
