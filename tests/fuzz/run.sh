#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Fuzzes the readers of files, each alone, two at a time.
#   run.sh SECONDS [TARGET...]     of each target; all targets by default
# Builds them, makes their first inputs, and prints a line a target: inputs tried, a second; edges
# and features of the code that they reach; the most memory; findings, by kind. What has been found
# goes to build/fuzz/findings/TARGET, and the exit code is then 1. A finding is an input for which
# the program crashes, throws what is not the project's, takes more than 60 s or 2 GiB, or breaks a rule
# of the language. Where a reader process reads (gzip, gltf, scene, image, experiment), what it does to
# that process is none: it ends, or is stopped at 4 s or 1 GiB, and the program says so in an error.
# Inputs that reach something new stay in build/fuzz/corpus/TARGET, for the next time. With
# KAUSTIK_FUZZ_SEED a target's inputs come in the same order each time that it starts without them.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
all=(scene gltf import obj ply stl 3ds gzip pfm image exr_png layers experiment study reference classes part cache settings tile)
jobs=${KAUSTIK_FUZZ_JOBS:-2}

if [[ ! ${1:-} =~ ^[1-9][0-9]*$ ]]; then
    echo "usage: run.sh SECONDS [TARGET...]   targets: ${all[*]}" >&2
    exit 2
fi
seconds=$1
shift
targets=("$@")
((${#targets[@]} > 0)) || targets=("${all[@]}")
for target in "${targets[@]}"; do
    if [[ ! " ${all[*]} " == *" $target "* ]]; then
        echo "run.sh: there is no target '$target'; there are ${all[*]}" >&2
        exit 2
    fi
done

cd "$root"
experiments/install_packages.sh --fuzz
build=build/fuzz
mkdir -p "$build"
{ cmake --preset fuzz && cmake --build --preset fuzz --target fuzz --parallel 2; } > "$build/build.log" 2>&1 || {
    tail -n 50 "$build/build.log" >&2
    echo "run.sh: the fuzzers cannot be built; the messages above are from $build/build.log" >&2
    exit 1
}
tests/fuzz/make_corpus.py "$build/corpus"
"$build/bin/fuzz_write_seeds" "$build/corpus/seeds"

# Files that targets write lie in memory where there is such a place, and go with this script.
TMPDIR=$(mktemp -d -p "$([[ -w /dev/shm ]] && echo /dev/shm || echo "${TMPDIR:-/tmp}")")
trap 'rm -rf "$TMPDIR"' EXIT
export TMPDIR
export KAUSTIK_ROOT=$root/$build/corpus/root OPENIMAGEIO_THREADS=1
export KAUSTIK_READ_SECONDS=4 KAUSTIK_READ_MEBIBYTES=1024
# Libraries keep some memory to the end; and what has been freed is to count as such.
export ASAN_OPTIONS=detect_leaks=0:quarantine_size_mb=32 UBSAN_OPTIONS=print_stacktrace=1

# A number of libFuzzer's last status line, and of its statistics.
status() { { grep -oE "$1 ?[0-9]+" "$2" || echo -; } | tail -n 1 | grep -oE '[0-9]+|-'; }
statistic() { { sed -n "s/^stat::$1: *//p" "$2" | grep . || echo -; } | tail -n 1; }

fuzz() {
    local target=$1
    local corpus=$build/corpus/$target findings=$build/findings/$target log=$build/$target.log
    mkdir -p "$corpus" "$findings"
    local code=0
    local options=(-artifact_prefix="$findings/" -max_total_time="$seconds" -print_final_stats=1
        -max_len=131072 -timeout=60 -rss_limit_mb=2048
        -seed="${KAUSTIK_FUZZ_SEED:-0}")
    [[ ! -s $build/corpus/$target.dict ]] || options+=(-dict="$build/corpus/$target.dict")
    "$build/bin/fuzz_$target" "$corpus" "$build/corpus/seeds/$target" "${options[@]}" \
        > "$log" 2>&1 || code=$?
    printf '%-10s %10s %8s/s %7s %8s %6s MiB  %s\n' "$target" \
        "$(statistic number_of_executed_units "$log")" \
        "$(statistic average_exec_per_sec "$log")" "$(status 'cov:' "$log")" \
        "$(status 'ft:' "$log")" "$(statistic peak_rss_mb "$log")" "$( ((code == 0)) && echo none ||
            grep -oE 'SUMMARY: .*' "$log" | tail -n 1)"
    ((code == 0)) || touch "$TMPDIR/found"
}

printf '%-10s %10s %10s %7s %8s %10s  %s\n' target inputs rate edges features memory findings
for target in "${targets[@]}"; do
    while (($(jobs -rp | wc -l) >= jobs)); do wait -n || true; done
    fuzz "$target" &
done
wait
if [[ -e $TMPDIR/found ]]; then
    echo "run.sh: findings are in $build/findings; to see one again:" >&2
    echo "    KAUSTIK_ROOT=$build/corpus/root $build/bin/fuzz_TARGET $build/findings/TARGET/FILE" >&2
    exit 1
fi
