#!/usr/bin/env bash
# Validates phos with CIE 171:2006, cases 5.2 to 5.14. Computes every case as a scene, with every estimator that can compute it:
#   pipelines/cie171.sh FOLDER [--cases 5.2,5.9,...] [--skies 1,5,...] [--estimators exact,records,...] [--quick] [--seed N] [--threads N]
# The script writes FOLDER/results.csv (case,variant,point,sky,estimator,value,stderr,truth), FOLDER/index.html and FOLDER/cie171.md. A second
# run goes on where an interrupted one ended. FOLDER/log.txt holds the messages of the programs. --quick takes skies 5 and 12 only, and less
# accuracy. --estimators may also name photons, whose direct light is counted and blurred over the zones of records. Exit code 1: a value differs
# from the true value by more than 2 % and by more than four standard errors.
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
[[ $# -ge 1 && $1 != -* ]] || usage
folder=$1
shift
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
all_cases=5.2,5.3,5.4,5.5,5.6,5.7,5.8,5.9,5.10,5.11,5.12,5.13,5.14 all_skies=1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16
all_estimators=exact,records,gathered,cached,picture,photons
cases=$all_cases skies='' estimators=${all_estimators%,photons} seed=0 threads=0 quick=''
photons=1000000 error=0.005 rays=1024 light_samples=16384 pixel_samples=512
while (($# > 0)); do
  case $1 in
    --cases | --skies | --estimators | --seed | --threads)
      [[ $# -ge 2 ]] || usage
      declare "${1#--}=$2"
      shift 2 ;;
    --quick)
      quick=5,12 photons=200000 error=0.007 rays=256 light_samples=4096 pixel_samples=128
      shift ;;
    *) usage ;;
  esac
done
skies=${skies:-${quick:-$all_skies}}
known() {
  local word
  for word in ${2//,/ }; do
    [[ ,$3, == *,$word,* ]] || { echo "cie171.sh: $1 $word: give some of $3" >&2; exit 2; }
  done
}
known --cases "$cases" $all_cases
known --skies "$skies" $all_skies
known --estimators "$estimators" $all_estimators
data=$(cd "$here/../data/cie171" && pwd)
need_programs
source "$here/cie171/scenes.sh"
source "$here/cie171/estimators.sh"
mkdir -p "$folder/scenes" "$folder/rows"
: >"$folder/log.txt"
settings="photons $photons error $error rays $rays light-samples $light_samples ($pixel_samples a pixel) seed $seed, $(phos-sense --version)"

# case | variants | skies, or angles of incidence | factor from lx to the unit of the case | estimators left out
table='
5.2  | -                                                                          | -      | 1     |
5.3  | -                                                                          | -      | 1     |
5.4  | -                                                                          | -      | 1     | picture
5.5  | schlick_single_0.96 tregenza_6mm fresnel_slab_no_absorption_1.52           | angles | 0.001 | picture records photons
5.6  | 0.5 4 500                                                                  | -      | 1     |
5.7  | -                                                                          | -      | 1     |
5.8  | 0 0.05 0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8 0.9 0.95                            | -      | 1     | picture
5.9  | 1x1 4x4                                                                    | skies  | 0.01  |
5.10 | 1x1 4x4                                                                    | skies  | 0.01  |
5.11 | 2x1 4x3                                                                    | skies  | 0.01  |
5.12 | 2x1 4x3                                                                    | skies  | 0.01  |
5.13 | mask_0.5 mask_1 mask_2                                                     | skies  | 0.01  |
5.14 | mask_3 mask_6 mask_9                                                       | skies  | 0.01  |'

# light CASE SKY: prints the options of sky and sun for every stage. In cases 5.9 to 5.14 the sky gives 10,000 lx on open ground, and the sun is
# hidden.
light() {
  local albedo=0
  case $1 in
    5.5) echo "--sun 180,$((90 - $2)) --sun-illuminance 1000 --sun-diameter 0.01 --ground-albedo 0" ;;
    5.9 | 5.1?)
      [[ $1 == 5.1[12] ]] && albedo=0.3
      echo "--sky cie:$2 --sun 180,60 --sun-illuminance 0 --sky-illuminance 10000 --ground-albedo $albedo --portals auto" ;;
  esac
}

# run CASE VARIANT SKY FACTOR ESTIMATOR: computes rows of results, unless a file holds those rows already, of the same scene and settings.
run() {
  local name=$1${2:+-${2// /_}}${3:+-$3} variant=$2 key
  local rows=$folder/rows/$name-$5.csv
  scene=$folder/scenes/$name.gltf points=$folder/scenes/$name.csv
  "scene_$1" "$variant" "$3" | awk -f "$here/cie171/scene.awk" >"$scene"
  { echo id,x,y,z,nx,ny,nz; "points_$1" "$variant" "$3"; } >"$points"
  read -ra options <<<"$(light "$1" "$3") --seed $seed --threads $threads --quiet"
  key="# $settings $(cat "$scene" "$points" | cksum)"
  all_rows+=("$rows")
  [[ -f $rows && $(head -1 "$rows") == "$key" ]] && return
  "estimate_$5" >"$folder/readings.csv" 2>>"$folder/log.txt" || { tail -3 "$folder/log.txt" >&2; return 3; }
  { echo "$key"; awk -v case_of="$1" -v variant="$variant" -v sky="$3" -v factor="$4" -v estimator="$5" \
      -f "$here/cie171/rows.awk" "$data/truth.csv" "$folder/readings.csv"; } >"$rows.part"
  mv "$rows.part" "$rows"
}

all_rows=()
while IFS='|' read -r case variants by factor without; do
  case=${case// /} by=${by// /} factor=${factor// /}
  [[ -n $case && ,$cases, == *,$case,* ]] || continue
  for variant in $variants; do
    variant=${variant//_/ } && [[ $case != 5.5 ]] || variant=${variant// /_}
    [[ $variant != - ]] || variant=''
    case $by in skies) list=${skies//,/ } ;; angles) list='0 5 10 15 20 25 30 35 40 45 50 55 60 65 70 75 80 85' ;; *) list=none ;; esac
    for sky in $list; do
      [[ $sky != none ]] || sky=''
      for estimator in ${estimators//,/ }; do
        # Pictures show surfaces, and photons land on surfaces: both are left out where sensors face a beam, or hang over a square of 500 m.
        [[ " $without " != *" $estimator "* ]] || continue
        [[ $case-$variant != 5.6-500 || " records photons picture " != *" $estimator "* ]] || continue
        run "$case" "$variant" "$sky" "$factor" "$estimator"
      done
      echo "$case ${variant:-}${sky:+ $sky}" >&2
    done
  done
done <<<"$table"
rm -f "$folder"/{readings,pixels,position,lux}.csv "$folder"/light.*

{ echo case,variant,point,sky,estimator,value,stderr,truth; cat "${all_rows[@]}" | grep -v '^#'; } >"$folder/results.csv"
for format in html md; do
  awk -v format=$format -v settings="$settings" -f "$here/cie171/page.awk" "$folder/results.csv" >"$folder/page.$format"
done
mv "$folder/page.html" "$folder/index.html"
mv "$folder/page.md" "$folder/cie171.md"
echo "page:   $folder/index.html" >&2
# Four standard errors are beyond chance: by chance, one value in 22 differs by more than two.
awk -F, 'NR > 1 { d = $6 - $8; if (d < 0) d = -d; if (d > 0.02 * $8 + 1e-9 && d > 4 * $7) { print "off: " $0 >"/dev/stderr"; off = 1 } } END { exit off }' \
  "$folder/results.csv"
