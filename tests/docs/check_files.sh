#!/usr/bin/env bash
# Does docs/reference/files.md name every tensor that the code writes, and docs/reference/exit-codes.md every exit code? Exit 1 if not.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
wrong=0
while IFS= read -r tensor; do
  grep -qF -- "\`$tensor\`" docs/reference/files.md || { echo "docs/reference/files.md: has no tensor \`$tensor\`" >&2; wrong=1; }
done < <(grep -rhoE '\.add(_vectors)?(<[^>]*>)?\("[a-z_]+"' lib --include='*.cpp' --exclude-dir=study | grep -oE '"[a-z_]+"' | tr -d '"' | sort -u)
while IFS= read -r code; do
  grep -qE "^\| $code \|" docs/reference/exit-codes.md || { echo "docs/reference/exit-codes.md: has no code $code" >&2; wrong=1; }
done < <(sed -n '/^enum class ExitCode/,/^};/s/.* = \([0-9]*\),.*/\1/p' lib/core/error.h)
((wrong)) || echo "every tensor and every exit code is explained"
exit $wrong
