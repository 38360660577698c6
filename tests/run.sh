#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing, fetches the meshes, builds, and runs all tests. Safe to run again: only
# what has changed is installed, fetched and built again.
#   run.sh [--quick | --asan] [-- options of ctest...]
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
preset=release
selection=()
while (($# > 0)); do
    case $1 in
        -h | --help)
            echo "usage: run.sh [--quick | --asan] [-- options of ctest...]"
            echo "Installs, builds and runs all tests. --quick runs those that together take a few"
            echo "minutes (tests/quick); --asan runs all with the address and undefined-behaviour"
            echo "sanitizers. For one test: run.sh -- -R NAME"
            exit 0
            ;;
        --quick) selection=(--label-exclude '^slow$') ;;
        --asan) preset=asan ;;
        --)
            shift
            break
            ;;
        *)
            echo "run.sh: there is no option '$1'; options of ctest go after '--'" >&2
            exit 2
            ;;
    esac
    shift
done

"$root/experiments/set_up.sh" "$preset" all
cd "$root"
# Two at a time at most: on a software rasteriser each test already uses several cores.
jobs=$(nproc)
ctest --preset "$preset" --output-on-failure --parallel $((jobs < 2 ? jobs : 2)) "${selection[@]}" "$@"
