#!/usr/bin/env bash
# A sensor grid by one node and by two nodes of a Slurm that this script starts and stops: seconds, their ratio, the same bytes; and the cost model's
# prediction beside each run.
#   tests/bench/cluster/two-nodes.sh [FOLDER-OF-PROGRAMS] [--sensors N] [--rays N] [--paths N] [--parts N] [--costs FILE]
# --sensors 20000, --rays 256, --paths 1000000, --parts 8. --costs: of pipelines/cluster/cost.py measure --points, of
# data/cornell-measured.glb and these sensors.
set -euo pipefail
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
source "$project/pipelines/common.sh"
source "$project/tests/pipelines/cluster/site.sh"
PATH=${1:-$project/build/release/bin}:$PATH
sensors=20000 rays=256 paths=1000000 parts=8 costs=''
(($# == 0)) || take_all_options "sensors rays paths parts costs" "${@:2}"
[[ -z $costs ]] || costs=$(realpath "$costs")
scratch=$(mktemp -d /var/tmp/phos-two-nodes.XXXXXX)
trap 'site_stop; rm -rf "$scratch"' EXIT
trap 'exit 143' HUP INT TERM
site_start "$scratch/site"
cd "$scratch"
awk -v n="$sensors" 'BEGIN {
  print "x,y,z,nx,ny,nz"; s = int(sqrt(n))
  for (i = 0; i < s; ++i) for (j = 0; j < s; ++j) printf "%.6f,0.45,%.6f,0,1,0\n", 0.05 + 0.45 * i / s, 0.05 + 0.45 * j / s
}' >points.csv
cat >grid.yaml <<END
scenes: {box: $project/data/cornell-measured.glb}
settings: {all: {photons: --photons $paths --caustic-photons 0, shards: $parts}}
grids: {desk: {points: $scratch/points.csv, source: --place surface --accuracy 0.3, irradiance: --estimate gather --rays $rays, parts: $parts}}
END
echo "nodes,seconds"
for nodes in 1 2; do
  scontrol update nodename=node2 state="$([[ $nodes == 1 ]] && echo drain || echo resume)" reason=bench
  begin=$(date +%s.%N)
  "$project/pipelines/cluster.sh" grid.yaml "by-$nodes" --profile sbatch --wait yes >said 2>&1 || { cat said >&2; exit 1; }
  awk "BEGIN { printf \"%d,%.1f\n\", $nodes, $(date +%s.%N) - $begin }" | tee -a times
  [[ -z $costs ]] || "$project/pipelines/cluster/cost.py" compare "$costs" "by-$nodes"
done
awk -F, 'NR == 1 { one = $2 } END { printf "two nodes are %.2f times as fast as one\n", one / $2 }' times
cmp by-1/results/box/plain/all/desk.csv by-2/results/box/plain/all/desk.csv
