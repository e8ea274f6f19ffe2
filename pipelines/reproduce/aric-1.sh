# Ribardiere et al., table 1: a Cornell box by bidirectional paths (BPT), by circles of the least distance (MDIC), of the harmonic mean (HMDIC),
# and by adaptive zones with direct light in them (ARIC); 800 x 800.
table_aric_1() {
  source "$here/reproduce/zones.sh"
  local scene=$data/cornell-measured.glb width=$(pick 800 40) rays=$(pick 1024 64) light=() photons_file=$work/box.photons name way records cached errors=() seconds=() counts=()
  reference_pair "$work/reference" "$scene" --width "$width" --samples "$(pick 256 8)" --adaptive --threads "$threads"
  error_of() { true_error "$1" "$work/reference" --layer beauty --ignore-emission; }
  phos-photons "$scene" --photons "$(pick 1000000 10000)" "${common[@]}" --reuse -o "$photons_file"
  for name in MDIC:circle-min:0.56:2798:200:47 HMDIC:circle-harmonic:0.4:1443:102:47 ARIC:adaptive:0.4:1371:74:6; do
    IFS=: read -r name way records cached <<<"$(tr : ' ' <<<"$name" | awk '{ print $1 ":" $2 "@" $3 ":" $4 ":" $5 "/" $6 }')"
    way=${way/@/:}
    [[ $name != ARIC ]] || way+=:cached
    zones "$way" "$work/$name" 30 --width "$width"
    errors+=("$(error_of "$work/$name.exr")") seconds+=("$all_s") counts+=("$made")
    row "$name: records" - "$records" "$made" - "$way"
    row "$name: seconds of cache and picture" s "$cached" "$records_s/$picture_s" - "error ${errors[-1]} %; another machine"
  done
  local pair paper index
  for pair in 0:MDIC:2.04:3.09 1:HMDIC:1.05:1.86; do
    IFS=: read -r index name records paper <<<"$pair"
    judged more "records of $name over those of ARIC" - "$records" "$(ratio "${counts[index]}" "${counts[2]}")" 'one accuracy of each method, not one error'
    judged more "seconds of $name over those of ARIC, at equal error" - "$paper" \
      "$(ratio "$(equal_seconds "${seconds[index]}" "${errors[index]}" "${errors[2]}")" "${seconds[2]}")" "the paper compares by eye; seconds alone: $(ratio "${seconds[index]}" "${seconds[2]}")"
  done
  # Bidirectional paths, 12 a pixel as in the paper.
  local paths_s error
  paths_s=$(timed phos-reference "$scene" --width "$width" --method bidirectional --samples "$(pick 12 2)" --seed 9 --threads "$threads" --quiet -o "$work/BPT.exr")
  phos-picture "$work/BPT.exr" --quiet -o "$work/BPT.png"
  error=$(error_of "$work/BPT.exr")
  row 'BPT: seconds' s 81 "$paths_s" - "$(pick 12 2) paths a pixel, error $error %"
  judged more 'seconds of BPT over those of ARIC, at equal error' - 1.01 "$(ratio "$(equal_seconds "$paths_s" "$error" "${errors[2]}")" "${seconds[2]}")" \
    'the paper sets equal times, where BPT is the noisier'
  claimed 'error of ARIC' '1 % (mean)' "${errors[2]} % (RMS)" "${errors[2]} < 2" 'figure 11 of the paper; edges of shadows have most of it'
}
