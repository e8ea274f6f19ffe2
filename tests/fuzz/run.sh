#!/bin/bash
# Builds the fuzzers, makes corpora, runs each fuzzer for SECONDS of CPU time (default: 600), and prints a table.
# usage: tests/fuzz/run.sh [SECONDS] [FUZZER...]
#   FUZZ_BUILD   build folder (build/fuzz)      FUZZ_BUILT   not empty: it is built
#   FUZZ_WORK    corpora and findings, kept between runs (BUILD/fuzz)
# Exit code 1 if anything was found; each finding lies in WORK/found and is replayed by giving it to the fuzzer.
set -eu
cd "$(dirname "$0")/../.."
seconds=${1:-600}
[ $# -gt 0 ] && shift
build=${FUZZ_BUILD:-build/fuzz}
work=${FUZZ_WORK:-$build/fuzz}
all="container photons irradiance radiance brdf film journal gltf obj texture exr hdr png environment merl ies ldt csv json toml options message"
fuzzers=${*:-$all}

[ -f "$build/build.ninja" ] || cmake --preset fuzz -B "$build" >/dev/null
[ -n "${FUZZ_BUILT:-}" ] || nice cmake --build "$build" --target fuzzers >&2
mkdir -p "$work/found"
export ASAN_OPTIONS=detect_leaks=0:${ASAN_OPTIONS:-}
export UBSAN_OPTIONS=print_stacktrace=1:${UBSAN_OPTIONS:-}
"$build/tests/fuzz_corpora" "$work/seeds"

# seed FUZZER FILE...: small files of others; many are wrong, which is why they are here.
seed() {
  to=$work/seeds/$1
  shift
  mkdir -p "$to"
  for file; do
    [ -f "$file" ] && cp "$file" "$to/$(echo "$file" | tr / _)"
  done
  return 0
}
damaged() { find data/damaged -type f -name "$1-*" 2>/dev/null; }
small() { find "$@" -size -48k 2>/dev/null || true; }
shared=../shared/scenes
IFS='
'
seed gltf $(small data $shared/conformance -name '*.gl*') $(damaged gltf)
seed obj $(small $shared/conformance -name '*.obj') $(damaged obj)
seed texture $(small $shared/conformance -name '*.png' -o -name '*.jpg') $(damaged texture)
seed png $(small $shared/conformance -name '*.png') $(damaged png)
seed hdr $(small data $shared -name '*.hdr') $(damaged hdr)
seed exr $(small data $shared -name '*.exr') $(damaged exr)
seed ies $(small data $shared/ies -name '*.ies') $(damaged ies)
seed ldt $(small data $shared/ies -name '*.ldt') $(damaged ldt)
seed environment $(small data $shared -name '*.hdr' -o -name '*.exr') $(damaged environment)
seed json $(small data -name '*.json') $(damaged json)
seed toml $(small pipelines $shared -name '*.toml') $(damaged toml)
seed csv $(small data pipelines $shared -name '*.csv') $(damaged csv)
for kind in photons irradiance radiance brdf film; do
  seed $kind $(damaged $kind)
  seed container $(find "$work/seeds/$kind" -type f)
done
unset IFS

# for_cpu SECONDS COMMAND...: asks the command to end (USR1) after so much CPU time; its output goes to $log, and
# $took is set to what it took.
per_second=$(getconf CLK_TCK)
for_cpu() {
  local most=$(($1 * per_second)) ticks=0 now
  shift
  "$@" >"$log" 2>&1 &
  local pid=$!
  while now=$(awk '{print $14 + $15}' /proc/$pid/stat 2>/dev/null) && [ -n "$now" ] && [ "$now" -ge "$ticks" ]; do
    ticks=$now
    kill -0 $pid 2>/dev/null || break
    [ "$ticks" -ge "$most" ] && kill -USR1 $pid
    sleep 1
  done
  wait $pid || true
  took=$(((ticks + per_second - 1) / per_second))
}
limits="-rss_limit_mb=3072 -malloc_limit_mb=2048 -timeout=60 -max_len=65536"
status=0
printf '%-12s %12s %8s %8s %9s %6s\n' fuzzer inputs cpu_s edges features found
for f in $fuzzers; do
  corpus=$work/corpus/$f log=$work/$f.log
  mkdir -p "$corpus"
  before=$(find "$work/found" -name "$f-*" | wc -l)
  spent=0 inputs=0 edges=- features=-
  # A finding ends a round.
  for round in 1 2 3 4 5 6 7 8 9 10; do
    [ $spent -ge "$seconds" ] && break
    for_cpu $((seconds - spent)) nice -n 10 "$build/tests/fuzz_$f" $limits -print_funcs=0 -print_final_stats=1 \
      -artifact_prefix="$work/found/$f-" "$corpus" "$work/seeds/$f"
    spent=$((spent + took))
    inputs=$((inputs + $(sed -n 's/^stat::number_of_executed_units: *//p' "$log" | tail -1 | grep . || echo 0)))
    last=$(grep -aE '^#[0-9]+.*cov: ' "$log" | tail -1)
    edges=$(echo "$last" | sed -E 's/.*cov: ([0-9]+).*/\1/') features=$(echo "$last" | sed -E 's/.*ft: ([0-9]+).*/\1/')
    [ "$took" -eq 0 ] && break
  done
  found=$(($(find "$work/found" -name "$f-*" | wc -l) - before))
  [ $found -gt 0 ] && status=1
  printf '%-12s %12s %8s %8s %9s %6s\n' "$f" "$inputs" "$spent" "$edges" "$features" "$found"
done
exit $status
