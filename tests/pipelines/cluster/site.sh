#!/usr/bin/env bash
# A site of Slurm on this machine alone, for tests: munge, slurmctld and two slurmd on loopback, with ports and files of their own.
#   source site.sh; site_start FOLDER; ...; site_stop
# site_start ends with code 77 where Slurm is not installed, or cannot run here. site_stop ends all that it started; give it to `trap ... EXIT`.
# shellcheck disable=SC2034  # variables of the sourcing script

site_missing() {
  local program
  for program in munged slurmctld slurmd sbatch srun scontrol; do
    PATH=$PATH:/usr/sbin command -v "$program" >/dev/null || { echo "$program is not installed (pipelines/install.sh --cluster)"; return; }
  done
  ((EUID == 0)) || echo "slurmd needs root"
}

# Ports that nobody listens on: three in a row.
site_ports() {
  local port
  for ((port = 21000 + RANDOM % 20000; ; port += 3)); do
    if ! grep -qE ":$(printf '%04X|:%04X|:%04X' "$port" $((port + 1)) $((port + 2))) " /proc/net/tcp; then echo "$port"; return; fi
  done
}

site_start() {
  site=$1
  PATH=$PATH:/usr/sbin
  local why
  why=$(site_missing)
  [[ -z $why ]] || { echo "skipped: $why"; exit 77; }
  local port cores host
  port=$(site_ports) cores=$(nproc) host=$(hostname -s)
  mkdir -p "$site"/{ctl,node1,node2}
  chmod 755 "$site"
  # munge with a key and a socket of its own; its folder must belong to root and be closed to others
  (umask 077; head -c 1024 /dev/urandom >"$site/munge.key")
  cat >"$site/slurm.conf" <<END
ClusterName=phos-test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$site/munge.socket
CredType=cred/munge
StateSaveLocation=$site/ctl
SlurmdSpoolDir=$site/%n
SlurmctldPidFile=$site/slurmctld.pid
SlurmdPidFile=$site/%n.pid
SlurmctldLogFile=$site/slurmctld.log
SlurmdLogFile=$site/%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
JobRequeue=1
ReturnToService=2
SlurmdTimeout=10
SlurmctldTimeout=10
InactiveLimit=0
KillWait=2
BatchStartTimeout=10
SchedulerParameters=sched_interval=2,bf_interval=2,sched_min_interval=100000
NodeName=node[1-2] NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 1))-$((port + 2)) CPUs=1 RealMemory=4096
PartitionName=all Nodes=node[1-2] Default=YES MaxTime=INFINITE State=UP
END
  echo "CgroupPlugin=$([[ -d /sys/fs/cgroup/memory ]] && echo cgroup/v1 || echo autodetect)" >"$site/cgroup.conf"
  export SLURM_CONF=$site/slurm.conf
  munged --force --key-file="$site/munge.key" --socket="$site/munge.socket" --pid-file="$site/munged.pid" --log-file="$site/munged.log" \
    --seed-file="$site/munge.seed" --num-threads=2 || { echo "skipped: munged does not run here: $(tail -1 "$site/munged.log")"; exit 77; }
  slurmctld -c || { echo "slurmctld: $(tail -1 "$site/slurmctld.log")" >&2; exit 1; }
  site_node node1
  site_node node2
  local i
  for ((i = 0; i < 120; ++i)); do
    [[ $(sinfo --noheader --format=%T --Node 2>/dev/null | sort -u) != idle ]] || return 0
    sleep 0.5
  done
  echo "the nodes do not come up: $(tail -2 "$site"/*.log)" >&2
  exit 1
}

# site_node NAME: starts its slurmd.
site_node() { slurmd -N "$1" || { echo "slurmd $1: $(tail -1 "$site/$1.log")" >&2; exit 1; }; }

# site_kill NODE: the node dies: its slurmd, the jobs' stewards and the jobs themselves.
site_kill() {
  local victims
  victims=$(site_processes "$1")
  # shellcheck disable=SC2086  # several numbers
  [[ -z $victims ]] || kill -9 $victims 2>/dev/null || true
}

# Numbers of the processes of a node: slurmd, its stewards, and what runs with SLURMD_NODENAME of it under this site's configuration.
site_processes() {
  local number
  [[ ! -s $site/$1.pid ]] || cat "$site/$1.pid"
  for number in $(grep -lzxF "SLURM_CONF=$SLURM_CONF" /proc/[0-9]*/environ 2>/dev/null | cut -d/ -f3); do
    if grep -qzxF "SLURMD_NODENAME=$1" "/proc/$number/environ" 2>/dev/null; then
      echo "$number"
      local parent
      parent=$(awk '{ sub(/.*\) /, ""); print $2 }' "/proc/$number/stat" 2>/dev/null) || continue
      [[ $(cat "/proc/$parent/comm" 2>/dev/null) != slurmstepd ]] || echo "$parent"
    fi
  done | sort -u
}

site_stop() {
  [[ -n ${site:-} && -f $site/slurm.conf ]] || return 0
  local i file number
  if [[ -s $site/slurmctld.pid ]] && kill -0 "$(<"$site/slurmctld.pid")" 2>/dev/null; then
    scancel --quiet --full --user=root 2>/dev/null || true
    for ((i = 0; i < 20; ++i)); do
      [[ -n $(squeue --noheader 2>/dev/null) ]] || break
      sleep 0.5
    done
  fi
  site_kill node1
  site_kill node2
  for file in slurmctld munged; do
    [[ -s $site/$file.pid ]] || continue
    number=$(<"$site/$file.pid")
    kill "$number" 2>/dev/null || continue
    for ((i = 0; i < 40; ++i)); do
      kill -0 "$number" 2>/dev/null || break
      sleep 0.25
    done
    kill -9 "$number" 2>/dev/null || true
  done
}
