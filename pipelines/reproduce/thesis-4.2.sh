# Thesis, table 4.2: first bounce of two large diffuse scenes, 1000 x 1000, against a program that gathers light at every pixel. Shared
# scenes where they are, and those of this project in any case.
table_thesis_4_2() {
  local entry file accuracy paper places rays
  for entry in sibenik-flat.glb:0.15:29.7 sponza-flat.glb:0.1:47.1 nave:0.15:29.7 hall:0.1:47.1; do
    IFS=: read -r file accuracy paper <<<"$entry"
    if [[ $file == *.glb ]]; then
      [[ $size == full ]] || continue
      shared_scene "$file" || continue
    else
      made "$file" || { skipped "$file" 'python3 makes it, and is not on PATH'; continue; }
    fi
    race "$(basename "$scene" .glb)" "$accuracy" "$paper"
  done
}
race() { # NAME ACCURACY PAPER
  local width method=final-gather records_s picture_s ours error theirs their_error samples
  width=$(pick 1000 32)
  reference_pair "$work/$1-reference" "$scene" --bounces 2 --width "$width" --height "$width" --samples "$(pick 64 4)" --threads "$threads"
  records_s=$(timed phos-irradiance "$scene" --estimate gather --gather-bounces 1 --place view --width "$(pick 160 16)" --height "$(pick 160 16)" \
    --accuracy "$2" --rays "$(pick 512 64)" --stats "$work/$1.json" "${common[@]}" -o "$work/$1.irradiance")
  picture_s=$(timed phos-splat "$scene" "$work/$1.irradiance" --width "$width" --height "$width" --accuracy 0.95 --splat cpu --direct interleaved \
    --pixel-samples 1 --light-samples 16 --edge-samples 16 --layers beauty,emission "${common[@]}" -o "$work/$1.exr")
  phos-picture "$work/$1.exr" --quiet -o "$work/$1.png"
  ours=$(calculate %.2f "$records_s + $picture_s")
  error=$(true_error "$work/$1.exr" "$work/$1-reference" --layer beauty --ignore-emission)
  row "$1: records" - "$([[ $1 == nave || $1 == sibenik* ]] && echo 4076 || echo 4123)" "$(count_of records "$work/$1.json")" - "accuracy $2"
  row "$1: seconds" s "$([[ $1 == nave || $1 == sibenik* ]] && echo 14.3 || echo 13.7)" "$ours" - "$records_s s records, $picture_s s picture; error $error %"
  samples=$(pick 16 2)
  gather() { timed phos-reference "$scene" --method "$method" --bounces 2 --width "$width" --height "$width" --samples "$samples" --threads "$threads" --quiet --seed 9 -o "$work/$1-pixels.exr"; }
  theirs=$(gather "$1" 2>"$work/refused.txt") || {
    method=path
    theirs=$(gather "$1")
  }
  their_error=$(true_error "$work/$1-pixels.exr" "$work/$1-reference" --layer beauty --ignore-emission)
  judged more "$1: time of gathering at each pixel over ours, at equal error" - "$3" "$(ratio "$(equal_seconds "$theirs" "$their_error" "$error")" "$ours")" \
    "phos-reference --method $method, $theirs s and $their_error %$([[ $method == path ]] && echo '; it refuses final-gather'); the paper compares with Radiance, by eye"
}
