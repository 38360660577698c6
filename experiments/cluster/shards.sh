#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Does shards FIRST to LAST of N, one after the other, and goes on where an earlier try was ended.
# slurm.sh and local.sh start it; by hand it works as well.
#   shards.sh FIRST LAST N THREADS -- reference SCENE --photons P --out FILE.exr
#   shards.sh FIRST LAST N THREADS -- experiment run SPEC.toml --out FOLDER
# and, once all are done,
#   shards.sh merge N -- (the same)
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
# shellcheck source=command.sh
source "$root/experiments/cluster/command.sh"

if [[ ${1:-} == merge && ${3:-} == -- ]]; then
    read_command "${@:4}"
    merge_all "$2"
    exit
fi
(($# > 5)) && [[ $5 == -- ]] || fail "FIRST LAST N THREADS -- COMMAND…"
first=$1 last=$2 count=$3 threads=$4
shift 5
read_command "$@"

# A task that is told to end must not begin with the next shard.
ended=
trap 'ended=yes' TERM INT
status=0
for ((shard = first; shard <= last && shard <= count; ++shard)); do
    # One that fails does not keep the others from being done.
    do_shard "$shard" "$count" "$threads" || status=$?
    [[ -z $ended ]] || exit 1
done
exit "$status"
