#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Everything between a bare Debian 12 or 13 and the programs: packages, meshes, configure, build.
# Each step does only what is still to do.
#   set_up.sh PRESET TARGET...    a preset of CMakePresets.json; the result is in build/PRESET
set -euo pipefail

preset=$1
shift
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"

experiments/install_packages.sh
experiments/fetch_meshes.sh

# What is printed goes to a file first, since it is of use only when the step fails.
mkdir -p "build/$preset"
log=build/$preset/configure.log
if ! cmake --preset "$preset" > "$log" 2>&1; then
    cat "$log" >&2
    echo "configure: 'cmake --preset $preset' failed; its messages are above" >&2
    exit 1
fi
echo "configure: build/$preset is up to date"

# A compiler takes up to a gigabyte: no more of them than there is memory for.
jobs=$(nproc)
gigabytes=$(awk '/^MemAvailable:/ { print int($2 / 1048576) }' /proc/meminfo)
if ((gigabytes < jobs)); then jobs=$((gigabytes > 1 ? gigabytes : 1)); fi
echo "build: $* with $jobs at a time"
cmake --build --preset "$preset" --parallel "$jobs" --target "$@"
