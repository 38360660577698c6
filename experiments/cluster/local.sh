#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Does a reference or a study in shards on this machine, with GNU parallel, and merges them: the
# plan of slurm.sh without a cluster. Started again, it does what is left.
#   local.sh --shards N [--jobs J] -- COMMAND…
# COMMAND is what kaustik would be given to do all at once, with its --out. J shards are done at a
# time: of a reference as many as there are processors, of a study, whose times would be wrong, one.
#   local.sh --shards 8 -- reference pool --photons 1000000000 --out out/pool.exr
#   local.sh --shards 2 -- experiment run experiments/smoke.toml --out out/smoke
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
# shellcheck source=command.sh
source "$root/experiments/cluster/command.sh"

read_options shards "$@"
set -- "${undivided[@]}"
shards=$count
read_command "$@"
processors=$(nproc)
[[ -n $jobs ]] || jobs=$([[ $kind == reference ]] && echo "$processors" || echo 1)
is_whole_number "$jobs" || fail "--jobs: '$jobs' is not a number of shards at a time"
command -v parallel > /dev/null || fail "GNU parallel is not there; experiments/install_packages.sh --cluster installs it"

mkdir -p "$logs"
threads=$((processors > jobs ? processors / jobs : 1))
status=0
# A shard that fails is tried once more; the others go on.
seq "$shards" | parallel --will-cite --quote --jobs "$jobs" --retries 2 --halt never \
    --joblog "$logs/parallel.txt" \
    "$root/experiments/cluster/shards.sh" {} {} "$shards" "$threads" -- "$@" || status=$?
((status == 0)) || echo "local.sh: not all shards were done; $logs/parallel.txt says which" >&2
merge_all "$shards"
