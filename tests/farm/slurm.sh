#!/usr/bin/env bash
# slurm.sh start DIR: a Slurm of this one machine, without systemd; then export SLURM_CONF=DIR/slurm.conf.
# slurm.sh stop DIR: ends it. Needs Debian's slurm-wlm and munge, and root. Listens on 127.0.0.1 alone.
set -euo pipefail
dir=$(mkdir -p "$2" && cd "$2" && pwd)
if [ "$1" = stop ]; then
    kill "$(cat "$dir/ctld.pid")" "$(cat "$dir/d.pid")"
    exit
fi
host=$(hostname -s)
mkdir -p "$dir"/{state,spool,log}
cat >"$dir/slurm.conf" <<CONF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/spool
SlurmctldPidFile=$dir/ctld.pid
SlurmdPidFile=$dir/d.pid
SlurmctldLogFile=$dir/log/ctld.log
SlurmdLogFile=$dir/log/d.log
SlurmctldPort=16817
SlurmdPort=16818
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
ReturnToService=2
MpiDefault=none
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) RealMemory=1000 State=UNKNOWN
PartitionName=p Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF
if ! munge -n >/dev/null 2>&1; then
    mkdir -p /run/munge
    chown munge /run/munge
    runuser -u munge -- munged
fi
export SLURM_CONF=$dir/slurm.conf
slurmctld
slurmd
for _ in $(seq 30); do
    if sinfo -h -o %t | grep -q idle; then exit 0; fi
    sleep 1
done
echo "slurmd did not come up: see $dir/log" >&2
exit 1
