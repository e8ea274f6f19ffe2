#!/usr/bin/env bash
# Films, sensor grids and pictures by two nodes of a real Slurm, which the test starts and stops: byte for byte as one run makes them; and after a node
# has died, a disk was full, or an array was cancelled, resumed to the same bytes, with nothing done twice but what was lost.
#   tests/pipelines/cluster/slurm.sh [FOLDER-OF-PROGRAMS] [--sensors N]     N: about how many sensors (10000)
# Code 77: Slurm or Snakemake is not installed, or cannot run here.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
source "$(dirname "${BASH_SOURCE[0]}")/site.sh"
sensors=10000
[[ ${2:-} != --sensors ]] || sensors=$3
command -v snakemake >/dev/null || { echo "skipped: snakemake is not installed (pipelines/install.sh --cluster)"; exit 77; }

step() { echo "--- $* ($SECONDS s)"; }
scratch=$(mktemp -d /var/tmp/phos-cluster.XXXXXX)
finish() {
  local code=$?
  site_stop
  umount "$scratch/disk" 2>/dev/null || true
  local left i number
  for ((i = 0; i < 40; ++i)); do  # what was killed takes a moment to go
    left=''
    for number in $(grep -lzF -f <(echo "$scratch") /proc/[0-9]*/environ /proc/[0-9]*/cmdline 2>/dev/null | cut -d/ -f3); do
      ((number == $$)) || ! kill -0 "$number" 2>/dev/null || left+=" $number"  # grep itself is gone
    done
    [[ -n $left ]] || break
    sleep 0.25
  done
  [[ -z $left ]] || { echo "FAILED: left running:$left: $(tr '\0' ' ' <"/proc/${left##* }/cmdline")" >&2; code=1; }
  rm -rf "$scratch"
  exit $code
}
trap finish EXIT
trap "exit 143" HUP INT TERM  # ends by finish too
export CI=true  # Snakemake then looks for ended jobs every second, not every ten
site_start "$scratch/site"
cd "$scratch"

side=$(awk -v n="$sensors" 'BEGIN { s = int(sqrt(n)); print s * s < n ? s + 1 : s }')
make_points "$side" >points.csv
photons=400000
make_configuration box.yaml $photons
make_film_configuration film.yaml
make_truth truth $photons

# wait_for SECONDS COMMAND...: until it succeeds.
wait_for() {
  local i tries=$(($1 * 4))
  shift
  for ((i = 0; i < tries; ++i)); do
    if "$@" >/dev/null 2>&1; then return; fi
    sleep 0.25
  done
  wrong "not so after $((tries / 4)) s: $*"
}
stored() { (($(find "$1/store/$2" -type f -not -name '.*' 2>/dev/null | wc -l) >= $3)); }
# runs_on NODE: does a program of phos run there?
runs_on() {
  local number
  for number in $(site_processes "$1"); do
    [[ $(cat "/proc/$number/comm" 2>/dev/null) != phos-* ]] || return 0
  done
  return 1
}
idle() { [[ -z $(squeue --noheader) ]]; }
stamps() { find "$1/store" -type f -printf '%P %i %s\n' | sort; }

step "two nodes, by Snakemake"
cluster box.yaml snake --profile slurm
check_results snake truth
once snake
for node in node1 node2; do grep -q ",$node," snake/log/jobs.csv || wrong "snake: nothing ran on $node"; done
cluster film.yaml film --profile slurm
for frame in 0 1 2 3 4 5; do same "film/results/cube/plain/default/film-front/000$frame.exr" "truth/film/000$frame.exr"; done
once film

step "dates change nothing"
stamps snake >before
find snake -exec touch {} +
touch points.csv
cluster box.yaml snake --profile slurm
stamps snake | cmp - before || wrong "touch: files were made anew"

step "two nodes, by array jobs; a node dies"
# phos-photons that waits on node2, so that it cannot end before its node
mkdir held
printf '#!/bin/sh\nwhile [ "$SLURMD_NODENAME" = node2 ] && [ -e %s/hold ]; do sleep 0.1; done\nexec %s "$@"\n' "$scratch" "$(command -v phos-photons)" >held/phos-photons
chmod +x held/phos-photons
free=$PATH PATH=$scratch/held:$PATH
touch hold
cluster box.yaml dies --profile sbatch
wait_for 120 runs_on node2
site_kill node2
rm hold
scontrol update nodename=node2 state=down reason=test
refused 3 "still in Slurm's queue" cluster box.yaml dies --profile sbatch
site_node node2
scontrol update nodename=node2 state=resume
# Slurm lets jobs of dead nodes wait for two minutes
for job in $(squeue --noheader --states=PD --format=%i); do scontrol update jobid="$job" starttime=now 2>/dev/null || true; done
wait_for 300 idle
cluster box.yaml dies --profile sbatch --wait yes
check_results dies truth
once dies
PATH=$free
grep -c '^\$ ' -r dies/log/*/ | grep -q ':2$' || wrong "dies: no job was lost with its node"

step "an array is cancelled"
cluster box.yaml cancelled --profile sbatch
wait_for 120 stored cancelled photons 1
scancel --name="phos-$(<cancelled/.shared)"
wait_for 60 idle
stamps cancelled >before
[[ ! -e cancelled/results/results.csv ]] || wrong "cancelled: was not cancelled in time"
[[ -z $(find cancelled/store/sense -type f 2>/dev/null) ]] || wrong "cancelled: little was left to do"
cluster box.yaml cancelled --profile sbatch --wait yes
check_results cancelled truth
stamps cancelled | comm -23 before - >lost
[[ ! -s lost ]] || wrong "cancelled: made anew: $(cat lost)"
once cancelled

step "the disk is full"
mkdir disk
if mount -t tmpfs -o size=16m tmpfs disk 2>/dev/null; then
  refused 3 "No space left" cluster box.yaml disk --profile slurm
  stamps disk >before
  [[ -s before ]] || wrong "disk: nothing was made before it was full"
  mount -o remount,size=500m disk
  cluster box.yaml disk --profile slurm
  check_results disk truth
  stamps disk | comm -23 before - >lost
  [[ ! -s lost ]] || wrong "disk: made anew: $(cat lost)"
  once disk
else
  echo "skipped: no tmpfs can be mounted here"
fi

step "a folder that a node does not see"
site_kill node1
site_kill node2
mkdir alone
if unshare --mount true 2>/dev/null; then
  for node in node1 node2; do unshare --mount sh -c "mount -t tmpfs tmpfs '$scratch/alone' && slurmd -N $node"; done
  for node in node1 node2; do scontrol update nodename=$node state=down reason=test; scontrol update nodename=$node state=resume; done
  wait_for 60 sh -c '[ "$(sinfo --noheader --format=%T --Node | sort -u)" = idle ]'
  refused 3 "is not shared: node node" cluster box.yaml alone --profile sbatch
else
  echo "skipped: no namespace can be made here"
fi

step "the controller does not answer"
kill "$(<site/slurmctld.pid)"
wait_for 20 sh -c "! kill -0 $(<site/slurmctld.pid)"
refused 3 "does not answer" cluster box.yaml unanswered --profile sbatch
((failed)) || echo "all results have the bytes of one run"
exit $failed
