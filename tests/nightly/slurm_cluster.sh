# Sourced by shares_test.sh: a Slurm cluster on one machine (controller, two node daemons, munge
# with its own socket) in one folder. Needs slurm-wlm, munge, and root, because slurmd starts each
# job as its user.
# shellcheck shell=bash

PATH=$PATH:/usr/sbin

slurm_is_here() {
  local program
  for program in slurmctld slurmd sbatch squeue scontrol munged; do
    command -v "$program" >/dev/null || {
      echo "$program is not installed (slurm-wlm, munge)"
      return 1
    }
  done
  [ "$(id -u)" -eq 0 ] || {
    echo "slurmd needs root"
    return 1
  }
}

# Prints the first port from $1 on to which nobody listens.
free_port() {
  local port=$1
  while (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null; do port=$((port + 1)); done
  echo "$port"
}

# start_slurm DIR: starts Slurm, writes slurm.conf into DIR, and exports SLURM_CONF.
start_slurm() {
  local dir=$1 host base
  host=$(hostname -s)
  mkdir -p "$dir"/{state,spooln1,spooln2,munge}
  chmod 700 "$dir/munge"
  dd if=/dev/urandom of="$dir/munge/key" bs=1024 count=1 2>/dev/null
  chmod 400 "$dir/munge/key"
  munged --force --socket="$dir/munge.socket" --key-file="$dir/munge/key" \
    --pid-file="$dir/munged.pid" --log-file="$dir/munge/log" --seed-file="$dir/munge/seed" || return 1
  base=$(free_port $((20000 + RANDOM % 20000)))
  cat >"$dir/slurm.conf" <<CONF
ClusterName=assay
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$base
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$dir/munge.socket
CryptoType=crypto/munge
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/spool%n
SlurmctldPidFile=$dir/slurmctld.pid
SlurmdPidFile=$dir/slurmd-%n.pid
SlurmctldLogFile=$dir/slurmctld.log
SlurmdLogFile=$dir/slurmd-%n.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SwitchType=switch/none
ReturnToService=2
SchedulerParameters=sched_interval=1,batch_sched_delay=0
MinJobAge=300
KillWait=2
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((base + 1)) CPUs=1 State=UNKNOWN
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((base + 2)) CPUs=1 State=UNKNOWN
PartitionName=night Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
CONF
  export SLURM_CONF=$dir/slurm.conf
  slurmctld || return 1
  slurmd -N n1 || return 1
  slurmd -N n2 || return 1
  local waited
  for waited in $(seq 1 60); do
    [ "$(sinfo -h -o %t 2>/dev/null | sort -u)" = idle ] && return 0
    sleep 0.5
  done
  echo "the nodes are not idle after $waited tries:" >&2
  sinfo >&2
  return 1
}

stop_slurm() {
  local dir=$1 file
  scancel --partition=night 2>/dev/null
  scontrol shutdown 2>/dev/null
  for file in "$dir"/slurmctld.pid "$dir"/slurmd-n1.pid "$dir"/slurmd-n2.pid "$dir"/munged.pid; do
    [ -f "$file" ] && kill "$(cat "$file")" 2>/dev/null
  done
  return 0
}
