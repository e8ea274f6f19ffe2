#!/usr/bin/env bash
# Time to splat 4,000 records at 1000 x 1000 by OSMesa and by EGL (--gl), their bounding rectangles covering 0.5 % or 2 % of the
# picture on average:
#   tests/bench/egl_time.sh [BUILD] [--repetitions N]
# A line for each: milliseconds a frame (median of N; 5); those of a frame with a single record, which is the way of the G-buffer to
# the driver and of the sums back; their difference, which is the drawing with the preparation of the records by the processor; and
# the driver. BUILD (build/release) is a build folder with -DPHOS_BENCH=ON. Ends with 3 where EGL gives no OpenGL. Needs jq.
set -euo pipefail
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
usage() { sed -n '2,7s/^# //p' "${BASH_SOURCE[0]}" >&2; exit 2; }
build=$project/build/release repetitions=5
while (($# > 0)); do
  case $1 in
    --repetitions) [[ ${2:-} =~ ^[1-9][0-9]*$ ]] || usage; repetitions=$2; shift 2 ;;
    -*) usage ;;
    *) build=$1; shift ;;
  esac
done
bench=$build/tests/splat_bench
[[ -x $bench ]] || { echo "egl_time.sh: $bench: is not there; cmake -B $build -DPHOS_BENCH=ON, and build splat_bench" >&2; exit 3; }

"$bench" --benchmark_filter='^splat_gl' --benchmark_format=json --benchmark_repetitions="$repetitions" 2>/dev/null | jq -r '
  def median: sort | .[length / 2 | floor];
  # names: splat_gl/BY_COUNT/COVERAGE/real_time
  [.benchmarks[] | select(.run_type == "iteration") | . + (.run_name | split("/") |
    {by: (.[1] | split("_")[0]), count: (.[1] | split("_")[1]), coverage: (.[2] | tonumber / 10)})] |
  (.[] | select(.error_occurred) | "error \(.by): \(.error_message)"),
  (map(select(.error_occurred | not)) | group_by([.by, .coverage])[] |
    (group_by(.count) | map({(.[0].count): (map(.real_time) | median)}) | add) as $ms |
    "\(.[0].by) \(.[0].coverage) \($ms["4000"]) \($ms["1"]) \(.[0].label)")' | sort -u | {
  failed=0
  printf '%-7s %10s %10s %12s %10s  %s\n' gl 'coverage %' 'ms a frame' 'of transfer' 'of drawing' driver
  while read -r by coverage frame transfer label; do
    if [[ $by == error ]]; then
      echo "egl_time.sh: $coverage $frame $transfer $label" >&2
      failed=3
      continue
    fi
    awk -v by="$by" -v c="$coverage" -v f="$frame" -v t="$transfer" -v l="$label" \
      'BEGIN { printf "%-7s %10.1f %10.2f %12.2f %10.2f  %s\n", by, c, f, t, f - t, l }'
  done
  exit $failed
}
