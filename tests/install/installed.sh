#!/usr/bin/env bash
# Does an installation work? installed.sh BUILD installs the build folder BUILD, without building, into a folder of its own and tries
# programs, manual pages, completion and pipelines there. Prints what is wrong; exit 1 if anything is.
set -euo pipefail
umask 022
build=$(cd "$1" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export MESA_SHADER_CACHE_DISABLE=true PATH=/usr/local/bin:/usr/bin:/bin
failed=0
wrong() { echo "installed.sh: $*" >&2; failed=1; }
said() { tail -n 5 "$scratch/log" >&2; }

# Where it is not meant to stay, as packages are made.
DESTDIR=$scratch/root cmake --install "$build" --prefix /opt/phos >"$scratch/log" 2>&1 || { said; exit 1; }
prefix=$scratch/root/opt/phos
before=$(cd "$scratch/root" && find . -printf '%p %s %T@\n' | sort)
extra=$(find "$scratch/root" -mindepth 1 -maxdepth 3 ! -path "$scratch/root/opt*")
[[ -z $extra ]] || wrong "files outside of the prefix: $extra"
extra=$(find "$prefix" \( -name golden -o -name damaged -o -name build.sh -o -name install.sh -o -name quickstart.sh \))
[[ -z $extra ]] || wrong "$extra: of no use where phos is installed"
extra=$(find "$prefix" -type d ! -perm 755)
[[ -z $extra ]] || wrong "$extra: not for everyone to read"
for file in share/doc/phos/README.md share/doc/phos/copyright share/phos/data/cornell-measured.glb share/phos/pipelines/render.sh; do
  [[ -f $prefix/$file ]] || wrong "there is no $file"
done

# complete_words WORD...: fills COMPREPLY as bash would where the cursor is at the end of the last word.
complete_words() {
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
  local function
  function=$(complete -p "$1" | grep -oE -- '-F [^ ]+') && "${function#-F }"
}
offers() { [[ " ${COMPREPLY[*]} " == *" $1 "* ]]; }

number=0
for program in "$prefix"/bin/*; do
  name=$(basename "$program")
  "$program" --version >"$scratch/log" 2>&1 || wrong "$name does not start: $(said 2>&1)"
  # The page is the one that the program says, and man shows it.
  page=$prefix/share/man/man1/$name.1.gz
  gzip -t "$page" && gzip -dc "$page" | cmp -s - <("$program" --man) || wrong "$page: not the page of $name"
  if command -v man >/dev/null; then
    MANWIDTH=80 man -l "$page" 2>"$scratch/log" | grep -q '^SYNOPSIS' || wrong "$page: man does not show it"
    [[ ! -s $scratch/log ]] || wrong "$page: $(said 2>&1)"
  fi
  # Every option is completed, and no other.
  source "$prefix/share/bash-completion/completions/$name" || wrong "$name has no completion"
  complete_words "$name" --
  told=$("$program" --options-json | jq -r '.options[] | select(.kind != "input" and .kind != "inputs") | "--" + .name')
  diff <(printf '%s\n' "${COMPREPLY[@]}" | sort -u) <(printf '%s\n' "$told" --help --version --man --options-json | grep . | sort -u) >&2 ||
    wrong "$name: completion (<) and options (>) differ"
  number=$((number + 1))
done
((number > 10)) || wrong "only $number programs"

# What completion offers.
mkdir "$scratch/elsewhere"
cd "$scratch/elsewhere"
touch 'a room.glb' room.irradiance @odd
try() { # WORD... = REPLY...: exactly these replies
  local words=()
  while [[ $1 != '=>' ]]; do words+=("$1"); shift; done
  shift
  complete_words "${words[@]}"
  [[ "${COMPREPLY[*]}" == "$*" ]] || wrong "${words[*]}: completion gives '${COMPREPLY[*]}', not '$*'"
}
try phos-splat --spl '=>' --splat
try phos-splat --splat '' '=>' gl cpu
try phos-splat --splat c '=>' cpu
try phos-splat --splat = '=>' gl cpu
try phos-splat --splat = g '=>' gl
try phos-splat --width '' '=>'
try phos-splat room '=>' room.irradiance
try phos-splat --quiet a '=>' 'a room.glb'
try phos-splat -o room '=>' room.irradiance
try phos-splat --misses room '=>' room.irradiance
try phos-splat --luminaire lamp = room '=>' room.irradiance
try phos-splat @ room '=>' room.irradiance
complete_words phos-splat @
offers room.irradiance || wrong "phos-splat @: completion gives '${COMPREPLY[*]}'"

if [[ -x $prefix/bin/phos ]]; then
  try phos spl '=>' splat
  try phos help spl '=>' splat
  try phos splat --splat = c '=>' cpu
  try phos splat -o room '=>' room.irradiance
fi

# A picture by a pipeline that finds the programs on PATH, figures by one that finds them and its data by itself.
pipelines=$prefix/share/phos/pipelines
PATH=$prefix/bin:$PATH "$pipelines/render.sh" "$prefix/share/phos/data/cornell-measured.glb" out \
  --width 32 --photons 10000 --rays 16 --samples 1 >"$scratch/log" 2>&1 || { wrong "render.sh failed"; said; }
[[ -s out/cornell-measured.exr && -s out/cornell-measured-lux.png ]] || wrong "render.sh made no picture"
"$pipelines/cie171.sh" cie --cases 5.2 --estimators exact --quick >"$scratch/log" 2>&1 || { wrong "cie171.sh failed"; said; }
[[ -s cie/results.csv ]] || wrong "cie171.sh made no table"
# Without programs they say so.
cp -r "$prefix/share" "$scratch/share"
code=0
"$scratch/share/phos/pipelines/render.sh" "$prefix/share/phos/data/cornell-measured.glb" none >"$scratch/log" 2>&1 || code=$?
[[ $code == 3 && ! -e none ]] && grep -q 'put their folder on PATH' "$scratch/log" || { wrong "render.sh without programs: code $code"; said; }

[[ $before == "$(cd "$scratch/root" && find . -printf '%p %s %T@\n' | sort)" ]] || wrong "the installed files changed by use"
((failed)) || echo "$number programs installed, with pages, completion and pipelines"
exit $failed
