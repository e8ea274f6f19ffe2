# Thesis, table 5.2: a film from records that live through its frames, and from new photons and records for each frame, at one setting of both;
# the light of each frame by the same rays. Segments of 40 frames; indirect light of diffuse surfaces.
table_thesis_5_2() {
  source "$here/reproduce/films.sh"
  film_of cube-in-a-box 7.62 0.05 20
  film_of kite 6.52 0.05 20
  [[ $size == full ]] || return 0
  film_of moving-light 0.95 0.05 20
  film_of room 1.9 0.05 20
  film_of spheres 4.24 0.05 5
}
# film_of NAME PAPER ACCURACY LIFE
film_of() {
  local name=$1 paper=$2 first last width=$(pick 320 24) frame base=$work/$1 record_s=0 t records=0 bytes=0 all new_error film_error_ samples
  scene=$data/$name.glb
  [[ -f $scene ]] || made "$name" || { skipped "$name" 'python3 makes it, and is not on PATH'; return 0; }
  # Segments where things move: the kite comes down, the room's lamp swings.
  case $name in kite) first=170 ;; *) first=20 ;; esac
  last=$((first + $(pick 39 3)))
  local photons=$(pick 100000 2000) rays=$(pick 512 52) options
  options=(--width "$width" --estimate gather --accuracy 0.2 --rays "$rays")
  film_pair "$base-reference" "$scene" "$first:$last" "$width" "$(pick 256 4)"
  # New records for each frame.
  mkdir -p "$base-new" "$base-lives"
  local start=$(date +%s.%N)
  for ((frame = first; frame <= last; ++frame)); do
    phos-photons "$scene" --frame "$frame" --photons "$photons" "${common[@]}" -o "$base.photons"
    phos-irradiance "$scene" "$base.photons" --frame "$frame" --place view "${options[@]}" --stats "$base.json" "${common[@]}" -o "$base.irradiance"
    records=$((records + $(count_of records "$base.json"))) bytes=$((bytes + $(stat -c %s "$base.irradiance")))
    phos-splat "$scene" "$base.irradiance" --frame "$frame" --width "$width" --splat cpu --direct none --gloss-samples 0 --pixel-samples 1 \
      --layers indirect "${common[@]}" -o "$base-new/$(printf %04d "$frame").exr"
  done
  record_s=$(calculate %.2f "$(date +%s.%N) - $start")
  # Records that live.
  start=$(date +%s.%N)
  phos-temporal "$scene" --frames "$first:$last" "${options[@]}" --photons "$photons" --temporal-accuracy "$3" --max-life "$4" \
    --stats "$base.json" "${common[@]}" -o "$base.irradiance"
  draw_film "$base-lives" "$scene" "$base.irradiance" "$first:$last" "$width"
  all=$(calculate %.2f "$(date +%s.%N) - $start")
  new_error=$(film_error "$base-new" "$base-reference" "$first:$last")
  film_error_=$(film_error "$base-lives" "$base-reference" "$first:$last")
  local equal
  equal=$(equal_seconds "$record_s" "${new_error% *}" "${film_error_% *}")
  row "$name: seconds, new records and living ones" s - "$record_s and $all" - "frames $first to $last, $width wide"
  judged more "$name: speed-up" - "$paper" "$(ratio "$record_s" "$all")" 'same settings of both, as in the thesis'
  row "$name: error, new records and living ones" % - "${new_error% *} and ${film_error_% *}" - "speed-up at equal error $(ratio "$equal" "$all")"
  claimed "$name: flicker, new records and living ones" 'unnoticeable with living ones' "${new_error#* } and ${film_error_#* } %" \
    "${film_error_#* } + 0 < ${new_error#* } + 0" 'root mean square change against the mean light'
  local paper_records=-
  [[ $name != cube-in-a-box ]] || paper_records=15.4
  judged more "$name: records of all frames over living ones" - "$paper_records" "$(ratio "$records" "$(count_of records "$base.json")")" \
    'the thesis states 772,000 and 50,000 of the cube alone, in 400 frames'
  judged more "$name: memory of all frames over that of living ones" - "${paper_records/15.4/11.1}" "$(ratio "$bytes" "$(stat -c %s "$base.irradiance")")" \
    '138 MB and 12.4 MB in the thesis'
  phos-picture "$base-lives/$(printf %04d "$first").exr" --layer indirect --quiet -o "$base.png"
}
