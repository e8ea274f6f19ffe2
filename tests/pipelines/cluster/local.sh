#!/usr/bin/env bash
# Runs of pipelines/cluster on this machine alone: GNU parallel and Snakemake make the bytes of single runs; and every bad input ends with a line that
# says what is wrong and how to mend it.
#   tests/pipelines/cluster/local.sh [FOLDER-OF-PROGRAMS]
# Code 77: what `pipelines/install.sh --cluster` installs is missing.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
for program in snakemake parallel; do
  command -v "$program" >/dev/null || { echo "skipped: $program is not installed (pipelines/install.sh --cluster)"; exit 77; }
done
python3 -c 'import yaml, tomllib' 2>/dev/null || { echo "skipped: python3-yaml is not installed (pipelines/install.sh --cluster)"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
py=$project/pipelines/cluster/cluster.py
make_points 20 >points.csv
photons=20000
make_configuration box.yaml $photons
make_truth truth $photons

echo "--- the same bytes"
for profile in parallel local; do
  cluster box.yaml $profile --profile $profile
  check_results $profile truth
  once $profile
done
rm local/store/photons/*  # nobody needs them any more
cluster box.yaml local --profile local
[[ -z $(ls local/store/photons) ]] || wrong "shards that only finished jobs read were made again"
echo >>points.csv # another content
[[ $("$py" list box.yaml local | wc -l) == 10 ]] || wrong "a changed file: not 4 parts, their merge, 4 readings and their joining to do: $("$py" list box.yaml local)"
make_points 20 >points.csv
sed -i 's/x/x/' points.csv
[[ -z $("$py" list box.yaml local) ]] || wrong "the former content: something is to do"

echo "--- bad input"
change() { sed "$1" box.yaml >bad.yaml; }
change 's/shards:/shard:/'
refused 2 'settings.toy.shard": no such key; did you mean "shards"?' cluster bad.yaml out
change 's/^pictures/picture/'
refused 2 '"picture": no such key; did you mean "pictures"?' cluster bad.yaml out
change 's/--rays 16/--ray 16/'
refused 2 'phos-irradiance has no option --ray; did you mean "rays"?' cluster bad.yaml out
change 's/--place view/--shard 1\/2/'
refused 2 'phos-irradiance has no option --shard' cluster bad.yaml out
change 's/shards: 4/shards: none/'
refused 2 "settings.toy.shards: give a whole number from 1 to 1048576, not 'none'" cluster bad.yaml out
change 's/--accuracy 0.4/&, parts: 2/'
refused 2 'only records of --place every can be made in parts' cluster bad.yaml out
change 's/cornell-empty/cornell-lost/'
refused 3 'cornell-lost.glb: no such file' cluster bad.yaml out
change '/^cameras/a cameras: {back: --width 3}'
refused 2 'line 3: "cameras" is given twice' cluster bad.yaml out
echo '{' >bad.yaml
refused 3 'bad.yaml: is no YAML' cluster bad.yaml out
refused 3 'none.yaml: no such file' cluster none.yaml out
refused 2 'give local, slurm, sbatch or parallel' cluster box.yaml out --profile pbs
refused 2 'give a whole number above 0' cluster box.yaml out --jobs none
[[ ! -e out ]] || wrong "something was written"
refused 2 'cluster.py run FOLDER JOB' "$py"
refused 2 'no such command; did you mean "publish"?' "$py" publsh

# A site without Slurm, and one without Snakemake: a PATH that lacks them.
mkdir bin
for program in bash env python3 dirname realpath awk sed grep cat flock jq; do ln -s "$(command -v "$program")" bin/; done
for program in "${PATH%%:*}"/phos-*; do ln -s "$program" bin/; done
refused 3 'sbatch: not installed (Debian: pipelines/install.sh --cluster, or apt-get install slurm-wlm munge' env PATH="$scratch/bin" "$project/pipelines/cluster.sh" box.yaml out --profile slurm
refused 3 'snakemake: not installed (Debian: pipelines/install.sh --cluster' env PATH="$scratch/bin" "$project/pipelines/cluster.sh" box.yaml out --profile local

echo "--- shards"
"$py" plan box.yaml shards >/dev/null
mapfile -t names < <("$py" list box.yaml shards --stage photons)
merge=$("$py" list box.yaml shards --stage merge | grep photons)
refused 3 "needs ${names[0]}, which is missing" "$py" run shards "$merge"
"$py" run shards "${names[@]:0:3}"
refused 3 "needs ${names[3]}, which is missing" "$py" run shards "$merge"
cp "shards/store/${names[0]}" "shards/store/${names[3]}" # a shard twice
refused 4 'give each once' "$py" run shards "$merge"
phos-photons "$project/data/cornell-empty.glb" --photons 999 --caustic-photons 0 --shard 4/4 --quiet -o "shards/store/${names[3]}" # of another run
refused 4 'is of another run' "$py" run shards "$merge"
refused 4 'missing shard 4/4 of the run' phos-merge "shards/store/${names[0]}" "shards/store/${names[1]}" "shards/store/${names[2]}" -o none.photons
rm "shards/store/${names[3]}"
"$py" run shards "${names[3]}" "$merge"
same "shards/store/$merge" truth/box.photons

echo "--- options from files, and several files in one option"
mkdir site
cp "$project"/data/luminaires/* site/
lamps=(site/*)
printf '# what the scene stands under\nluminaire = a=%s,b=%s\nluminaires-as points\n' "${lamps[0]}" "${lamps[1]}" >site.opts
sed "s|^scenes:.*|scenes: {box: {file: $project/data/cornell-empty.glb, options: '@site.opts'}}|" box.yaml >site.yaml
"$py" plan site.yaml site-run >/dev/null
first=$("$py" list site.yaml site-run --stage photons | head -1)
"$py" command site-run "$first" | grep -qF -- "--luminaire a=$scratch/${lamps[0]},b=$scratch/${lamps[1]} --luminaires-as points" || wrong "options from a file: $("$py" command site-run "$first")"
for lamp in "${lamps[0]}" "${lamps[1]}"; do
  echo >>"$lamp"
  [[ $("$py" list site.yaml site-run --stage photons | head -1) != "$first" ]] || wrong "$lamp: other content, and the same key"
done
sed 's/@site.opts/@none.opts/' site.yaml >bad.yaml
refused 3 'none.opts: No such file' cluster bad.yaml out

echo "--- a job that ends without its file"
mkdir liar
printf '#!/bin/sh\n[ "$1" != --options-json ] || exec %s "$@"\n' "$(command -v phos-splat)" >liar/phos-splat
chmod +x liar/phos-splat
(
  PATH=$scratch/liar:$PATH
  refused 3 'phos-splat ended with code 0 and without its file' cluster box.yaml parallel --profile local
  refused 3 'ended with code 0 and without its file' "$py" run parallel "$("$py" list box.yaml parallel)"
  exit $failed
) || failed=1

echo "--- a year"
sed 's|^cameras|conditions: {year: {options: --sky clear, times: {from: "2026-03-21T00:00+01:00", to: "2026-03-22T23:00+01:00", hours: 5-9, location: "52.5,13.4"}}}\n&|' box.yaml >year.yaml
[[ $("$py" check year.yaml) == *"results: 12" ]] || wrong "two days of March have hours 7, 8 and 9 by day: $("$py" check year.yaml)"
((failed)) || echo "all results have the bytes of one run, and all bad input is refused"
exit $failed
