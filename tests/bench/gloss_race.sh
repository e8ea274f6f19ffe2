#!/usr/bin/env bash
# Race of radiance records against glossy rays, on one scene and view or on one wall of many lobes:
#   tests/bench/gloss_race.sh SCENE FOLDER [--lobes "phong:22 ggx:0.5 ..."] [--material NAME] [--width W] [--rays N] [--accuracy A]
#                             [--read A] [--traced N] [--samples N] [--photons N] [--threads N] [--runs N]
# A line per lobe and run: records of N rays (4000), their seconds and those of drawing them (what the picture takes beyond one
# without gloss), RMS error of the glossy layer over its mean against two references of N paths a pixel (64; made once, kept in
# FOLDER), their noise taken out; the same of N glossy rays a pixel (256); the seconds that rays need for the error of the records
# (error falls with the root of the rays); the ratio; and what --gloss auto does. Both ways read light from one map of photons.
# Programs from PATH or build/release/bin; --lobes needs python3.
set -euo pipefail
[[ $# -ge 2 && $1 != -* ]] || { sed -n '2,9s/^# //p' "${BASH_SOURCE[0]}" >&2; exit 2; }
source "$(dirname "${BASH_SOURCE[0]}")/racing.sh"
scene=$1 folder=$2
shift 2
lobes=as-is material=back-glossy width=850 rays=4000 accuracy=0.3 read=0.6 traced=256 samples=64 photons=400000 threads=0 runs=1
take_all_options "lobes material width rays accuracy read traced samples photons threads runs" "$@"
need_file "$scene"
mkdir -p "$folder"
common=(--threads "$threads" --quiet)

draw() { phos-splat "$base.glb" "$base.irradiance" "$@" --width "$width" --splat cpu --light-samples 1 --layers glossy "${common[@]}"; }
error_of() { true_error "$1" "$base" --layer glossy; }
row() { printf '%-10s %7s %9s %7s %7s | %6s %7s | %8s %6s  %s\n' "$@"; }

row lobe records records_s draw_s 'error%' "rays_s" 'error%' equal_s ratio auto
for lobe in $lobes; do
  base=$folder/${lobe//:/-}-$width
  if [[ $lobe == as-is ]]; then cp "$scene" "$base.glb"; else python3 "$here/gloss_lobe.py" "$scene" "$material" "$lobe" "$base.glb"; fi
  reference_pair "$base" "$base.glb" --width "$width" --samples "$samples" --threads "$threads"
  phos-photons "$base.glb" --photons "$photons" --reuse "${common[@]}" -o "$base.photons"
  phos-irradiance "$base.glb" "$base.photons" --place view --width "$width" --reuse "${common[@]}" -o "$base.irradiance"
  auto=$(phos-scene "$base.glb" --json | awk -F'[:,]' '/"traced_share"/ { print ($2 < 0.5 ? "records" : "rays"); exit }')
  phos-brdf "$base.glb" --too-sharp cut --reuse "${common[@]}" -o "$base.brdf"
  for ((run = 0; run < runs; ++run)); do
    records_s=$(timed phos-radiance "$base.glb" "$base.photons" "$base.brdf" --place view --width "$width" --rays "$rays" \
      --accuracy "$accuracy" --gloss cached --stats "$base.json" "${common[@]}" -o "$base.radiance")
    none_s=$(timed draw --gloss traced --gloss-samples 0 -o "$base-none.exr")
    cached_s=$(timed draw "$base.radiance" "$base.brdf" --gloss cached --accuracy "$read" -o "$base-cached.exr")
    traced_s=$(timed draw --gloss traced --gloss-samples "$traced" -o "$base-traced.exr")
    error=$(error_of "$base-cached.exr") traced_error=$(error_of "$base-traced.exr")
    draw_s=$(calculate %.2f "$cached_s - $none_s") rays_s=$(calculate %.2f "$traced_s - $none_s")
    # Errors of 0 are below what the references can tell.
    equal_s=- ratio=-
    if [[ $error != 0.00 && $traced_error != 0.00 ]]; then
      equal_s=$(calculate %.2f "$rays_s * ($traced_error / $error) ^ 2")
      ratio=$(calculate %.1f "$equal_s / ($records_s + $draw_s)")
    fi
    row "$lobe" "$(count_of records "$base.json")" "$(calculate %.2f "$records_s")" "$draw_s" "$error" \
      "$rays_s" "$traced_error" "$equal_s" "$ratio" "$auto"
  done
done
