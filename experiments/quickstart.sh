#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# From a bare Debian 12 or 13 machine to a picture: installs what is missing, fetches the meshes,
# builds, and renders the default scene. Safe to run again: only what has changed is done again.
#   quickstart.sh [--no-run] [SCENE] [options of 'kaustik run']...
# Its last line says how a shell finds what was built: kaustik, and the Python module.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
kaustik=$root/build/release/bin/kaustik

run=true
out=$root/results/runs/quickstart
out_option=(--out "$out")
arguments=()
while (($# > 0)); do
    case $1 in
        -h | --help)
            echo "usage: quickstart.sh [--no-run] [SCENE] [options of 'kaustik run']..."
            echo "Installs, builds and renders; --no-run stops after the build."
            exit 0
            ;;
        --no-run) run=false ;;
        --out)
            arguments+=("$@")
            out=${2:-}
            out_option=()
            break
            ;;
        --out=*)
            arguments+=("$1")
            out=${1#--out=}
            out_option=()
            ;;
        *) arguments+=("$1") ;;
    esac
    shift
done

"$root/experiments/set_up.sh" release kaustik kaustik_python
if $run; then
    "$kaustik" run "${arguments[@]}" "${out_option[@]}"
    echo
    echo "picture: $out/beauty.png"
    echo "report:  $out/report.json"
fi
echo "to have 'kaustik' on the path, and in Python:  . $root/build/release/env.sh"
