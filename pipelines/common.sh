#!/usr/bin/env bash
# For other scripts to source: their usage, options, programs and figures.

# usage: prints the comment at the head of the script and ends with code 2.
usage() { awk 'NR > 1 { if (!sub(/^# ?/, "")) exit; print }' "$0" >&2; exit 2; }

# take_options "NAME..." WORD...: --NAME VALUE sets the variable NAME (light_samples: --light-samples); other words are left in the
# array `rest`.
take_options() {
  local names=" $1 " name
  shift
  rest=()
  while (($# > 0)); do
    name=${1#--} name=${name//-/_}
    if [[ $1 == --* && $names == *" $name "* ]]; then
      [[ $# -ge 2 ]] || usage
      declare -g "$name=$2"
      shift
    else
      rest+=("$1")
    fi
    shift
  done
}

# take_all_options "NAME..." WORD...: the same, where other words are not understood.
take_all_options() {
  take_options "$@"
  ((${#rest[@]} == 0)) || usage
}

# file_options OPTION VALUE...: puts those options of a scene into the array `files` whose values are files. Every stage needs them; it takes
# the others from the caches that it reads.
file_options() {
  files=()
  while (($# > 1)); do
    case $1 in --environment | --luminaire | --spectrum) files+=("$1" "$2") ;; esac
    shift 2
  done
}

# need_file FILE: ends with code 3 where there is none.
need_file() { [[ -f $1 ]] || { echo "${0##*/}: $1: no such file" >&2; exit 3; }; }

# need_programs: those on PATH, or else in build/release/bin; ends with code 3 where there are none.
need_programs() {
  PATH=$PATH:$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/../build/release/bin
  command -v phos-splat >/dev/null || {
    echo "${0##*/}: phos-splat: not on PATH, nor in build/release/bin; run pipelines/build.sh first" >&2
    exit 3
  }
}

# figure NAME [FILE]: the first value of that name anywhere in a JSON file, or in what is read; nothing where there is none.
figure() { jq -r --arg name "$1" 'first(.. | objects | select(has($name)) | .[$name])' ${2+"$2"}; }
