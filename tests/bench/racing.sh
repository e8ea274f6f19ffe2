# For the races to source: programs on PATH, and what each of them does.
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/../../pipelines/common.sh"
need_programs

calculate() { awk "BEGIN { printf \"$1\", $2 }"; } # calculate %.2f "1 / 3"

# Prints the seconds of a command; what it says is shown if it fails.
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
