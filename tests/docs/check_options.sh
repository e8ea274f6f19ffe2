#!/usr/bin/env bash
# Is every option of every program in docs/reference/options.md, and is every option there one of its programs'? A row there is
#   | `--option` or several | programs | what it does |
# where the programs are "all", "all with a scene", names without "phos-", or one of the first two with "but" and names.
# Prints what differs; exit 1 if anything does. Needs the programs on PATH, or else in build/release/bin.
set -euo pipefail
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
PATH=$PATH:$project/build/release/bin
where=$(command -v phos-splat) || { echo "check_options.sh: phos-splat: not on PATH, nor in build/release/bin" >&2; exit 3; }
folder=$(dirname "$where")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

for program in "$folder"/phos-*; do
  [[ -x $program && ! -d $program ]] || continue
  tool=$(basename "$program")
  "$program" --options-json | awk -v tool="${tool#phos-}" -F'"' '
    $2 == "kind" { kind = $4 }
    $2 == "name" && kind != "input" && kind != "inputs" { print tool " --" $4 }'
done | sort -u >"$scratch/there"
cut -d' ' -f1 "$scratch/there" | sort -u >"$scratch/all"
awk '$2 == "--luminaire" { print $1 }' "$scratch/there" >"$scratch/scene"

awk -F'|' '/^\| `--/ { print $2 "|" $3 }' "$project/docs/reference/options.md" | while IFS='|' read -r options programs; do
  programs=$(tr -d ',' <<<"$programs" | xargs) but=''
  [[ $programs != *' but '* ]] || { but=${programs#* but }; programs=${programs%% but *}; }
  case $programs in
    all) mapfile -t names <"$scratch/all" ;;
    'all with a scene') mapfile -t names <"$scratch/scene" ;;
    *) read -ra names <<<"$programs" ;;
  esac
  for option in $(grep -oE -- '`--[a-z0-9-]+' <<<"$options" | tr -d '`'); do
    for tool in "${names[@]}"; do
      [[ " $but " == *" $tool "* ]] || echo "$tool $option"
    done
  done
done | sort -u >"$scratch/told"

wrong=0
while read -r tool option; do echo "phos-$tool $option: no row of docs/reference/options.md explains it" >&2; wrong=1; done < <(comm -23 "$scratch/there" "$scratch/told")
while read -r tool option; do echo "docs/reference/options.md: phos-$tool has no $option" >&2; wrong=1; done < <(comm -13 "$scratch/there" "$scratch/told")
((wrong)) || echo "$(wc -l <"$scratch/there") options of $(wc -l <"$scratch/all") programs: every one is explained"
exit $wrong
