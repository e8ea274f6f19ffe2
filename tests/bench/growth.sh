#!/usr/bin/env bash
# Time and peak memory of each stage as photons, records and triangles grow, and the exponents of that growth:
#   tests/bench/growth.sh FOLDER [--photons MOST] [--records MOST] [--triangles MOST] [--threads N]
# From 1e4 photons, 1e2 records and 1e3 triangles in steps of ten to MOST (1e7, 1e6, 1e7; 0: not at all). Prints one line per run and,
# from each to the next, the exponent of time and of memory (1: in proportion), which start-up keeps low where little is done.
# Needs perl. Programs from PATH or build/release/bin.
set -euo pipefail
[[ $# -ge 1 ]] || { sed -n '2,6s/^# //p' "${BASH_SOURCE[0]}" >&2; exit 2; }
folder=$1
shift
photons=10000000 records=1000000 triangles=10000000 threads=0
while (($# > 0)); do
  case $1 in
    --photons) photons=$2 ;; --records) records=$2 ;; --triangles) triangles=$2 ;; --threads) threads=$2 ;;
    *) exit 2 ;;
  esac
  shift 2
done
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
PATH=$PATH:$root/build/release/bin
mkdir -p "$folder"
room=$root/data/cornell-empty.glb
stats=$folder/stats.json
printf '%-10s %10s %-12s %10s %10s %8s %8s\n' axis n stage seconds peak_MB time^ memory^

declare -A seconds_of memory_of n_of
stage() { # axis, n, name, command...
  local axis=$1 n=$2 name=$3
  shift 3
  "$@" --threads "$threads" --quiet --stats "$stats" 2>>"$folder/log.txt"
  local seconds memory
  seconds=$(sed -n 's/^ *"seconds.total": \([^,]*\),*$/\1/p' "$stats")
  memory=$(sed -n 's/^ *"peak_memory_bytes": \([^,]*\),*$/\1/p' "$stats")
  local key=$axis-$name
  awk -v a="$axis" -v n="$n" -v s="$name" -v t="$seconds" -v m="$memory" -v n0="${n_of[$key]:-0}" -v t0="${seconds_of[$key]:-0}" \
    -v m0="${memory_of[$key]:-0}" 'BEGIN {
      grown = n0 > 0 ? sprintf("%8.2f %8.2f", log(t / t0) / log(n / n0), log(m / m0) / log(n / n0)) : ""
      printf "%-10s %10d %-12s %10.3f %10.1f %s\n", a, n, s, t, m / 1e6, grown }'
  n_of[$key]=$n seconds_of[$key]=$seconds memory_of[$key]=$memory
}
steps() { # first, most
  local n=$1
  for (( ; n <= $2; n *= 10)); do echo "$n"; done
  ((n / 10 >= $2)) || ((n / 10 == $2)) || [[ $1 -gt $2 ]] || echo "$2"
}

# About 1.6 photons land of each path.
for n in $(steps 10000 "$photons"); do
  map=$folder/n.photons
  stage photons "$n" photons phos-photons "$room" --photons "$((n * 64 / 100))" -o "$map"
  stage photons "$n" hull phos-irradiance "$room" "$map" --estimate hull --max-candidates 2000 -o "$folder/n.irradiance"
  stage photons "$n" gather phos-irradiance "$room" "$map" --estimate gather --rays 64 --max-candidates 2000 -o "$folder/n.irradiance"
done

# Records at points of the floor, each of its own; their reach shrinks with the way between them.
phos-photons "$room" --photons 10000 --quiet -o "$folder/few.photons"
for n in $(steps 100 "$records"); do
  perl -e 'srand 1; print "x,y,z,nx,ny,nz\n"; printf "%.7f,0,%.7f,0,1,0\n", 0.5 * rand() - 0.25, 0.5 * rand() - 0.25 for 1 .. $ARGV[0]' "$n" \
    >"$folder/n.csv"
  reach=$(awk -v n="$n" 'BEGIN { print 2.5 / sqrt(n) }')
  stage records "$n" records phos-irradiance "$room" "$folder/few.photons" --estimate hull --place every --at "$folder/n.csv" \
    --max-radius "$reach" --min-radius "$(awk -v r="$reach" 'BEGIN { print r / 10 }')" -o "$folder/n.irradiance"
  stage records "$n" picture phos-splat "$room" "$folder/n.irradiance" --width 200 --splat cpu --direct none --gloss-samples 0 \
    -o "$folder/n.exr"
done

# A hilly square of so many triangles under a small lamp.
for n in $(steps 1000 "$triangles"); do
  perl -e '
    use strict;
    my ($n, $out) = @ARGV;
    my $side = int(sqrt($n / 2));
    my ($v, $t) = (($side + 1) ** 2, 2 * $side * $side);
    my ($positions, $indices) = ("", "");
    for my $y (0 .. $side) { for my $x (0 .. $side) {
      my ($u, $w) = ($x / $side, $y / $side);
      $positions .= pack "f<3", $u - 0.5, 0.05 * sin(40 * $u) * sin(30 * $w), $w - 0.5 } }
    for my $y (0 .. $side - 1) { for my $x (0 .. $side - 1) {
      my $i = $y * ($side + 1) + $x;
      my $j = $i + $side + 1;
      $indices .= pack "L<6", $i, $j, $i + 1, $i + 1, $j, $j + 1 } }
    my $lamp = pack "f<12", -0.05, 0.5, -0.05, 0.05, 0.5, -0.05, 0.05, 0.5, 0.05, -0.05, 0.5, 0.05;
    my $both = pack "L<6", 0, 1, 2, 0, 2, 3;
    my $bin = $positions . $lamp . $indices . $both;
    my $at = 0;
    my @views;
    for ($positions, $lamp, $indices, $both) { push @views, sprintf "{\"buffer\":0,\"byteOffset\":%d,\"byteLength\":%d}", $at, length; $at += length }
    my $range = sub { "\"min\":[-$_[0],$_[1],-$_[0]],\"max\":[$_[0],$_[2],$_[0]]" };
    my $json = "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"KHR_materials_emissive_strength\"],\"buffers\":[{\"byteLength\":$at}],"
      . "\"bufferViews\":[" . join(",", @views) . "],\"accessors\":["
      . "{\"bufferView\":0,\"componentType\":5126,\"count\":$v,\"type\":\"VEC3\"," . $range->(0.5, -0.05, 0.05) . "},"
      . "{\"bufferView\":1,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"," . $range->(0.05, 0.5, 0.5) . "},"
      . "{\"bufferView\":2,\"componentType\":5125,\"count\":" . 3 * $t . ",\"type\":\"SCALAR\"},"
      . "{\"bufferView\":3,\"componentType\":5125,\"count\":6,\"type\":\"SCALAR\"}],"
      . "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,0.5,0.5,1],\"metallicFactor\":0}},"
      . "{\"emissiveFactor\":[1,1,1],\"extensions\":{\"KHR_materials_emissive_strength\":{\"emissiveStrength\":10000}}}],"
      . "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":2,\"material\":0}]},"
      . "{\"primitives\":[{\"attributes\":{\"POSITION\":1},\"indices\":3,\"material\":1}]}],"
      . "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.8,\"aspectRatio\":1,\"znear\":0.01}}],"
      . "\"nodes\":[{\"mesh\":0},{\"mesh\":1},{\"camera\":0,\"translation\":[0,0.4,1.2],\"rotation\":[-0.15,0,0,0.98869]}],"
      . "\"scenes\":[{\"nodes\":[0,1,2]}],\"scene\":0}";
    $json .= " " x (-length($json) % 4);
    open my $f, ">:raw", $out or die "$out: $!";
    print $f pack("A4L<2", "glTF", 2, 28 + length($json) + length($bin)), pack("L<A4", length($json), "JSON"), $json, pack("L<A4", length($bin), "BIN\0"), $bin;
  ' "$n" "$folder/n.glb"
  scene=$folder/n.glb
  stage triangles "$n" photons phos-photons "$scene" --photons 100000 -o "$folder/n.photons"
  stage triangles "$n" records phos-irradiance "$scene" "$folder/n.photons" --estimate hull --max-candidates 2000 -o "$folder/n.irradiance"
  stage triangles "$n" picture phos-splat "$scene" "$folder/n.irradiance" --width 200 --splat cpu --gloss-samples 0 -o "$folder/n.exr"
done
