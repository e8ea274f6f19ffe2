#!/usr/bin/env bash
# For other scripts to source: the programs on PATH, or else those in build/release/bin; ends with a word where there are none.
PATH=$PATH:$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/../build/release/bin
command -v phos-splat >/dev/null || {
  echo "${0##*/}: phos-splat: not on PATH, nor in build/release/bin; run pipelines/build.sh first" >&2
  exit 3
}
