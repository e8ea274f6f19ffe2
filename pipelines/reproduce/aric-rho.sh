# Ribardiere et al., figures 12 and 13: adaptive zones with direct light in the records and without, and the threshold rho.
table_aric_rho() {
  source "$here/reproduce/zones.sh"
  local scene=$data/cornell-measured.glb width=$(pick 400 40) rays=$(pick 1024 64) light=() photons_file=$work/box.photons with with_s strict loose made records_s picture_s all_s
  reference_pair "$work/reference" "$scene" --width "$width" --samples "$(pick 256 8)" --adaptive --threads "$threads"
  phos-photons "$scene" --photons "$(pick 400000 10000)" "${common[@]}" --reuse -o "$photons_file"
  zones adaptive:0.4:cached "$work/cached" 30 --width "$width"
  with=$made with_s=$all_s
  zones adaptive:0.4 "$work/traced" 30 --width "$width"
  judged more 'records: direct light in them over traced' - 1.86 "$(ratio "$with" "$made")" 'another scene: 6016 and 3241 records in the paper'
  judged more 'seconds: direct light traced over in the records' - 2 "$(ratio "$all_s" "$with_s")" '30 shadow rays a pixel here'
  for rho in 0.01 0.1; do
    phos-irradiance "$scene" "$photons_file" --place view --width "$width" --estimate gather --rays "$rays" --footprint adaptive --accuracy 0.4 --direct cached \
      --rho "$rho" --stats "$work/rho.json" "${common[@]}" -o "$work/rho.irradiance"
    phos-splat "$scene" "$work/rho.irradiance" --width "$width" --splat cpu --pixel-samples 1 --layers beauty,emission --overlay records "${common[@]}" -o "$work/rho.exr"
    phos-picture "$work/rho.exr" --quiet -o "$work/records-rho-$rho.png"
    phos-splat "$scene" "$work/rho.irradiance" --width "$width" --splat cpu --pixel-samples 1 --edge-samples 4 --layers beauty,emission "${common[@]}" -o "$work/rho.exr"
    local error
    error=$(true_error "$work/rho.exr" "$work/reference" --layer beauty --ignore-emission)
    row "rho $rho: records" - - "$(count_of records "$work/rho.json")" - "error $error %"
    [[ $rho == 0.1 ]] && loose=$(count_of records "$work/rho.json") || strict=$(count_of records "$work/rho.json")
  done
  claimed 'records at rho 1 % and at 10 %' 'more at 1 %' "$strict and $loose" "$strict > $loose" 'figure 13, without numbers'
}
