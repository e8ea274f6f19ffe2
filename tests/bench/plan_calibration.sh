#!/usr/bin/env bash
# The constants of plans that programs can measure, anew, beside those of lib/plan/calibration.h (its part 1):
#   tests/bench/plan_calibration.sh FOLDER [--quick] [--only "NAME..."] [--threads N]
# A line for each constant, as the header has it: the mean over scenes, then the header's value and each scene's. A constant that the runs
# do not tell keeps the header's value, and its line says so. FOLDER/calibration.h is the header with the new values; FOLDER keeps
# references, measurements.csv, and points.txt, from which powers are told. --quick: toy sizes, to try the script; its values are rough.
# --only: measurements by name: noise_read, adaptive_read, zone_blur, full_zones, shadows, gloss, sensors, places, times, plans. Threads:
# 1, as times of loaded machines differ least so. Scenes are named below; those of ../shared/scenes are left out where they are not there. Hours, and with
# --quick under a minute of one core. Programs from PATH or build/release/bin.
set -euo pipefail
[[ $# -ge 1 && $1 != -* ]] || { sed -n '2,10s/^# //p' "${BASH_SOURCE[0]}" >&2; exit 2; }
source "$(dirname "${BASH_SOURCE[0]}")/racing.sh"
root=$(cd "$here/../.." && pwd) header=$here/../../lib/plan/calibration.h
folder=$1 size=full words=()
shift
for word in "$@"; do if [[ $word == --quick ]]; then size=quick; else words+=("$word"); fi; done
only="noise_read adaptive_read zone_blur full_zones shadows gloss sensors places times plans" threads=1
take_all_options "only threads" "${words[@]}"
need_file "$header"
mkdir -p "$folder"

# Rooms, scenes with half shadows of area lights (an empty box has none), scenes with curved gloss, and rooms whose grid of sensors has that spacing and height in metres.
if [[ $size == full ]]; then
  rooms=(data/cornell-measured.glb data/cornell-empty.glb data/cube-in-a-box.glb data/cornell-glossy22.glb ../shared/scenes/sponza.glb ../shared/scenes/sibenik.glb)
  shaded=(data/cornell-measured.glb ../shared/scenes/sponza.glb ../shared/scenes/sibenik.glb)
  curved=(data/spheres.glb ../shared/scenes/staircase2.glb)
  gridded=(data/cornell-empty.glb:0.06:0.01 data/cube-in-a-box.glb:0.06:0.01)
  width=300 small=92 rays=252 few=64 photons=(40000 160000 640000 2560000) full_photons=(1600000 6400000) reference=256 repeats=10
  errors="20% 10% 5%" plan_words=()
else
  rooms=(data/cornell-measured.glb) shaded=(data/cornell-measured.glb) curved=(data/spheres.glb) gridded=(data/cornell-empty.glb:0.06:0.01)
  width=64 small=48 rays=252 few=52 photons=(1000 8000 64000) full_photons=(200000 800000) reference=256 repeats=3
  errors="20%" plan_words=(--pilot-seconds 1 --reference-seconds 2)
fi
common=(--threads "$threads" --quiet --progress never)
results=$folder/measurements.csv
points=$folder/points.txt
echo constant,scene,value >"$results"
echo "constant scene x y" >"$points"

constant() { sed -n "s/^inline constexpr double $1 = \(.*\);.*/\1/p" "$header"; }
# found CONSTANT SCENE VALUE ["x y"...]: a value of "-" is none; it was told from those points.
found() {
  local name=${2##*/}
  echo "$1,${name/.glb/},$3" >>"$results"
  (($# == 3)) || printf "$1 ${name/.glb/} %s\n" "${@:4}" >>"$points"
}
stat_of() { jq -r --arg name "$1" '.[$name]' "$2"; }

# Half the mean square difference of a layer of two pictures, over its mean's square: noise2 A B LAYER.
noise2() { phos-compare "$1" "$2" --layer "$3" --ignore-emission --json | jq '.layers[0].relative_rmse as $r | $r * $r / 2'; }
# The same without the noise of the two references STEM-1.exr and STEM-2.exr, of a picture: total2 PICTURE STEM LAYER.
total2() {
  phos-compare "$1" "$2-1.exr" --second-reference "$2-2.exr" --layer "$3" --ignore-emission --json |
    jq '.layers[0].relative_converged_rmse as $r | $r * $r'
}
# Power p of y ~ x^p by least squares of logarithms: power "x y" ...; "-" where a value is not above 0.
power() {
  printf '%s\n' "$@" | awk '!($1 > 0 && $2 > 0) { bad = 1 } { x = log($1 > 0 ? $1 : 1); y = log($2 > 0 ? $2 : 1); n++; sx += x; sy += y; sxx += x * x; sxy += x * y }
    END { d = n * sxx - sx * sx; if (bad || d <= 0) print "-"; else printf "%.3f\n", (n * sxy - sx * sy) / d }'
}
# Power p of y ~ c + d x^p, neither c nor d below 0, by least squares of relative deviations; "-" where p is at an end of what is tried.
falling_power() {
  printf '%s\n' "$@" | awk '{ x[NR] = $1; y[NR] = $2; if (!($2 > 0)) bad = 1 }
    END {
      least = 1e300
      for (p = -1.5; p <= -0.1 + 1e-9; p += 0.01) {
        a = b = e = f = g = 0
        for (i = 1; i <= NR && !bad; i++) { u = 1 / y[i]; v = x[i] ^ p / y[i]; a += u * u; b += u * v; e += v * v; f += u; g += v }
        det = a * e - b * b
        if (det <= 0) continue
        c = (f * e - g * b) / det; d = (a * g - b * f) / det
        if (d < 0) continue
        if (c < 0) { c = 0; d = g / e }
        s = 0
        for (i = 1; i <= NR; i++) { r = (c + d * x[i] ^ p) / y[i] - 1; s += r * r }
        if (s < least) { least = s; best = p }
      }
      if (bad || least > 1e299 || best < -1.495 || best > -0.105) print "-"; else printf "%.2f\n", best
    }'
}

# photons SCENE COUNT SEED FILE, and records SCENE PHOTONS ACCURACY SEED FILE WIDTH OPTION...: as plans make them.
photons() { phos-photons "$1" "${common[@]}" --photons "$2" --seed "$3" --reuse -o "$4"; }
records() {
  local radius
  radius=$(calculate %.6g "$(constant kLeastRadius) * $3 * $typical")
  phos-irradiance "$1" "$2" "${common[@]}" --place view --width "$6" --accuracy "$3" --min-radius "$radius" --seed "$4" "${@:7}" \
    --stats "$5.json" -o "$5"
}
# indirect SCENE RECORDS FILE WIDTH: a picture of indirect light.
indirect() {
  phos-splat "$1" "$2" "${common[@]}" --width "$4" --pixel-samples 32 --direct none --gloss-samples 0 --splat cpu --layers indirect,emission -o "$3"
}
declare -A prepared
# Before a scene's measurements: its typical distance, photons, and records that any picture may read.
prepare() {
  base=$folder/$size-$(basename "${1%.*}")
  if [[ -z ${prepared[$1]:-} ]]; then
    photons "$1" "${photons[1]}" 1 "$base.photons"
    phos-irradiance "$1" "$base.photons" "${common[@]}" --estimate gather --rays 27 --accuracy 0.4 --place view --width "$width" \
      --stats "$base.irradiance.json" -o "$base.irradiance"
    prepared[$1]=yes
  fi
  typical=$(stat_of typical_distance_m "$base.irradiance.json")
}

# Two sets of records of the same photons differ by the noise of rays alone: read_noise CONSTANT SCENE FOOTPRINT.
read_noise() {
  local a seed read rows=()
  for a in 0.56 0.4 0.28 0.2; do
    for seed in 1 2; do
      records "$2" "$base.photons" "$a" $seed "$base-read$seed.irradiance" "$width" --estimate gather --rays "$few" --footprint "$3"
      indirect "$2" "$base-read$seed.irradiance" "$base-read$seed.exr" "$width"
    done
    read=$(awk -v a="$a" 'BEGIN { m = a > 0.5 ? a : 0.5; r = 2.5 * a < m ? 2.5 * a : m; print (r / a) ^ 2 }')
    rows+=("$read $(noise2 "$base-read1.exr" "$base-read2.exr" indirect)")
  done
  found "$1" "$2" "$(power "${rows[@]}")" "${rows[@]}"
}
noise_read() { read_noise kNoiseRead "$1" circle; }
adaptive_read() { read_noise kAdaptiveNoiseRead "$1" adaptive; }
zone_blur() {
  local n seed bias rows=() times=()
  reference_pair "$base-reference" "$1" --width "$width" --samples "$reference" --adaptive --threads "$threads"
  for n in "${photons[@]}"; do
    for seed in 1 2; do
      photons "$1" "$n" $seed "$base-$n-$seed.photons"
      records "$1" "$base-$n-$seed.photons" 0.2 $seed "$base-blur$seed.irradiance" "$width" --estimate gather --rays "$rays"
      indirect "$1" "$base-blur$seed.irradiance" "$base-blur$seed.exr" "$width"
    done
    bias=$(calculate %.6g "0.5 * ($(total2 "$base-blur1.exr" "$base-reference" indirect) + $(total2 "$base-blur2.exr" "$base-reference" indirect)) \
      - $(noise2 "$base-blur1.exr" "$base-blur2.exr" indirect)")
    rows+=("$n $bias") times+=("$n $(stat_of "seconds.coarse records" "$base-blur1.irradiance.json")")
  done
  found kZoneBlurPhotons "$1" "$(falling_power "${rows[@]}")" "${rows[@]}"
  found kCoarseSecondsPhotons "$1" "$(power "${times[@]}")" "${times[@]}"
}
full_zones() {
  local n seed rows=()
  for n in "${full_photons[@]}"; do
    for seed in 1 2; do
      photons "$1" "$n" $seed "$base-$n-$seed.photons"
      records "$1" "$base-$n-$seed.photons" 0.2 $seed "$base-hull$seed.irradiance" "$width" --estimate hull
      indirect "$1" "$base-hull$seed.irradiance" "$base-hull$seed.exr" "$width"
    done
    rows+=("$n $(noise2 "$base-hull1.exr" "$base-hull2.exr" indirect)")
  done
  found kFullZonePhotons "$1" "$(power "${rows[@]}")" "${rows[@]}"
}
# lit SCENE STEM WIDTH OPTION...: two pictures STEM1.exr and STEM2.exr of other seeds, with direct light.
lit() {
  local seed
  for seed in 1 2; do
    phos-splat "$1" "$base.irradiance" "${common[@]}" --width "$3" --splat cpu --layers beauty,direct,emission --direct interleaved --seed $seed \
      "${@:4}" -o "$2$seed.exr"
  done
}
shadows() {
  local w rows=()
  for w in "$small" "$((4 * small))"; do
    lit "$1" "$base-lit" "$w" --pixel-samples 1 --light-samples 8 --gloss-samples 0
    rows+=("$((w * w)) $(noise2 "$base-lit1.exr" "$base-lit2.exr" direct)")
  done
  found kShadowNoisePixels "$1" "$(power "${rows[@]}")" "${rows[@]}"
}
# Points of lamps that gloss rays find count as direct light. Shadow rays find them too: with more of those the power comes out greater.
gloss() {
  local samples rows=()
  for samples in 32 128; do
    lit "$1" "$base-gloss" "$small" --pixel-samples "$samples" --light-samples 512 --gloss-samples 128
    rows+=("$samples $(noise2 "$base-gloss1.exr" "$base-gloss2.exr" direct)")
  done
  found kCurvedGlossSamples "$1" "$(power "${rows[@]}")" "${rows[@]}"
}
# Sensors read records of accuracy 0.2 with 0.5, and of 0.1 with 0.25.
sensors() {
  local scene=$1 spacing=$2 height=$3 a seed rows=()
  phos-sense "$scene" "${common[@]}" --direct-only --light-samples 1 --grid "$spacing" --height "$height" -o "$base-points.csv"
  for a in 0.2 0.1; do
    for seed in 1 2; do
      phos-irradiance "$scene" "$base.photons" "${common[@]}" --at "$base-points.csv" --place given --estimate gather --rays "$few" --accuracy "$a" \
        --seed $seed -o "$base-sensors.irradiance"
      phos-sense "$scene" "$base-sensors.irradiance" "${common[@]}" --points "$base-points.csv" --light-samples 1 -o "$base-lux$seed.csv"
    done
    rows+=("$(awk -v a="$a" 'BEGIN { print (2.5 * a) ^ 2 }') $(lux_noise2 "$base-lux1.csv" "$base-lux2.csv")")
  done
  found kSensorNoiseReading "$scene" "$(power "${rows[@]}")" "${rows[@]}"
}
lux_noise2() {
  awk -F, '/^#/ { next } !named[FILENAME]++ { for (i = 1; i <= NF; i++) if ($i == "indirect_lx") c[FILENAME] = i; next }
    NR == FNR { first[FNR] = $c[FILENAME]; next }
    { d = first[FNR] - $c[FILENAME]; s += d * d; m += $c[FILENAME]; n++ } END { print (m > 0 ? s / 2 / n / (m / n) ^ 2 : 0) }' "$1" "$2"
}
# The number m of places at which the odds n / (m - n) of records follow one power of the accuracy, from 0.4 to 0.2 to 0.1.
places() {
  local a counts=() height
  for a in 0.4 0.2 0.1; do
    records "$1" "$base.photons" "$a" 1 "$base-places.irradiance" "$width" --estimate gather --rays 27
    counts+=("$(stat_of records_made "$base-places.irradiance.json")")
  done
  height=$(jq -r '.command | capture("--height (?<h>[0-9]+)").h' "$base-places.irradiance.json")
  found kPlacesOfAPixel "$1" "$(awk -v n1="${counts[0]}" -v n2="${counts[1]}" -v n3="${counts[2]}" -v pixels="$((width * height))" '
    function bend(m) { return log(n3 / (m - n3) / n2 * (m - n2)) - log(n2 / (m - n2) / n1 * (m - n1)) }
    BEGIN {
      low = 1.0001 * n3; high = 100 * n3
      if (!(n1 < n2 && n2 < n3) || bend(low) < 0 || bend(high) > 0) { print "-"; exit }
      for (i = 0; i < 60; i++) { m = (low + high) / 2; if (bend(m) > 0) low = m; else high = m }
      printf "%.3f\n", m / pixels
    }')"
}
# spread VALUE...: mean and standard deviation.
spread() { printf '%s\n' "$@" | awk '{ s += $1; q += $1 * $1; n++ } END { v = (q - s * s / n) / (n - 1); print s / n, sqrt(v > 0 ? v : 0) }'; }
times() {
  local i short=() long=() mean sigma
  for ((i = 0; i < repeats; ++i)); do
    phos-photons "$1" "${common[@]}" --photons 1000 --stats "$base-time.json" -o "$base-time.photons"
    short+=("$(stat_of seconds.total "$base-time.json")")
    records "$1" "$base.photons" 0.2 1 "$base-time.irradiance" "$width" --estimate gather --rays "$few"
    long+=("$(stat_of seconds.total "$base-time.irradiance.json")")
  done
  read -r mean sigma <<<"$(spread "${short[@]}")"
  found kRunTimeLeast "$1" "$(calculate %.5f "$sigma")"
  read -r mean sigma <<<"$(spread "${long[@]}")"
  found kRunTimeDoubt "$1" "$(calculate %.3f "$sigma / $mean")"
}
# The first round of each plan: error and seconds over the predicted ones. The doubt is the root mean square over all plans.
plans() {
  local error code run
  for error in $errors; do
    run=$base-plan-${error%\%} code=0
    phos-plan "$1" --error "$error" --width "$width" --threads "$threads" --quiet --progress never --run --rounds 1 "${plan_words[@]}" -o "$run" || code=$?
    ((code <= 1)) || { echo "${0##*/}: $1: no plan for $error" >&2; continue; }
    jq -r '.run.rounds[0] | "\(.predicted_error) \(.error) \(.predicted_s) \(.seconds)"' "$run/plan.json" >"$run.txt"
    found kErrorDoubt "$1 $error" "$(awk '{ printf "%.3f\n", ($2 / $1) ^ 2 - 1 }' "$run.txt")"
    found kTimeDoubt "$1 $error" "$(awk '{ printf "%.3f\n", $4 / $3 - 1 }' "$run.txt")"
  done
}

# each MEASUREMENT SCENE...: where it is asked for and the scene is there.
each() {
  local what=$1 entry scene spacing height
  shift
  [[ " $only " == *" $what "* ]] || return 0
  for entry in "$@"; do
    IFS=: read -r scene spacing height <<<"$entry"
    [[ -f $root/$scene ]] || { echo "${0##*/}: $scene is not there, and is left out" >&2; continue; }
    prepare "$root/$scene"
    "$what" "$root/$scene" "$spacing" "$height"
  done
}
each noise_read "${rooms[@]}"
each adaptive_read "${rooms[@]}"
each zone_blur "${rooms[@]}"
each full_zones "${rooms[@]}"
each shadows "${shaded[@]}"
each gloss "${curved[@]}"
each sensors "${gridded[@]}"
each places "${rooms[@]}"
each times "${rooms[0]}"
each plans "${rooms[@]}"

# Doubts are root mean squares of their deviations, the rest are means. The lines of the header's part 1, and a copy of it, with what was found.
awk -F, -v copy="$folder/calibration.h" '
  NR == FNR {
    if (FNR == 1) next
    told[$1] = told[$1] (told[$1] == "" ? "" : ", ") $2 " " $3
    if ($3 != "-") { n[$1]++; sum[$1] += $3; squares[$1] += $3 * $3 }
    next
  }
  /^\/\/ [123]\. / { part = $0 ~ /^\/\/ 1/ }
  part && /^inline constexpr double k[A-Za-z]+ = / {
    split($0, word, /[ ;]/); name = word[4]; was = value = word[6]
    if (n[name] > 0) value = sprintf("%.2g", name ~ /^k(Error|Time)Doubt$/ ? sqrt(squares[name] / n[name]) : sum[name] / n[name])
    why = n[name] > 0 ? told[name] : name in told ? "not told: " told[name] : "not measured"
    $0 = "inline constexpr double " name " = " value ";"
    printf "%-55s // header %s; %s\n", $0, was, why
    delete told[name]
  }
  { print > copy }
  END { for (name in told) { print "plan_calibration.sh: " name " is not in part 1 of the header" > "/dev/stderr"; exit 1 } }' "$results" "$header"
