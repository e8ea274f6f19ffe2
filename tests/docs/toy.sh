#!/usr/bin/env bash
# Stands in for each program where run_guides.sh runs the manual's commands: the program itself, with sizes cut down to a toy's.
# Called by the name of the program; the program is in the folder $PHOS_REAL_PROGRAMS.
set -euo pipefail
name=$(basename "$0")
real=$PHOS_REAL_PROGRAMS/$name
args=("$@")

# Is an option among the arguments? `at` is then its place, `value` what it was given.
given() {
  for ((at = 0; at < ${#args[@]}; ++at)); do
    [[ ${args[at]} != "$1" ]] || { value=${args[at + 1]:-}; return 0; }
    [[ ${args[at]} != "$1="* ]] || { value=${args[at]#*=}; return 0; }
  done
  return 1
}
replace() { if [[ ${args[at]} == *=* ]]; then args[at]=${args[at]%%=*}=$1; else args[at + 1]=$1; fi; }
# Given values above (or, for least, below) a number become that number.
most() { if given "$1" && awk -v v="$value" -v m="$2" 'BEGIN { exit !(v > m) }'; then replace "$2"; fi; }
least() { if given "$1" && awk -v v="${value%\%}" -v p="${value##*[0-9.]}" -v m="$2" 'BEGIN { exit !(v / (p == "%" ? 100 : 1) < m) }'; then replace "$2"; fi; }
# Where an option is not given, it is.
add() { given "$1" || args+=("$1" "$2"); }
word() { [[ " ${args[*]} " == *" $1 "* ]]; }

for other in --help -h --version --man --options-json; do
  if word "$other"; then exec "$real" "$@"; fi
done
if given --frames && [[ $value == *:* ]]; then
  first=${value%%:*} last=${value##*:}
  ((last <= first + 2)) || replace "$first:$((first + 2))"
fi
most --frame 2 # films have three frames
case $name in
  phos-photons) most --photons 20000; add --photons 20000; most --caustic-photons 20000 ;;
  phos-irradiance | phos-radiance | phos-temporal)
    most --rays 52; most --photons 5000; most --width 48; most --light-samples 4
    if ! given --add-to; then
      if [[ $name == phos-temporal ]] || word view; then add --width 48; fi
      if [[ $name != phos-irradiance ]] || word gather; then add --rays 52; fi
      [[ $name != phos-temporal ]] || add --photons 5000
    fi ;;
  phos-splat)
    most --width 48; most --light-samples 16; most --gloss-samples 4; most --pixel-samples 1; most --edge-samples 4; least --noise 0.3
    given --height || add --width 48 ;;
  phos-brdf) if given --figure; then most --width 48; add --width 48; fi ;;
  phos-sense) most --samples 16; most --rays 64; most --light-samples 16; least --error 0.1; least --grid 0.05; word --exact || given --light-samples || add --error 0.1 ;;
  phos-reference)
    most --samples 4; most --width 48; most --gather-rays 4; least --error 0.2
    if ! given --points; then add --width 48; add --samples 4; fi ;;
  phos-plan)
    if word --run; then most --pilot-seconds 1; add --pilot-seconds 1; else most --pilot-seconds 0; add --pilot-seconds 0; fi
    most --width 48; least --error 0.2; most --seconds 3; most --reference-seconds 2; least --grid 0.1 ;;
esac
add --threads 1
exec "$real" "${args[@]}"
