#!/usr/bin/env bash
# Checks the manual's links: every relative link of README.md and docs/ leads to a file, every #anchor to a heading or an <a id>, and
# docs/README.md leads to every page. Prints what does not; exit 1 if there is anything.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
mapfile -t pages < <(find README.md docs -name '*.md' | sort)

# Text without blocks of code and without `code`.
prose() { awk '/^```/ { inside = !inside; next } !inside { gsub(/`[^`]*`/, ""); print }' "$1"; }
links_of() { prose "$1" | grep -oE '\]\([^) ]+\)' | sed 's/^](//; s/)$//' | grep -vE '^(https?|mailto):' || true; }
# Anchors as GitHub makes them from headings, and those that pages set themselves.
anchors_of() {
  awk '/^```/ { inside = !inside; next }
    !inside && /^#+ / {
      sub(/^#+ +/, ""); gsub(/<[^>]*>/, ""); gsub(/\[|\]\([^)]*\)/, "")
      $0 = tolower($0); gsub(/[^a-z0-9 _-]/, ""); gsub(/ /, "-")
      print ($0 in seen) ? $0 "-" seen[$0] : $0; ++seen[$0] }' "$1"
  grep -oE '<a id="[^"]+"' "$1" | sed 's/^<a id="//; s/"$//' || true
}

wrong=0
say() { echo "$1" >&2; wrong=1; }
for page in "${pages[@]}"; do
  while IFS= read -r link; do
    [[ -n $link ]] || continue
    file=${link%%#*} anchor=''
    [[ $link != *'#'* ]] || anchor=${link#*#}
    if [[ -z $file ]]; then target=$page; else target=$(dirname "$page")/$file; fi
    [[ -e $target ]] || { say "$page: $link: there is no $target"; continue; }
    [[ -z $anchor || $target != *.md ]] || grep -qxF -- "$anchor" < <(anchors_of "$target") || say "$page: $link: $target has no such anchor"
  done < <(links_of "$page")
done
for page in "${pages[@]}"; do
  [[ $page == docs/* && $page != docs/README.md ]] || continue
  grep -qxF -- "${page#docs/}" < <(links_of docs/README.md | sed 's/#.*//') || say "docs/README.md: does not lead to $page"
done
((wrong)) || echo "${#pages[@]} pages: every link leads somewhere"
exit $wrong
