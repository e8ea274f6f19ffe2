# For tables of films to source: both ways of making one, and how much it flickers.

# film_pair STEM SCENE FRAMES WIDTH SAMPLES: two converged films, STEM-1 and STEM-2.
film_pair() {
  local n
  for n in 1 2; do
    mkdir -p "$1-$n"
    phos-reference "$2" --frames "$3" --width "$4" --samples "$5" --seed "$n" --threads "$threads" --reuse --quiet -o "$1-$n/%04d.exr"
  done
}
# film_error FOLDER STEM FRAMES [OPTION...]: "ERROR FLICKER" of the indirect layer, % of its mean, the noise of the references taken out.
film_error() {
  phos-compare "$1/%04d.exr" "$2-1/%04d.exr" --second-reference "$2-2/%04d.exr" --frames "$3" --flicker --layer indirect --json "${@:4}" |
    jq -r '.layers[0] | "\(.relative_converged_rmse * 10000 | round / 100) \(.relative_converged_flicker * 10000 | round / 100)"'
}
# draw_film FOLDER SCENE CACHE FRAMES WIDTH [OPTION...]: indirect light of each frame.
draw_film() {
  mkdir -p "$1"
  phos-splat "$2" "${@:6}" "$3" --frames "$4" --width "$5" --splat cpu --direct none --gloss-samples 0 --pixel-samples 1 --layers indirect "${common[@]}" -o "$1/%04d.exr"
}
