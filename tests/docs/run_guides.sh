#!/usr/bin/env bash
# Runs the commands of the manual from its text, at toy size:
#   tests/docs/run_guides.sh [PAGE.md]...        default: README.md, and every page of docs/guide and docs/reference
# A block of code is run if it is marked ```sh and the line before it is <!-- run -->; <!-- run if COMMAND --> runs it where COMMAND
# succeeds. A block that is not to run has <!-- not run: WHY --> before it; one of neither kind is an error. The blocks of a page run in one shell, one after another, in a scratch folder that has data/ and pipelines/. Sizes (photons,
# rays, pixels, frames) are cut down by toy.sh, so that a page can give those that a reader wants. Needs the programs on PATH, or else
# in build/release/bin. Exit 1 if a command fails; its page, the block's line and what it said are then printed.
set -euo pipefail
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
PATH=$PATH:$project/build/release/bin
where=$(command -v phos-splat) || { echo "run_guides.sh: phos-splat: not on PATH, nor in build/release/bin" >&2; exit 3; }
PHOS_REAL_PROGRAMS=$(dirname "$where")
export PHOS_REAL_PROGRAMS

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/bin"
for program in "$PHOS_REAL_PROGRAMS"/phos-*; do
  [[ ! -x $program || -d $program ]] || ln -s "$project/tests/docs/toy.sh" "$scratch/bin/$(basename "$program")"
done

# The marked blocks of a page as a script. "## LINE" on its output says which block runs.
script_of() {
  awk '
    /^<!-- run -->$/ { marked = 1; guard = ""; next }
    /^<!-- run if .* -->$/ { marked = 1; guard = $0; sub(/^<!-- run if /, "", guard); sub(/ -->$/, "", guard); next }
    /^<!-- not run: .* -->$/ { excused = 1; next }
    !marked && !excused && /^```sh$/ { print FILENAME ":" NR ": the block has neither <!-- run --> nor <!-- not run: WHY -->" >"/dev/stderr"; exit bad = 1 }
    marked && /^```sh$/ { print "echo \"## " NR "\""; if (guard != "") print "if " guard "; then"; inside = 1; marked = 0; next }
    inside && /^```$/ { if (guard != "") print "fi"; inside = 0; next }
    inside { print; next }
    { marked = excused = 0 }
    END { if (inside) print FILENAME ": the last block has no end" >"/dev/stderr"; exit bad || inside }' "$1"
}

pages=("$@")
((${#pages[@]} > 0)) || pages=("$project/README.md" "$project"/docs/guide/*.md "$project"/docs/reference/*.md)
failed=0
for page in "${pages[@]}"; do
  name=$(basename "$page" .md)
  script_of "$page" >"$scratch/$name.sh" || { failed=1; continue; }
  [[ -s $scratch/$name.sh ]] || continue
  mkdir "$scratch/$name"
  cp -r "$project/data" "$project/pipelines" "$scratch/$name/"
  start=$SECONDS
  if (cd "$scratch/$name" && PATH=$scratch/bin:$PATH timeout 500 bash -euo pipefail "$scratch/$name.sh" </dev/null >"$scratch/log" 2>&1); then
    echo "$name: $(grep -c '^## [0-9]*$' "$scratch/log") blocks, $((SECONDS - start)) s"
  else
    line=$(grep '^## [0-9]*$' "$scratch/log" | tail -1)
    echo "$page:${line#\#\# }: a command of this block failed:" >&2
    tail -20 "$scratch/log" >&2
    failed=1
  fi
  rm -rf "${scratch:?}/$name"
done
exit $failed
