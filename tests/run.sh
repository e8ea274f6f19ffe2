#!/usr/bin/env bash
# Installs what is missing, builds, and runs the tests: tests/run.sh [ctest options, e.g. -L unit or -R Hull]
# ctest runs suites; their cases are counted here, and build/release/tests/results.txt names each with its result.
# The last line reads "N passed, N failed" (and how many were skipped, if any). Exit 0 if none failed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

pipelines/build.sh --tests
log=$(mktemp)
trap 'rm -f "$log"' EXIT
export MESA_SHADER_CACHE_DISABLE=true PHOS_TEST_RESULTS=$PWD/build/release/tests/results.txt
: >"$PHOS_TEST_RESULTS"
code=0
ctest --test-dir build/release -j "$(nproc)" --output-on-failure "$@" >"$log" 2>&1 || code=$?
grep -vE '^ *[0-9]+/[0-9]+ Test .* Passed|^ +Start +[0-9]+:' "$log" || true
read -r passed failed skipped < <(tests/support/count.awk "$PHOS_TEST_RESULTS" "$log")
((code == 0 || failed > 0)) || failed=1 # ctest itself failed
((passed + failed + skipped > 0)) || { echo "no test was run" >&2; failed=1; }
awk '$1 == "failed" { print "failed: " $2 }' "$PHOS_TEST_RESULTS"
if ((skipped > 0)); then
  echo "$passed passed, $failed failed, $skipped skipped"
else
  echo "$passed passed, $failed failed"
fi
((failed == 0))
