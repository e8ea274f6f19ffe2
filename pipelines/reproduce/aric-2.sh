# Ribardiere et al., table 2: two close-ups of a villa with 11 luminaires of 760 triangles and an overcast sky; MDIC and HMDIC trace direct
# light with 4000 shadow rays a pixel, ARIC holds it in its records.
table_aric_2() {
  source "$here/reproduce/zones.sh"
  local scene rays=$(pick 256 27) width=$(pick 400 24) view photons_file=$work/villa.photons light=(--sky overcast --portals auto) way name paper records paper_records
  [[ $size == full ]] || light=()
  made villa || { skipped villa 'python3 makes it, and is not on PATH'; return 0; }
  phos-photons "$scene" "${light[@]}" --photons "$(pick 400000 5000)" "${common[@]}" --reuse -o "$photons_file"
  for view in chair:51.1:49.1:1.82:0.94 $(pick plant:22.2:25.4:2.38:1.53 ''); do
    local all=() counts=() least harmonic least_records harmonic_records
    IFS=: read -r view least harmonic least_records harmonic_records <<<"$view"
    for name in MDIC:circle-min:0.56 HMDIC:circle-harmonic:0.4 ARIC:adaptive:0.4:cached; do
      # 4000 rays of 11 lamps and a sky.
      zones "${name#*:}" "$work/$view-${name%%:*}" "$(pick 333 2)" --camera "$view" --width "$width"
      all+=("$all_s") counts+=("$made")
      row "$view, ${name%%:*}: records, and seconds of cache and picture" - - "$made; $records_s and $picture_s" - "another scene and machine than the paper's"
    done
    judged more "$view: records of MDIC over those of ARIC" - "$least_records" "$(ratio "${counts[0]}" "${counts[2]}")" 'one accuracy of each'
    judged more "$view: records of HMDIC over those of ARIC" - "$harmonic_records" "$(ratio "${counts[1]}" "${counts[2]}")" 'one accuracy of each'
    judged more "$view: seconds of MDIC over those of ARIC" - "$least" "$(ratio "${all[0]}" "${all[2]}")" '4000 shadow rays a pixel'
    judged more "$view: seconds of HMDIC over those of ARIC" - "$harmonic" "$(ratio "${all[1]}" "${all[2]}")" '4000 shadow rays a pixel'
  done
}
