#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A reference and a study on a real Slurm of two nodes, one of which is killed in the middle: the
# merged reference is that of a single process to the bit. Needs root and the packages that
# experiments/install_packages.sh --cluster installs; else it is skipped, with exit code 77.
#   slurm_test.sh KAUSTIK
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
KAUSTIK=$(realpath "$1")
export KAUSTIK
# shellcheck source=slurm_daemons.sh
source "$here/slurm_daemons.sh"

skip() {
    echo "skipped: $1"
    exit 77
}
((EUID == 0)) || skip "only root can start Slurm's daemons"
for program in munged slurmctld slurmd sbatch; do
    command -v "$program" > /dev/null ||
        skip "there is no $program; experiments/install_packages.sh --cluster installs it"
done

folder=$(mktemp --directory /tmp/kaustik-slurm-XXXXXX)
leave() {
    local status=$?
    end_slurm
    if ((status != 0)); then
        tail -n 20 "$folder"/slurm/*.log "$folder"/*/logs/* 2> /dev/null || true
    fi
    rm -rf "$folder"
    exit "$status"
}
slurm=$folder/slurm
trap leave EXIT
trap 'exit 1' INT TERM

expect() {
    "${@:2}" || {
        echo "slurm_test: $1" >&2
        exit 1
    }
}
step() { printf '%3d s: %s\n' "$SECONDS" "$1"; }
job_of() { sed -n 's/^job \([0-9]*\):.*/\1/p' <<< "$1"; }
merge_of() { sed -n 's/.*; job \([0-9]*\) merges.*/\1/p' <<< "$1"; }
no_jobs_are_left() { [[ -z $(squeue --noheader) ]]; }

cd "$folder"
mkdir slurm
# What a reference is but for its time and its file's name: fingerprints of all images are in it.
facts() { python3 -B "$here/facts.py" "$1"; }

step "the undivided reference"
reference=(reference flat-water --size 64x48 --photons 24000000)
KAUSTIK_CACHE=$folder/cache "$KAUSTIK" "${reference[@]}" --threads 1 --out whole.exr

step "Slurm starts"
start_slurm "$slurm"

step "the same on two nodes"
said=$("$root/experiments/cluster/slurm.sh" --shards 8 --per-task 2 -- \
    "${reference[@]}" --out cluster.exr)
echo "$said"
job=$(job_of "$said")
node_two_computes() {
    local process
    for process in $(processes_with "SLURM_CONF=$SLURM_CONF" SLURMD_NODENAME=two \
        "SLURM_ARRAY_JOB_ID=$job"); do
        [[ $(cat "/proc/$process/comm" 2> /dev/null) != kaustik ]] || return 0
    done
    return 1
}
wait_until node_two_computes
lost=$(squeue --noheader --states=RUNNING --nodelist=two --format=%i)
kill_node two
step "node two is killed with task $lost"
expect "the task was done before it could be lost" test ! -e cluster.shards/4-of-8.shard
node_two_is_down() { sinfo --noheader --nodes=two --format=%T | grep -q down; }
wait_until node_two_is_down
step "Slurm has noticed"
scontrol show job "$lost" > lost.txt
expect "the task of the dead node is not requeued" grep -q 'Requeue=1 Restarts=1' lost.txt
start_node two
wait_until no_jobs_are_left
step "all jobs have ended"
expect "the task that was lost has not begun again" grep -q 'start 2' cluster.shards/logs/*
expect "there is no merged reference" test -e cluster.exr
expect "the merged reference is another" diff <(facts whole.json) <(facts cluster.json)

step "a study whose times count"
cat > study.toml << 'END'
name = "cluster"
repeats = 2
[base]
scene = "flat-water"
size = "32x24"
frames = 1
warmup = 0
"emit.photons" = "16x16"
"shadow.map.size" = 64
[permute]
"layers.count" = [1, 2]
END
said=$("$root/experiments/cluster/slurm.sh" --shards 2 --timing -- \
    experiment run study.toml --out study)
expect "its tasks do not ask for a whole node" \
    grep -q 'OverSubscribe=NO' <(scontrol show job "$(job_of "$said")")
wait_until no_jobs_are_left
expect "its results are not merged" test -s study/runs.csv
expect "its runs are not all there" test "$(grep -c ',done,' study/runs.csv)" -eq 4
step "done"
