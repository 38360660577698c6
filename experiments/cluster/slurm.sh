#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Submits a reference or a study to Slurm: an array of tasks that do its shards, requeued where a
# node fails, and a job that merges them at the end. Submitted again, it does what is left.
#   slurm.sh --shards N [--per-task P] [--timing] [options of sbatch…] -- COMMAND…
# COMMAND is what kaustik would be given to do all at once, with its --out:
#   slurm.sh --shards 100 --cpus-per-task=8 -- reference pool --photons 100000000000 --out out/pool.exr
#   slurm.sh --shards 16 --per-task 4 -- experiment run experiments/all_techniques.toml --out out/techniques
# --timing is for studies whose times count: each task has a node to itself. Where that has several
# GPUs, ask for one model: --timing --gres=gpu:a100:1. The folder must be seen by all nodes.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
# shellcheck source=command.sh
source "$root/experiments/cluster/command.sh"

shards= per_task=1 options=()
while (($# > 0)); do
    case $1 in
        -h | --help)
            sed -n '3,12s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
            exit 0
            ;;
        --shards) shards=${2:-} && shift ;;
        --per-task) per_task=${2:-} && shift ;;
        --timing) options+=(--exclusive) ;;
        --)
            shift
            break
            ;;
        -*) options+=("$1") ;;
        *) fail "'$1': options of sbatch are written as --name=value, and the command comes after --" ;;
    esac
    (($# > 0)) && shift
done
is_whole_number "$shards" || fail "--shards: '$shards' is not a number of shards"
is_whole_number "$per_task" || fail "--per-task: '$per_task' is not a number of shards"
read_command "$@"
command -v sbatch > /dev/null || fail "there is no sbatch here; local.sh does the same without a cluster"

mkdir -p "$logs"
tasks=$(((shards + per_task - 1) / per_task))
job=$(sbatch --parsable --array="1-$tasks" --output="$logs/%A_%a.txt" "${options[@]}" \
    "$root/experiments/cluster/array.sbatch" "$root" "$per_task" "$shards" -- "$@")
job=${job%%;*} # a federation adds its cluster's name
# Also where a task has failed: merging says what is missing.
merge=$(sbatch --parsable --dependency="afterany:$job" --job-name=kaustik-merge --requeue \
    --output="$logs/merge_%A.txt" --ntasks=1 \
    --wrap "$(printf '%q ' "$root/experiments/cluster/shards.sh" merge "$shards" -- "$@")")
echo "job $job: $tasks tasks of $per_task shards; job ${merge%%;*} merges them into $out"
echo "what they say is in $logs"
