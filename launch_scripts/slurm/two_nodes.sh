#!/usr/bin/env bash
# A Slurm cluster of two virtual nodes on this host, to try `lukou sweep --slurm` and to test it. Loopback only, no
# accounting database, no cgroups. Needs root and the packages slurm-wlm and munge.
#   launch_scripts/slurm/two_nodes.sh start DIR    starts it; its state and logs stay in DIR; prints what to export
#   launch_scripts/slurm/two_nodes.sh stop DIR     stops it
set -euo pipefail
usage() { sed -n '4,5p' "$0" >&2; exit 2; }
[ $# -eq 2 ] || usage
dir=$(realpath -m "$2")

# Ports of its own, so that several may run: three in a row that nobody listens on.
free_port() {
  local port=$((20000 + RANDOM % 20000))
  while ss -Hltn "( sport >= :$port and sport <= :$((port + 2)) )" | grep -q .; do port=$((20000 + RANDOM % 20000)); done
  echo "$port"
}

ended() { ! kill -0 "$1" 2>/dev/null; }

stop() {
  local file pid
  for file in slurmd.n1.pid slurmd.n2.pid slurmctld.pid munged.pid; do
    [ -f "$dir/$file" ] || continue
    pid=$(cat "$dir/$file")
    kill "$pid" 2>/dev/null || true
    for _ in $(seq 50); do ended "$pid" && break; sleep 0.1; done
    ended "$pid" || kill -9 "$pid" 2>/dev/null || true
    rm -f "$dir/$file"
  done
}

start() {
  [ "$(id -u)" -eq 0 ] || { echo "two_nodes.sh: needs root" >&2; exit 1; }
  for program in munged slurmctld slurmd sbatch; do
    command -v "$program" >/dev/null || { echo "two_nodes.sh: $program is missing; install slurm-wlm and munge" >&2; exit 1; }
  done
  mkdir -p "$dir/ctld" "$dir/d.n1" "$dir/d.n2"
  chmod 755 "$dir"
  # A munge of its own: a key, a socket, run as root; the system's stays alone.
  dd if=/dev/urandom of="$dir/munge.key" bs=128 count=1 status=none
  chmod 400 "$dir/munge.key"
  munged --force --socket="$dir/munge.socket" --key-file="$dir/munge.key" --pid-file="$dir/munged.pid" \
         --log-file="$dir/munged.log" --seed-file="$dir/munge.seed"
  local port
  port=$(free_port)
  cat > "$dir/slurm.conf" <<CONF
ClusterName=lukou
SlurmctldHost=localhost
SlurmctldPort=$port
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$dir/munge.socket
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
StateSaveLocation=$dir/ctld
SlurmdSpoolDir=$dir/d.%n
SlurmctldPidFile=$dir/slurmctld.pid
SlurmdPidFile=$dir/slurmd.%n.pid
SlurmctldLogFile=$dir/slurmctld.log
SlurmdLogFile=$dir/slurmd.%n.log
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MaxArraySize=1001
MinJobAge=300
SchedulerParameters=sched_min_interval=0
SlurmdParameters=config_overrides
NodeName=n1 NodeHostname=localhost NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=1 RealMemory=1000
NodeName=n2 NodeHostname=localhost NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=1 RealMemory=1000
PartitionName=debug Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
CONF
  export SLURM_CONF="$dir/slurm.conf"
  slurmctld -f "$SLURM_CONF" -c
  slurmd -N n1 -f "$SLURM_CONF"
  slurmd -N n2 -f "$SLURM_CONF"
  for _ in $(seq 100); do
    [ "$(sinfo --noheader --Node --states=idle --format=%N 2>/dev/null | wc -l)" -eq 2 ] && break
    sleep 0.2
  done
  if [ "$(sinfo --noheader --Node --states=idle --format=%N 2>/dev/null | wc -l)" -ne 2 ]; then
    echo "two_nodes.sh: the nodes did not come up; see $dir/slurmctld.log" >&2
    stop
    exit 1
  fi
  echo "export SLURM_CONF=$SLURM_CONF"
}

case "$1" in
  start ) start ;;
  stop ) stop ;;
  * ) usage ;;
esac
