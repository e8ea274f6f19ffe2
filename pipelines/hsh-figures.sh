#!/usr/bin/env bash
# Draws figures that compare hemispherical harmonics (HSH) with other functions (Gautron et al. 2004):
#   pipelines/hsh-figures.sh FOLDER [MODEL [ENVIRONMENT]] [--order N] [--exponent E] [--width W] [--samples N] [--rays N]
#                            [--photons N]
# FOLDER/bases.csv, bases-*.svg   the accuracy of five bases over their number of coefficients, for the lobes Phong cos^5 and Ward 0.2 / 0.5
# FOLDER/discs-*.png              for the same lobes, from all directions of view: energy that the functions leave out, and their order;
#                                 and the functions themselves (Krivanek et al. 2005, figure 2; Gautron et al. 2004, figure 10)
# FOLDER/errors.csv, *.png        MODEL (an .obj, made glossy with Phong exponent E) lit by ENVIRONMENT (an equirectangular map) through HSH and
#                                 spherical harmonics (SH) of order N. The errors are differences from many more bands (the loss by the order) and
#                                 from rays (the loss of shadows too).
# MODEL and ENVIRONMENT are by default the teapot and the map of ../shared/scenes where they exist, else a torus and data/sky.hdr.
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
order=7 width=400 samples=4 photons=200000 exponent=20 rays=128
take_options "order width samples photons exponent rays" "$@"
inputs=(${rest[@]+"${rest[@]}"})
[[ " ${inputs[*]-} " != *' -'* ]] || usage
((${#inputs[@]} >= 1 && ${#inputs[@]} <= 3)) || usage
folder=${inputs[0]} model=${inputs[1]:-} environment=${inputs[2]:-}
shared=$here/../../shared/scenes
[[ -n $model || ! -f $shared/meshes/teapot.obj ]] || model=$shared/meshes/teapot.obj
[[ -n $environment || ! -f $shared/env/mitsuba_envmap.exr ]] || environment=$shared/env/mitsuba_envmap.exr
environment=${environment:-$here/../data/sky.hdr}
for file in $model $environment; do
  need_file "$file"
done
need_programs
mkdir -p "$folder"

# 1. Bases: the share of a lobe's energy that a number of functions holds.
phos-brdf "$here/../data/lobes.gltf" --bases "$folder/bases.csv" --quiet -o "$folder/lobes.brdf"
plot() { # name, material, weight, title
  phos-picture "$folder/bases.csv" --x coefficients --y accuracy --series basis --where "material=$2" --where "weight=$3" \
    --x-max 100 --y-min 0 --y-max 1 --title "$4" --y-label 'share of the energy' -o "$folder/bases-$1.svg"
}
plot phong 'Phong cos^5' none 'cos^5, mean over directions of view'
plot phong-cosine 'Phong cos^5' cosine 'cos^5 times cosine, mean over directions of view'
plot ward 'Ward 0.2 / 0.5' none 'Ward 0.2 / 0.5, mean over directions of view'
plot ward-cosine 'Ward 0.2 / 0.5' cosine 'Ward 0.2 / 0.5 times cosine, mean over directions of view'

for discs in error order harmonics; do
  phos-picture --discs "$discs" "$folder/lobes.brdf" --quiet -o "$folder/discs-$discs.png"
done

# 2. The model with a glossy material, and a camera that sees the whole model.
scene=$folder/model.obj
torus() {
  awk 'BEGIN {
    n = 96; m = 48; pi = atan2(0, -1)
    for (i = 0; i < n; ++i) for (j = 0; j < m; ++j) {
      u = 2 * pi * i / n; v = 2 * pi * j / m; r = 1 + 0.4 * cos(v)
      printf "v %.6f %.6f %.6f\nvn %.6f %.6f %.6f\n", r * cos(u), 0.4 * sin(v), r * sin(u), cos(v) * cos(u), sin(v), cos(v) * sin(u)
    }
    for (i = 0; i < n; ++i) for (j = 0; j < m; ++j) {
      a = i * m + j; b = ((i + 1) % n) * m + j; c = ((i + 1) % n) * m + (j + 1) % m; d = i * m + (j + 1) % m
      printf "f %d//%d %d//%d %d//%d %d//%d\n", a+1, a+1, d+1, d+1, c+1, c+1, b+1, b+1
    }
  }'
}
{
  printf 'mtllib model.mtl\nusemtl glossy\no model\ns 1\n'
  if [[ -n $model ]]; then grep -Ev '^(mtllib|usemtl|o|g|s) ' "$model"; else torus; fi
} >"$scene"
printf 'newmtl glossy\nKd 0.1 0.1 0.1\nKs 0.7 0.7 0.7\nNs %s\nillum 2\n' "$exponent" >"$folder/model.mtl"
awk '$1 == "v" { for (k = 2; k <= 4; ++k) { if (!(k in lo) || $k < lo[k]) lo[k] = $k + 0; if (!(k in hi) || $k > hi[k]) hi[k] = $k + 0 } }
  END {
    size = 0; for (k = 2; k <= 4; ++k) { c[k] = (lo[k] + hi[k]) / 2; size += (hi[k] - lo[k]) ^ 2 }
    size = sqrt(size)
    printf "{\"cameras\": [{\"name\": \"front\", \"eye\": [%g, %g, %g], \"target\": [%g, %g, %g], \"yfov_deg\": 33, \"aspect\": 1.3333}]}\n",
      c[2] + 0.5 * size, c[3] + 0.7 * size, c[4] + 1.4 * size, c[2], c[3], c[4]
  }' "$scene" >"$folder/model.lights.json"

# 3. Pictures. The tables of the material hold nearly all energy of its lobe, so that only the order of the light makes a difference.
light=(--environment "$environment")
quiet=(--quiet --reuse)
phos-photons "$scene" "${light[@]}" --photons "$photons" "${quiet[@]}" -o "$folder/model.photons"
phos-irradiance "$scene" "$folder/model.photons" "${light[@]}" "${quiet[@]}" -o "$folder/model.irradiance"
phos-brdf "$scene" "${light[@]}" --error 0.0001 --max-order 20 "${quiet[@]}" -o "$folder/model.brdf"
draw() { # name, options
  local name=$1
  shift
  phos-splat "$scene" "$folder/model.irradiance" "$folder/model.brdf" "${light[@]}" --width "$width" \
    --pixel-samples "$samples" "$@" --quiet -o "$folder/$name.exr" 2>/dev/null
  phos-picture "$folder/$name.exr" --quiet -o "$folder/$name.png"
}
draw hsh --environment-mode hsh --environment-order "$order" --light-samples "$rays" --gloss-samples "$rays"
draw sh --environment-mode sh --environment-order "$order" --light-samples "$rays" --gloss-samples "$rays"
draw open --environment-mode hsh --environment-order 20 --light-samples "$rays" --gloss-samples "$rays"
draw traced --light-samples "$rays" --gloss-samples "$rays"

# 4. The errors in the layer of direct light, which holds all light that comes straight from the environment.
printf 'picture,against,coefficients,relative_rmse,pu21_psnr_db\n' >"$folder/errors.csv"
for name in hsh sh; do
  for against in open traced; do
    phos-compare "$folder/$name.exr" "$folder/$against.exr" --layer direct --ignore-emission --json --difference "$folder/$name-$against.png" |
      awk -v start="$name,$against,$((order * order))" '
        match($0, /"relative_rmse": *[-0-9.e+]+/) { r = substr($0, RSTART, RLENGTH); sub(/.*: */, "", r) }
        match($0, /"pu21_psnr_db": *[-0-9.e+]+/) { p = substr($0, RSTART, RLENGTH); sub(/.*: */, "", p) }
        END { print start "," r "," p }' >>"$folder/errors.csv"
  done
done
cat "$folder/errors.csv"
echo "figures: $folder/bases-*.svg, $folder/*.png" >&2
