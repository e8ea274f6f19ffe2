# For reproduce.sh and the races of tests/bench to source: seconds, and errors of pictures against a pair of references.

calculate() { awk "BEGIN { printf \"$1\", $2 }"; } # calculate %.2f "1 / 3"

# Prints the seconds of a command; its messages are shown if it fails.
timed() {
  local start log
  log=$(mktemp)
  start=$(date +%s.%N)
  "$@" 2>"$log" || { cat "$log" >&2 && rm "$log" && exit 1; }
  calculate %.3f "$(date +%s.%N) - $start"
  rm "$log"
}

# A pair of references, STEM-1.exr and STEM-2.exr: reference_pair STEM OPTION...
reference_pair() {
  local stem=$1 seed
  shift
  for seed in 1 2; do phos-reference "$@" --seed $seed --reuse --quiet -o "$stem-$seed.exr"; done
}
# RMS error over the mean, %, the noise of the references taken out: true_error PICTURE STEM OPTION...
true_error() {
  phos-compare "$1" "$2-1.exr" --second-reference "$2-2.exr" "${@:3}" --json |
    awk -F'[:,]' '/"relative_converged_rmse"/ { printf "%.2f", 100 * $2; exit }'
}
count_of() { sed -n "s/^  \"$1\": *\([0-9]*\),*\$/\1/p" "$2"; } # a count of a file that --stats wrote: count_of NAME FILE

# ratio A B: A / B, or "-" where one of them is 0 or missing.
ratio() { awk -v a="$1" -v b="$2" 'BEGIN { if (a + 0 > 0 && b + 0 > 0) printf "%.2f", a / b; else printf "-" }'; }
# equal_seconds SECONDS ERROR WANTED: the seconds for the error WANTED, as errors fall with the root of the time.
equal_seconds() { awk -v s="$1" -v e="$2" -v w="$3" 'BEGIN { if (e + 0 > 0 && w + 0 > 0) printf "%.2f", s * (e / w) ^ 2; else printf "-" }'; }
