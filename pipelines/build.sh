#!/usr/bin/env bash
# Builds phos into build/release: build.sh [--tests]. Prints where the programs are.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tests=OFF
[[ ${1:-} == --tests ]] && tests=ON
pipelines/install.sh ${1:+"$1"}
log=$(mktemp)
trap 'rm -f "$log"' EXIT
cmake --preset release -DPHOS_TESTS=$tests >"$log" 2>&1 || { cat "$log" >&2; exit 3; }
echo "building (the first time takes several minutes on two cores)"
cmake --build --preset release >"$log" 2>&1 || { tail -n 60 "$log" >&2; exit 3; }
echo "programs: $PWD/build/release/bin"
