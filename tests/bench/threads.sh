#!/usr/bin/env bash
# How each stage gains from threads:
#   tests/bench/threads.sh FOLDER SCENE [--photons N] [--width W] [--threads N] [--runs N]
# Runs each stage on one thread and on N (default: all cores) by turns, and prints the least seconds of either, their ratio, and from that ratio the
# share of the stage's time that one thread alone works (Amdahl 1967) and the ratio that this share allows on 16 threads. The last line is the sum of
# the stages. Checks that both write the same bytes. Programs from PATH or build/release/bin.
set -euo pipefail
[[ $# -ge 2 ]] || { sed -n '2,6s/^# //p' "${BASH_SOURCE[0]}" >&2; exit 2; }
folder=$1 scene=$2
shift 2
photons=1000000 width=500 threads=$(nproc) runs=3
while (($# > 0)); do
  case $1 in
    --photons) photons=$2 ;; --width) width=$2 ;; --threads) threads=$2 ;; --runs) runs=$2 ;;
    *) exit 2 ;;
  esac
  shift 2
done
((threads > 1)) || { echo "threads.sh: --threads: give 2 or more" >&2; exit 2; }
PATH=$PATH:$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)/build/release/bin
mkdir -p "$folder"
printf '%-28s %9s %9s %6s %7s %6s\n' stage "1 thread" "$threads" ratio serial "on 16"
all_one=0 all_many=0
row() { # name, seconds on one thread, seconds on many
  awk -v name="$1" -v one="$2" -v many="$3" -v n="$threads" 'BEGIN {
    serial = (n * many / one - 1) / (n - 1)
    serial = serial < 0 ? 0 : serial > 1 ? 1 : serial
    printf "%-28s %9.2f %9.2f %6.2f %6.1f%% %6.1f\n", name, one, many, one / many, 100 * serial, 1 / (serial + (1 - serial) / 16) }'
}
stage() { # name, file that is written, command...
  local name=$1 file=$2 one=1e9 many=1e9 n seconds
  shift 2
  for ((run = 0; run < runs; ++run)); do
    for n in 1 "$threads"; do
      "$@" --threads "$n" --quiet --stats "$folder/stats.json" -o "$file" 2>>"$folder/log.txt"
      seconds=$(jq '."seconds.total"' "$folder/stats.json")
      if ((n == 1)); then
        one=$(awk -v a="$one" -v b="$seconds" 'BEGIN { print a < b ? a : b }')
        cp "$file" "$folder/one"
      else
        many=$(awk -v a="$many" -v b="$seconds" 'BEGIN { print a < b ? a : b }')
        cmp "$file" "$folder/one"
      fi
    done
  done
  row "$name" "$one" "$many"
  all_one=$(awk -v a="$all_one" -v b="$one" 'BEGIN { print a + b }') all_many=$(awk -v a="$all_many" -v b="$many" 'BEGIN { print a + b }')
}
p=$folder/t.photons hull=$folder/hull.irradiance gather=$folder/gather.irradiance
stage photons "$p" phos-photons "$scene" --photons "$photons"
stage "records, hull" "$hull" phos-irradiance "$scene" "$p" --place view --width "$width"
stage "records, gather" "$gather" phos-irradiance "$scene" "$p" --place view --width "$width" --estimate gather
stage "picture, records alone" "$folder/t.exr" phos-splat "$scene" "$gather" --width "$width" --splat cpu --layers indirect
stage "picture" "$folder/t.exr" phos-splat "$scene" "$gather" --width "$width" --splat cpu
row all "$all_one" "$all_many"
