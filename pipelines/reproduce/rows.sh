# For reproduce.sh to source: rows of a table, all fields in quotes; the first row names the columns, the last tells the settings.

field() { local text=${1//\"/\"\"}; printf '"%s"' "$text"; }
start_rows() { echo 'quantity,unit,paper,ours,verdict,why' >"$rows"; }
# row QUANTITY UNIT PAPER OURS VERDICT WHY; "-" is "not stated", "not judged".
row() {
  local line='' part
  for part in "$@"; do line+=,$(field "$part"); done
  echo "${line:1}" >>"$rows"
  printf '  %s: paper %s, ours %s %s (%s)\n' "$1" "$3" "$4" "${2/#-/}" "$5" >&3
}
# judged less|more QUANTITY UNIT PAPER OURS WHY: a row whose verdict is "agrees" within a quarter of the paper's figure, else "better" or
# "worse": less or more of it is better.
judged() { row "$2" "$3" "$4" "$5" "$(verdict "$1" "$4" "$5")" "$6"; }
verdict() {
  awk -v sense="$1" -v paper="$2" -v ours="$3" 'BEGIN {
    if (paper !~ /[0-9]/ || ours !~ /[0-9]/) { print "-"; exit }
    if (ours >= 0.75 * paper && ours <= 1.25 * paper) print "agrees"
    else print (ours < paper) == (sense == "less") ? "better" : "worse"
  }'
}
# claimed QUANTITY CLAIM OURS CONDITION WHY: a claim without a figure; it agrees where the condition (of awk) holds.
claimed() { row "$1" - "$2" "$3" "$(awk "BEGIN { print ($4) ? \"agrees\" : \"worse\" }")" "$5"; }
# skipped QUANTITY WHY: a row that cannot be computed here.
skipped() { row "$1" - - - skipped "$2"; }
# captioned FIGURE TEXT: words that the page shows under a picture of this table.
captioned() { printf '%s\n' "$2" >"$work/$1.caption"; }
