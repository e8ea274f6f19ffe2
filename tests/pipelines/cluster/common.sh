#!/usr/bin/env bash
# What the tests of pipelines/cluster share: programs, checks, a configuration with a film, a sensor grid and a picture, and the same by single runs.
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
PATH=${1:-$project/build/release/bin}:$PATH
export MESA_SHADER_CACHE_DISABLE=true
failed=0
wrong() { echo "FAILED: $*" >&2; failed=1; }
# same FILE FILE: are the bytes the same?
same() { cmp "$1" "$2" || wrong "$1 and $2 differ"; }
# refused CODE WORDS COMMAND...: ends with this code, and its last line holds the words.
refused() {
  local code=$1 words=$2 got=0
  shift 2
  "$@" >"$scratch/said" 2>&1 || got=$?
  if ((got != code)) || ! grep -qF -- "$words" "$scratch/said"; then
    wrong "$*: code $got, not $code, or no \"$words\" in:"
    tail -5 "$scratch/said" >&2
  else
    echo "refused ($code): $(grep -F -- "$words" "$scratch/said" | tail -1)"
  fi
}
# once FOLDER: did each job that ended well do so once?
once() {
  local twice
  twice=$(awk -F, 'NR > 1 && $8 == 0 { if (n[$1]++) print $1 }' "$1/log/jobs.csv")
  [[ -z $twice ]] || wrong "$1: done twice: $twice"
  echo "$1: $(awk -F, 'NR > 1 && $8 == 0' "$1/log/jobs.csv" | wc -l) jobs done, $(awk -F, 'NR > 1 { print $2 }' "$1/log/jobs.csv" | sort | uniq -c | xargs)"
}
cluster() { "$project/pipelines/cluster.sh" "$@"; }

# make_configuration FILE PHOTONS: three kinds of results, small.
make_configuration() {
  cat >"$1" <<END
scenes: {box: $project/data/cornell-empty.glb}
cameras: {front: --camera measured --width 48}
settings:
  toy: {photons: --photons $2 --caustic-photons 0, shards: 4, irradiance: --place view --accuracy 0.4, splat: --pixel-samples 1 --light-samples 4}
pictures: true
grids:
  desk: {points: $project/points.csv, irradiance: --estimate gather --gather-bounces 1 --rays 16, parts: 4, sense: --light-samples 1}
END
  sed -i "s|$project/points.csv|$(dirname "$(realpath "$1")")/points.csv|" "$1"
}
make_film_configuration() {
  cat >"$1" <<END
scenes: {cube: $project/data/cube-in-a-box.glb}
cameras: {front: --width 32}
films:
  film: {frames: "0:5", temporal: --photons 3000 --rays 32, splat: --pixel-samples 1 --light-samples 4, frames_per_job: 2}
END
}
# make_truth FOLDER PHOTONS: the same results, each program run once as a user would.
make_truth() {
  local box=$project/data/cornell-empty.glb cube=$project/data/cube-in-a-box.glb
  mkdir -p "$1/film"
  phos-photons "$box" --photons "$2" --caustic-photons 0 --quiet -o "$1/box.photons"
  phos-irradiance "$box" "$1/box.photons" --place view --accuracy 0.4 --camera measured --width 48 --quiet -o "$1/box.irradiance"
  phos-splat "$box" "$1/box.irradiance" --camera measured --width 48 --pixel-samples 1 --light-samples 4 --quiet -o "$1/front.exr"
  phos-irradiance "$box" "$1/box.photons" --place every --at "$scratch/points.csv" --estimate gather --gather-bounces 1 --rays 16 --quiet -o "$1/desk.irradiance"
  phos-sense "$box" "$1/desk.irradiance" --points "$scratch/points.csv" --light-samples 1 --quiet -o "$1/desk.csv"
  phos-temporal "$cube" --frames 0:5 --width 32 --photons 3000 --rays 32 --quiet -o "$1/film.irradiance"
  phos-splat "$cube" "$1/film.irradiance" --frames 0:5 --width 32 --pixel-samples 1 --light-samples 4 --quiet -o "$1/film/%04d.exr"
}
check_results() { # FOLDER TRUTH
  same "$1/results/box/plain/toy/front.exr" "$2/front.exr"
  same "$1/results/box/plain/toy/desk.csv" "$2/desk.csv"
}
# Sensors of a grid N x N, 0.3 m above the floor of the Cornell box.
make_points() {
  awk -v n="$1" 'BEGIN { print "x,y,z,nx,ny,nz"; for (i = 0; i < n; ++i) for (j = 0; j < n; ++j) printf "%.6f,0.3,%.6f,0,1,0\n", 0.02 + 0.51 * i / n, 0.02 + 0.51 * j / n }'
}
