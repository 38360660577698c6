# SPDX-License-Identifier: MIT
# Slurm with two nodes on this host, in a folder of its own: munged, slurmctld and two slurmd, with
# a key, sockets and ports that no other Slurm here has. start_slurm FOLDER, kill_node NAME and
# end_slurm. All its processes have SLURM_CONF in their environment, by which they are found.

free_port() {
    python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'
}

# What runs with all of the given entries in its environment, but for what this shell has started
# itself.
processes_with() {
    local environment process entry
    for environment in /proc/[0-9]*/environ; do
        process=${environment//[^0-9]/}
        [[ $process != "$$" ]] || continue
        for entry in "$@"; do
            grep -qzxF -- "$entry" "$environment" 2> /dev/null || continue 2
        done
        echo "$process"
    done
}

# Until the condition holds. What has hung is given up, long after anything that works.
wait_until() {
    local since=$SECONDS
    until "$@"; do
        if ((SECONDS - since > 600)); then
            echo "slurm_test: it has hung, waiting until $*" >&2
            return 1
        fi
        sleep 0.2
    done
}

# A daemon that ends with this shell, however that ends.
daemon() {
    setpriv --pdeathsig KILL "$@" > /dev/null 2>&1 &
    disown
}

start_node() {
    mkdir -p "$slurm/spool.$1"
    SLURMD_NODENAME=$1 daemon slurmd -D -N "$1" -f "$SLURM_CONF"
}

start_slurm() {
    slurm=$1
    unset "${!SLURM_@}" "${!SBATCH_@}" # of a job that this may be part of
    local host
    host=$(hostname --short)
    chmod 755 "$slurm"
    head --bytes 128 /dev/urandom > "$slurm/munge.key"
    chmod 400 "$slurm/munge.key"
    # cred_expire is also how long a requeued job waits, by default two minutes.
    cat > "$slurm/slurm.conf" << END
ClusterName=kaustik
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$(free_port)
SlurmUser=root
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket=$slurm/munge.socket,cred_expire=5
StateSaveLocation=$slurm/state
SlurmctldPidFile=$slurm/slurmctld.pid
SlurmctldLogFile=$slurm/slurmctld.log
SlurmdPidFile=$slurm/slurmd.%n.pid
SlurmdLogFile=$slurm/slurmd.%n.log
SlurmdSpoolDir=$slurm/spool.%n
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/builtin
SchedulerParameters=sched_interval=2
SlurmdTimeout=10
MessageTimeout=5
KillWait=2
ReturnToService=2
NodeName=one NodeHostname=$host NodeAddr=127.0.0.1 Port=$(free_port) CPUs=1
NodeName=two NodeHostname=$host NodeAddr=127.0.0.1 Port=$(free_port) CPUs=1
PartitionName=all Nodes=one,two Default=YES OverSubscribe=NO
END
    export SLURM_CONF=$slurm/slurm.conf
    mkdir -p "$slurm/state"
    daemon munged --foreground --force --key-file="$slurm/munge.key" \
        --socket="$slurm/munge.socket" --pid-file="$slurm/munged.pid" --seed-file="$slurm/munged.seed"
    wait_until test -S "$slurm/munge.socket"
    daemon slurmctld -D -f "$SLURM_CONF"
    start_node one
    start_node two
    wait_until nodes_are_idle
}

nodes_are_idle() {
    [[ $(sinfo --noheader --Node --format=%T 2> /dev/null | sort -u) == idle ]]
}

# Those that have started a process, the last first; not the first of all.
ancestors_of() {
    local parent
    parent=$(ps --no-headers --format ppid= --pid "$1" | tr -d ' ')
    [[ -n $parent ]] && ((parent > 1)) || return 0
    echo "$parent"
    ancestors_of "$parent"
}

# As if its plug were pulled: the daemon and all that it has started are gone before any of them can
# say so. What slurmstepd has in its environment is not known, but it is above a job's processes.
kill_node() {
    local found above=()
    found=$(processes_with "SLURM_CONF=$slurm/slurm.conf" "SLURMD_NODENAME=$1")
    for process in $(processes_with "SLURM_CONF=$slurm/slurm.conf" "SLURMD_NODENAME=$1" \
        SLURM_PROCID=0); do
        above+=($(ancestors_of "$process"))
    done
    kill -KILL "${above[@]}" $found 2> /dev/null || true
}

end_slurm() {
    local found
    # Twice, for what was just being started.
    for _ in 1 2; do
        found=$(processes_with "SLURM_CONF=$slurm/slurm.conf")
        [[ -z $found ]] || kill -KILL $found 2> /dev/null || true
        sleep 0.2
    done
}
