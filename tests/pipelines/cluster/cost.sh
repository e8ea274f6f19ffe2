#!/usr/bin/env bash
# The cost model of runs on many machines: predictions from costs that are written down here follow by hand; a finished run is compared; bad input is refused.
#   tests/pipelines/cluster/cost.sh [FOLDER-OF-PROGRAMS]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
command -v python3 >/dev/null || { echo "skipped: python3 is not installed (pipelines/install.sh --cluster)"; exit 77; }
export PYTHONDONTWRITEBYTECODE=1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
cost=$project/pipelines/cluster/cost.py
# A path costs 1 us and a stored photon 40 bytes; a sensor's ray costs 1 us; all else costs nothing, or fixed seconds.
cat >costs.json <<'END'
{"stored_per_path": 1,
 "photons": {"seconds": {"fixed": 0, "each": 1e-6}, "memory": {"fixed": 0, "each": 100}, "bytes": {"fixed": 0, "each": 40}},
 "merge_photons": {"seconds": {"fixed": 3, "each": 0}, "memory": {"fixed": 0, "each": 100}, "bytes": {"fixed": 0, "each": 50}},
 "merge_on_disk": {"seconds": {"fixed": 7, "each": 0}, "memory": {"fixed": 0, "each": 0}},
 "tree": {"seconds": {"fixed": 0, "each": 0}, "memory": {"fixed": 0, "each": 100}},
 "source": {"seconds": {"fixed": 5, "each": 0}, "memory": {"fixed": 0, "each": 0}, "bytes": {"fixed": 0, "each": 0}},
 "sensors": {"seconds": {"fixed": 0, "each": 1e-6}, "memory": {"fixed": 0, "each": 1}, "bytes": {"fixed": 0, "each": 0}},
 "merge_sensors": {"seconds": {"fixed": 2, "each": 0}, "memory": {"fixed": 0, "each": 0}, "bytes": {"fixed": 0, "each": 1}},
 "read": {"seconds": {"fixed": 0, "each": 1e-3}, "memory": {"fixed": 0, "each": 0}}}
END
# is NAME VALUE ROW: the column NAME of a row of the last table.
is() {
  local got
  got=$(awk -F, -v name="$1" -v row="$3" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) c = i } NR == row + 1 { print $c }' table)
  [[ $got == "$2" ]] || wrong "$1 of row $3 is $got, not $2: $(cat table)"
}
"$cost" predict costs.json --photons 1e8 --nodes 1,10 --sensors 1000 --rays 1000 --start 0 --node-MBps 1e9 --disk-MBps 1e9 >table
is photons_s 100.0 1; is source_s 5.0 1; is sensors_s 1.0 1; is read_s 1.0 1; is seconds 107.0 1; is speedup 1.00 1
is photons_s 10.0 2; is merge_photons_s 3.0 2; is sensors_s 0.1 2; is merge_sensors_s 2.0 2; is read_s 0.1 2; is seconds 20.2 2; is speedup 5.30 2
is merge_share 0.248 2; is peak_GB 10.00 2; is peak_stage merge_photons 2; is breaks '' 2
# Ten nodes of 4 GB: the merge sorts on disk. A node that reads 1 GB/s reads the shards (4 GB) for them.
"$cost" predict costs.json --photons 1e8 --nodes 10 --sensors 0 --start 1 --memory 4 --node-MBps 1e9 --disk-MBps 1e9 >table
is merge_photons_s 8.0 1; is peak_GB 4.00 1; is breaks '' 1; is seconds 19.0 1
"$cost" predict costs.json --photons 1e8 --nodes 1 --sensors 0 --memory 4 >table
is breaks photons 1
"$cost" predict costs.json --photons 1e10 --nodes 100 --sensors 0 >table
is breaks 'one map holds too few photons' 1
"$cost" predict costs.json >table
[[ $(wc -l <table) == 21 ]] || wrong "not 5 numbers of photons x 4 of nodes: $(cat table)"

# A run of two shards and their merge.
mkdir -p run/jobs/photons run/jobs/merge run/log
for i in 1 2; do echo "{\"command\": [\"phos-photons\", \"--photons\", \"4000000\", \"--shard\", \"$i/2\"], \"memory\": 2048}" >"run/jobs/photons/$i.photons.json"; done
echo '{"command": ["phos-merge"], "memory": 2048}' >run/jobs/merge/m.photons.json
cat >run/log/jobs.csv <<'END'
job,host,seconds,cpu_seconds,peak_MB,bytes_read,bytes_written,code,start
photons/1.photons,a,9,2.5,190,0,80000000,0,0
photons/2.photons,b,9,1,1,0,0,3,0
photons/2.photons,b,9,2.5,190,0,80000000,0,0
merge/m.photons,a,9,3,400,160000000,200000000,0,0
END
"$cost" compare costs.json run >table
is jobs 2 1; is measured_s 5.00 1; is predicted_s 4.00 1; is ratio 0.80 1; is predicted_MB 200 1
is stage merge_photons 2; is predicted_s 3.00 2; is predicted_MB 400 2; is stage all 3; is predicted_s 7.00 3
sed -i 's/2048/300/' run/jobs/merge/m.photons.json # more than three quarters of it hold
"$cost" compare costs.json run >table
is stage merge_on_disk 2; is predicted_s 7.00 2

refused 2 'no such option; did you mean "nodes"?' "$cost" predict costs.json --node 3
refused 2 'give numbers of at least 1, comma by comma' "$cost" predict costs.json --photons 0,5
refused 2 'give a value' "$cost" predict costs.json --rays
refused 3 'none.json: No such file' "$cost" predict none.json
echo '{}' >empty.json
refused 3 'holds no costs; make it with  cost.py measure' "$cost" predict empty.json
refused 3 'is that of a finished pipelines/cluster.sh' "$cost" compare costs.json nowhere
refused 3 'none.glb: no such file' "$cost" measure none.glb costs.json
printf 'x,y\n1,2\n' >two.csv
printf 'x,y,z,nx,ny,nz\n0,0,0,0,1,0\n1,0,0,0,1,0\n' >few.csv
refused 3 'needs the columns x,y,z,nx,ny,nz' "$cost" measure "$project/data/cornell-empty.glb" costs.json --points two.csv
refused 3 '2 sensors are too few' "$cost" measure "$project/data/cornell-empty.glb" costs.json --points few.csv
refused 2 'give measure SCENE FILE, predict FILE or compare FILE FOLDER' "$cost" foretell
refused 2 'too few' "$cost" measure "$project/data/cornell-empty.glb" tiny.json --paths 4000
[[ ! -e tiny.json ]] || wrong "costs were written"
((failed)) || echo "predictions follow from the costs, and all bad input is refused"
exit $failed
