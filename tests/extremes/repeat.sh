#!/usr/bin/env bash
# The same bytes, always: every stage with 1, 2, 3, 7 and 16 threads, then the small pipeline again and again, with
# another number of threads each time: tests/extremes/repeat.sh [TIMES]   (1000)
# Prints what differs and how long it took; exit 1 if anything did. BUILD names another build folder than build/release.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
times=${1:-1000}
bin=$PWD/${BUILD:-build/release}/bin
[[ ${BUILD:-} != /* ]] || bin=$BUILD/bin
data=$PWD/data
export MESA_SHADER_CACHE_DISABLE=true
folder=$(mktemp -d)
trap 'code=$?; ((code == 0)) || tail -n 3 "$folder/messages" >&3; rm -rf "$folder"' EXIT
cd "$folder"
exec 3>&2 2>messages # what the tools say is shown where one fails
printf 'x,y,z,nx,ny,nz\n0.3,0.001,0.1,0,1,0\n0.4,0.001,0.2,0,1,0\n' >points.csv

small() { # FOLDER THREADS: the small pipeline
  local o=$1 t=(--threads "$2" --quiet) room=$data/cornell-glossy22.glb
  mkdir -p "$o"
  "$bin/phos-photons" "$room" --photons 2000 "${t[@]}" -o "$o/a.photons"
  "$bin/phos-brdf" "$room" --resolution 4 --max-order 6 "${t[@]}" -o "$o/a.brdf"
  "$bin/phos-irradiance" "$room" "$o/a.photons" --accuracy 0.8 "${t[@]}" -o "$o/a.irradiance"
  "$bin/phos-splat" "$room" "$o/a.irradiance" --width 16 --height 16 --pixel-samples 1 --splat cpu "${t[@]}" -o "$o/a.exr"
  "$bin/phos-sense" "$room" "$o/a.irradiance" --points points.csv "${t[@]}" -o "$o/a.csv"
  "$bin/phos-picture" "$o/a.exr" "${t[@]}" -o "$o/a.png"
}
all() { # FOLDER THREADS: every stage
  local o=$1 t=(--threads "$2" --quiet) room=$data/cornell-glossy22.glb
  mkdir -p "$o"
  "$bin/phos-photons" "$room" --photons 30000 "${t[@]}" -o "$o/b.photons"
  "$bin/phos-photons" "$room" --photons 30000 --shard 1/2 "${t[@]}" -o "$o/b1.photons"
  "$bin/phos-photons" "$room" --photons 30000 --shard 2/2 "${t[@]}" -o "$o/b2.photons"
  "$bin/phos-merge" "$o/b1.photons" "$o/b2.photons" "${t[@]}" -o "$o/merged.photons"
  cmp "$o/b.photons" "$o/merged.photons"
  "$bin/phos-brdf" "$room" --resolution 8 "${t[@]}" -o "$o/b.brdf"
  "$bin/phos-irradiance" "$room" "$o/b.photons" --accuracy 0.5 "${t[@]}" -o "$o/b.irradiance"
  "$bin/phos-irradiance" "$room" "$o/b.irradiance" --estimate gather --rays 64 --accuracy 0.9 "${t[@]}" -o "$o/g.irradiance"
  "$bin/phos-radiance" "$room" "$o/b.photons" "$o/b.brdf" --accuracy 0.9 "${t[@]}" -o "$o/b.radiance"
  "$bin/phos-splat" "$room" "$o/b.irradiance" "$o/b.radiance" "$o/b.brdf" --width 48 "${t[@]}" -o "$o/b.exr"
  "$bin/phos-splat" "$room" "$o/b.irradiance" --width 48 --splat cpu "${t[@]}" -o "$o/c.exr"
  "$bin/phos-sense" "$room" "$o/b.irradiance" --points points.csv "${t[@]}" -o "$o/b.csv"
  "$bin/phos-reference" "$room" --width 32 --samples 16 "${t[@]}" -o "$o/r.exr"
  "$bin/phos-temporal" "$data/moving-light.glb" --frames 0:3 --rays 32 --photons 5000 --width 24 --accuracy 0.5 \
    "${t[@]}" -o "$o/film.irradiance"
  "$bin/phos-picture" "$o/b.exr" "${t[@]}" -o "$o/b.png"
  "$bin/phos-compare" "$o/b.exr" "$o/c.exr" --difference "$o/d.png" "${t[@]}" >"$o/d.txt"
}

bad=0
same() { # A B WHAT
  diff -rq "$1" "$2" && return
  echo "differs: $3"
  bad=1
}
all t1 1
for n in 2 3 7 16; do
  all "t$n" "$n"
  same t1 "t$n" "$n threads against 1"
  rm -rf "t$n"
done
echo "every stage: 1, 2, 3, 7 and 16 threads compared"
start=$SECONDS
small first 1
threads=(1 2 3 7 16)
for ((i = 0; i < times; ++i)); do
  n=${threads[i % 5]}
  small again "$n"
  same first again "repetition $i with $n threads"
  rm -rf again
done
echo "small pipeline: $times repetitions in $((SECONDS - start)) s, $( ((bad)) && echo 'NOT all' || echo all) byte-equal"
exit $bad
