# Thesis, figure 4.9 and section 4.7.1: a Cornell box with a glossy wall, accuracy 0.25 of both kinds of records.
table_thesis_4_9() {
  local scene=$data/cornell-glossy22.glb width base=$work/box all none diffuse glossy radiance irradiance
  width=$(pick 1000 40)
  phos-photons "$scene" --photons "$(pick 400000 5000)" "${common[@]}" --reuse -o "$base.photons"
  phos-brdf "$scene" --max-order 10 --too-sharp cut "${common[@]}" --reuse -o "$base.brdf"
  all=$(timed phos-radiance "$scene" "$base.photons" "$base.brdf" --place view --width "$width" --accuracy 0.25 --rays "$(pick 4096 256)" --gloss cached \
    --stats "$base.json" "${common[@]}" -o "$base.radiance")
  radiance=$(count_of records "$base.json")
  irradiance=$(timed phos-irradiance "$scene" "$base.photons" "$base.radiance" --place view --width "$width" --accuracy 0.25 --estimate gather \
    --rays "$(pick 4096 64)" --stats "$base.json" "${common[@]}" -o "$base.irradiance")
  draw() { timed phos-splat "$scene" "$@" --width "$width" --splat cpu --direct none --pixel-samples 1 "${common[@]}" -o "$work/box.exr"; }
  none=$(draw "$base.irradiance" --accuracy 0.0001 --gloss-samples 0 --layers indirect)
  diffuse=$(draw "$base.irradiance" --gloss-samples 0 --layers indirect)
  glossy=$(draw "$base.irradiance" "$base.radiance" "$base.brdf" --gloss cached --layers indirect,glossy)
  draw "$base.irradiance" "$base.radiance" "$base.brdf" --gloss cached --layers beauty >/dev/null
  phos-picture "$work/box.exr" --quiet -o "$work/box.png"
  row 'irradiance records' - 3023 "$(count_of records "$base.json")" - 'Phong 22 here, 20 in the thesis'
  row 'radiance records' - 869 "$radiance" - 'order 10 at most'
  row 'seconds of all records' s 12.18 "$(calculate %.2f "$all + $irradiance")" - 'another machine; rays here, the drawn scene there'
  row 'drawing irradiance records' s 0.066 "$(calculate %.3f "$diffuse - $none")" - 'on the CPU here'
  row 'drawing radiance records' s 0.936 "$(calculate %.3f "$glossy - $diffuse")" - 'on the CPU here; by 400 texture look-ups a pixel there'
}
