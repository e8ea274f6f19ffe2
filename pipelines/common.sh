#!/usr/bin/env bash
# Functions that the other scripts source: usage, options, programs and figures.

# usage: prints the comment at the head of the script and ends with code 2.
usage() { awk 'NR > 1 { if (!sub(/^# ?/, "")) exit; print }' "$0" >&2; exit 2; }

# take_options "NAME..." WORD...: reads the WORDs. --NAME VALUE sets the variable NAME (--light-samples sets light_samples). Other words go into the
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

# take_all_options "NAME..." WORD...: does the same, and ends with the usage where there are other words.
take_all_options() {
  take_options "$@"
  ((${#rest[@]} == 0)) || usage
}

# file_options OPTION VALUE...: puts the options whose values are files into the array `files`. Every stage needs these options; it takes the
# other options of the scene from the caches that it reads.
file_options() {
  files=()
  while (($# > 1)); do
    case $1 in --environment | --luminaire | --spectrum) files+=("$1" "$2") ;; esac
    shift 2
  done
}

# need_file FILE: ends with code 3 where there is no such file.
need_file() { [[ -f $1 ]] || { echo "${0##*/}: $1: no such file" >&2; exit 3; }; }

# need_programs: finds the programs on PATH, or else in build/release/bin (in an installation: in its folder bin). Ends with code 3 where there are
# none.
need_programs() {
  local here bin advice
  here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)
  if [[ -f $here/build.sh ]]; then
    bin=$here/../build/release/bin advice='nor in build/release/bin; run pipelines/build.sh first'
  else
    bin=$(realpath -m "$here/../../../bin")
    advice="nor in $bin; put their folder on PATH"
  fi
  PATH=$PATH:$bin
  command -v phos-splat >/dev/null || { echo "${0##*/}: phos-splat: not on PATH, $advice" >&2; exit 3; }
}

# figure NAME [FILE]: prints the first value of this name anywhere in a JSON file, or on standard input; prints nothing where there is none.
figure() { jq -r --arg name "$1" 'first(.. | objects | select(has($name)) | .[$name])' ${2+"$2"}; }
