#!/usr/bin/env bash
# Builds phos, and with --tests its tests, into build/release: build.sh [--tests]. Prints where the programs are.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tests=OFF
[[ ${1:-} == --tests ]] && tests=ON
pipelines/install.sh ${1:+"$1"}
log=$(mktemp)
trap 'rm -f "$log"' EXIT
cmake --preset release -DPHOS_TESTS=$tests >"$log" 2>&1 || { cat "$log" >&2; exit 3; }
# Reads lines of ninja, "[120/340] ...", and shows the progress: on a terminal as one line that changes, elsewhere as a new line every half minute.
progress() {
  local line start=$SECONDS next=$SECONDS
  while IFS= read -r line; do
    [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]] || continue
    local made=${BASH_REMATCH[1]} all=${BASH_REMATCH[2]}
    ((made > 0)) || continue
    local left=$(((SECONDS - start) * (all - made) / made))
    if [[ -t 2 ]]; then
      printf '\r[%d/%d] %d min %02d s left ' "$made" "$all" $((left / 60)) $((left % 60)) >&2
    elif ((SECONDS >= next)); then
      printf '[%d/%d] %d min %02d s left\n' "$made" "$all" $((left / 60)) $((left % 60)) >&2
      next=$((SECONDS + 30))
    fi
  done
  [[ ! -t 2 ]] || printf '\r%40s\r' '' >&2
}
echo "building (the first time takes several minutes on two cores)"
NINJA_STATUS='[%f/%t] ' cmake --build --preset release 2>&1 | tee "$log" | progress || { tail -n 60 "$log" >&2; exit 3; }
echo "programs: $PWD/build/release/bin"
