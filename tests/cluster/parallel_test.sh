#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# experiments/cluster without a cluster: a reference and a study under GNU parallel, what is left
# when it is ended, and requests that make no sense. Skipped, with exit code 77, where GNU parallel
# is not installed (experiments/install_packages.sh --cluster).
#   parallel_test.sh KAUSTIK
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
KAUSTIK=$(realpath "$1")
export KAUSTIK
if ! command -v parallel > /dev/null; then
    echo "skipped: there is no GNU parallel; experiments/install_packages.sh --cluster installs it"
    exit 77
fi
folder=$(mktemp --directory /tmp/kaustik-parallel-XXXXXX)
trap 'rm -rf "$folder"' EXIT
# A name with a blank is one word all the way.
mkdir "$folder/of a study"
cd "$folder/of a study"

expect() {
    "${@:2}" || {
        echo "parallel_test: $1" >&2
        exit 1
    }
}
facts() { python3 -B "$here/facts.py" "$1"; }
local_sh() { "$root/experiments/cluster/local.sh" "$@"; }
# refuses WHAT COMMAND… : exit code 2, and one line on standard error that names WHAT.
refuses() {
    local status=0
    "${@:2}" 2> refusal.txt || status=$?
    expect "'${*:2}' ends with $status, not 2" test "$status" -eq 2
    expect "'${*:2}' says $(cat refusal.txt)" grep -qF -- "$1" refusal.txt
    expect "'${*:2}' says more than a line" test "$(wc -l < refusal.txt)" -eq 1
}

reference=(reference flat-water --size 32x24 --photons 1500000)
KAUSTIK_CACHE=$folder/cache "$KAUSTIK" "${reference[@]}" --out whole.exr
local_sh --shards 4 --jobs 2 -- "${reference[@]}" --out "in shards.exr"
expect "the merged reference is another" diff <(facts whole.json) <(facts "in shards.json")
# A shard that is lost is done again, and only that.
rm "in shards.shards/2-of-4.shard" "in shards.exr" "in shards.json"
before=$(stat --format=%Y.%i "in shards.shards/1-of-4.shard")
local_sh --shards 4 -- "${reference[@]}" --out="in shards.exr"
expect "a shard that was there is done again" \
    test "$(stat --format=%Y.%i "in shards.shards/1-of-4.shard")" = "$before"
expect "the merged reference is another" diff <(facts whole.json) <(facts "in shards.json")

cat > study.toml << 'END'
name = "parallel"
[base]
scene = "flat-water"
size = "32x24"
frames = 1
warmup = 0
"emit.photons" = "16x16"
"shadow.map.size" = 64
[permute]
"layers.count" = [1, 2]
seed = [1, 2]
END
local_sh --shards 3 --jobs 3 -- experiment run study.toml --out "the study"
expect "its runs are not all there" test "$(grep -c ',done,' "the study/runs.csv")" -eq 4

for script in local.sh slurm.sh; do
    script=$root/experiments/cluster/$script
    refuses "--shards: ''" "$script" -- "${reference[@]}" --out a.exr
    refuses "--shards: 'many'" "$script" --shards many -- "${reference[@]}" --out a.exr
    refuses "--shards: '0'" "$script" --shards 0 -- "${reference[@]}" --out a.exr
    refuses "--out" "$script" --shards 2 -- "${reference[@]}"
    refuses "--shard" "$script" --shards 2 -- "${reference[@]}" --shard 1/2 --out a.exr
    refuses "experiment run" "$script" --shards 2 -- experiment report study --out a
    refuses "after --" "$script" --shards 2 pool
    refuses "nowhere is not there" env KAUSTIK=nowhere "$script" --shards 2 -- \
        "${reference[@]}" --out a.exr
done
refuses "--jobs: 'x'" local_sh --shards 2 --jobs x -- "${reference[@]}" --out a.exr
refuses "--per-task: '0'" "$root/experiments/cluster/slurm.sh" --shards 2 --per-task 0 -- \
    "${reference[@]}" --out a.exr
expect "something was written" test ! -e a.exr -a ! -e a.shards

# One picture on tiles of the screen, which needs no GNU parallel.
tiles_sh() { "$root/experiments/cluster/tiles.sh" "$@"; }
picture=(run glass-sphere --technique screen_space_photons --size 32x24 --frames 1 --warmup 0 --set photons=16x16
    --set specular.bounces=2 --set shadow.map.size=64)
"$KAUSTIK" "${picture[@]}" --out whole
tiles_sh --tiles 3 --jobs 2 -- "${picture[@]}" --out "in tiles"
for file in caustic.exr beauty.exr; do
    expect "$file of tiles is another" cmp "whole/$file" "in tiles/$file"
done
refuses "--tiles: 'x'" tiles_sh --tiles x -- "${picture[@]}" --out a
refuses "run SCENE" tiles_sh --tiles 2 -- "${reference[@]}" --out a.exr
refuses "--tile is this script's" tiles_sh --tiles 2 -- "${picture[@]}" --tile 1/2 --out a
