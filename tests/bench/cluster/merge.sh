#!/usr/bin/env bash
# Seconds and memory of phos-merge, in memory and on disk, over the shards of one run; the bytes are compared.
#   tests/bench/cluster/merge.sh [FOLDER-OF-PROGRAMS] [--paths N] [--shards N] [--memory "SIZE..."] [--folder FOLDER]
# --paths 1000000, --shards 8, --memory "512M 2G". --folder (a temporary one): shards that are there are kept. 116000000 paths of this scene store
# 200 million photons; shards, maps and temporary files then take about 45 GB of disk, and the merge in memory about 22 GB. --in-memory no leaves it out.
set -euo pipefail
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
source "$project/pipelines/common.sh"
PATH=${1:-$project/build/release/bin}:$PATH
paths=1000000 shards=8 memory='512M 2G' folder='' in_memory=yes
(($# == 0)) || take_all_options "paths shards memory folder in_memory" "${@:2}"
if [[ -z $folder ]]; then
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT
fi
mkdir -p "$folder"
cd "$folder"
files=()
for ((i = 1; i <= shards; ++i)); do
  files+=("$paths-$i-$shards.photons")
  [[ -f ${files[-1]} ]] || phos-photons "$project/data/cornell-measured.glb" --photons "$paths" --caustic-photons 0 --shard "$i/$shards" --quiet -o "${files[-1]}"
done
row() { # NAME STATS
  jq -r --arg name "$1" '[$name, .stored, (.on_disk | tostring), ."seconds.total", (."seconds.sort" // 0), ."seconds.kdtree", ."seconds.write", (.peak_memory_bytes / 1048576 | floor)] | @csv' "$2"
}
echo "memory,photons,on_disk,seconds,sort_s,kdtree_s,write_s,peak_MiB"
first=''
for size in $memory; do
  phos-merge "${files[@]}" --memory "$size" --quiet --stats stats.json -o "on-disk.photons"
  row "$size" stats.json
  if [[ -z $first ]]; then
    first=first.photons
    mv on-disk.photons "$first"
  else
    cmp on-disk.photons "$first"
    rm on-disk.photons
  fi
done
if [[ $in_memory == yes ]]; then
  phos-merge "${files[@]}" --quiet --stats stats.json -o in-memory.photons
  row unlimited stats.json
  [[ -z $first ]] || cmp in-memory.photons "$first"
  rm in-memory.photons
fi
rm -f "$first"
