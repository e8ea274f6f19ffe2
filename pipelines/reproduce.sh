#!/usr/bin/env bash
# Tables and figures of the papers that phos follows, computed anew beside the papers' own figures:
#   pipelines/reproduce.sh FOLDER [TABLE...] [--toy] [--again] [--seed N] [--threads N]
#   pipelines/reproduce.sh --list
# Writes FOLDER/TABLE.csv (quantity, unit, paper, ours, verdict and why), row by row, pictures and plots in FOLDER/TABLE, and FOLDER/index.html
# with every table that FOLDER holds. All tables if none is named; --list prints them, with their minutes. A finished table is kept,
# unless --again is given or its script, the programs' version, --toy or --seed changed. --toy: every table in seconds, to try the scripts; its
# figures say nothing. Scenes are made here; those of ../shared/scenes are used where they are. FOLDER/log.txt has the programs' messages.
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
size=full again='' list='' seed=0 threads=0
inputs=()
while (($# > 0)); do
  case $1 in
    --seed | --threads)
      [[ $# -ge 2 && $2 =~ ^[0-9]+$ ]] || usage
      declare "${1#--}=$2"
      shift ;;
    --toy) size=toy ;;
    --again) again=yes ;;
    --list) list=yes ;;
    -*) usage ;;
    *) inputs+=("$1") ;;
  esac
  shift
done

# The tables: name | paper | what it shows | minutes at full size, on two cores | seconds at toy size.
mapfile -t tables < <(sed 's/ *| */|/g; s/^ *//' "$here/reproduce/tables.txt" | grep -v '^\(#\|$\)')
names=("${tables[@]%%|*}")
if [[ -n $list ]]; then
  printf '%s\n' "${tables[@]}" | awk -F'|' '{ printf "%-18s %s: %s (%s min; toy %s s)\n", $1, $2, $3, $4, $5 }'
  exit 0
fi
((${#inputs[@]} >= 1)) || usage
folder=${inputs[0]}
wanted=("${inputs[@]:1}")
((${#wanted[@]} > 0)) || wanted=("${names[@]}")
# nearest WORD: the name with the fewest letters to change.
nearest() {
  printf '%s\n' "${names[@]}" | awk -v word="$1" '
    function least(a, b) { return a < b ? a : b }
    { n = length(word); m = length($0)
      for (i = 0; i <= n; ++i) d[i, 0] = i
      for (j = 0; j <= m; ++j) d[0, j] = j
      for (i = 1; i <= n; ++i) for (j = 1; j <= m; ++j)
        d[i, j] = least(least(d[i - 1, j], d[i, j - 1]) + 1, d[i - 1, j - 1] + (substr(word, i, 1) != substr($0, j, 1)))
      if (NR == 1 || d[n, m] < best) { best = d[n, m]; name = $0 } }
    END { print name }'
}
for name in "${wanted[@]}"; do
  [[ " ${names[*]} " == *" $name "* ]] || { echo "reproduce.sh: $name: no such table; did you mean $(nearest "$name")? (--list prints all)" >&2; exit 2; }
done
need_programs
source "$here/reproduce/rows.sh"
source "$here/reproduce/measure.sh"
source "$here/reproduce/scenes.sh"
source "$here/reproduce/ward.sh"
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
common=(--seed "$seed" --threads "$threads" --quiet)
: >>"$folder/log.txt"

# pick FULL TOY: the one of this size.
pick() { if [[ $size == full ]]; then echo "$1"; else echo "$2"; fi; }
# compute NAME: rows of a table by its script, in a shell of its own.
compute() (
  set -e
  rows=$folder/$1.csv.part work=$folder/$1
  mkdir -p "$work"
  start_rows
  source "$here/reproduce/$1.sh"
  "table_${1//[-.]/_}"
  row settings - - "$2" - 'of this run'
  mv "$rows" "$folder/$1.csv"
)
page() {
  printf '%s\n' "${tables[@]}" >"$folder/tables.part"
  awk -v folder="$folder" -v version="$(phos-splat --version)" -f "$here/reproduce/page.awk" "$folder/tables.part" >"$folder/index.html.part"
  mv "$folder/index.html.part" "$folder/index.html"
  rm "$folder/tables.part"
}

failed=0
for name in "${wanted[@]}"; do
  key="$size, seed $seed, $(phos-splat --version), $(cat "$here"/reproduce/{"$name",rows,measure,scenes,films,zones,ward}.sh "$here"/scenes/*.py | cksum | cut -d' ' -f1)"
  if [[ -z $again && -f $folder/$name.csv && $(tail -1 "$folder/$name.csv") == *"\"$key\""* ]]; then
    echo "$name: is there" >&2
    continue
  fi
  echo "$name:" >&2
  set +e
  compute "$name" "$key" 3>&2 2>>"$folder/log.txt"
  failed=$?
  set -e
  ((failed == 0)) || { tail -3 "$folder/log.txt" >&2; echo "reproduce.sh: $name: did not finish; see $folder/log.txt" >&2; break; }
  page
done
page
echo "page: $folder/index.html" >&2
exit "$failed"
