# For tables of Ribardiere, Carre and Bouatouch to source: a picture by one kind of zones, all records gathered.

# zones WAY STEM LIGHT_SAMPLES OPTION...: WAY is footprint:accuracy, with :cached for direct light in the records. Sets made, records_s,
# picture_s and all_s; the picture is STEM.exr. Options of light and camera are in the array `light`, photons in $photons_file.
zones() {
  local footprint accuracy direct base=$2 samples=$3 lamps
  IFS=: read -r footprint accuracy direct <<<"$1"
  shift 3
  records_s=$(timed phos-irradiance "$scene" "$photons_file" "${light[@]}" --place view "$@" --estimate gather --rays "$rays" \
    --footprint "$footprint" --accuracy "$accuracy" --direct "${direct:-traced}" --stats "$base.json" "${common[@]}" -o "$base.irradiance")
  lamps=(--direct traced --light-samples "$samples")
  [[ -z $direct ]] || lamps=()
  picture_s=$(timed phos-splat "$scene" "$base.irradiance" "${light[@]}" "$@" --splat cpu --pixel-samples 1 --edge-samples 4 \
    --layers beauty,emission "${lamps[@]}" "${common[@]}" -o "$base.exr")
  made=$(count_of records "$base.json") all_s=$(calculate %.2f "$records_s + $picture_s")
  phos-picture "$base.exr" --quiet -o "$base.png"
}
