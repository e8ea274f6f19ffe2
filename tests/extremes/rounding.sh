#!/usr/bin/env bash
# How far results move where multiplications and additions are fused: builds the programs so (preset fma) and compares
# a small study made with them to that of build/release. Prints the moves in standard errors; exit 1 above the stated.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
cmake --preset fma -DPHOS_TESTS=OFF >/dev/null
cmake --build --preset fma
PHOS_OTHER_TOOLS=$PWD/build/fma/bin exec build/release/tests/cli_tool_rounding
