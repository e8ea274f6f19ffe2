#!/usr/bin/env bash
# Every stage, hit by every fault at random moments of its run: tests/extremes/faults.sh [MOMENTS] [STAGE] [FAULT]
# Faults: SIGKILL, SIGINT, SIGTERM, a full disk (a small tmpfs where one may be mounted, else a limit to the size of
# files), a folder made unwritable, an input cut short, address space that runs out, two runs with one output. For each
# stage and fault it prints how many moments were tried and after how many the old output was lost, the bytes were
# wrong, or something else was not as promised (a temporary left, another exit code, not one line, a hang).
# A plan and a study, which take seconds, get a fifth of the moments for each fault. Takes about half an hour at 100.
# BUILD names another build folder than build/release.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
export PHOS_FAULT_MOMENTS=${1:-100}
[[ -z ${2:-} ]] || export PHOS_FAULT_STAGE=$2
[[ -z ${3:-} ]] || export PHOS_FAULT=$3
exec "${BUILD:-build/release}/tests/cli_tool_faults"
