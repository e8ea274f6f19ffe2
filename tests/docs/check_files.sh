#!/usr/bin/env bash
# Does docs/reference/exit-codes.md name every exit code? Exit 1 if not. (The tensors of docs/reference/files.md: tests/unit/file_kinds.cpp.)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
wrong=0
while IFS= read -r code; do
  grep -qE "^\| $code \|" docs/reference/exit-codes.md || { echo "docs/reference/exit-codes.md: has no code $code" >&2; wrong=1; }
done < <(sed -n '/^enum class ExitCode/,/^};/s/.* = \([0-9]*\),.*/\1/p' lib/core/error.h)
((wrong)) || echo "every exit code is explained"
exit $wrong
