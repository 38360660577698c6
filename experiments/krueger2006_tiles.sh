#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# How the work of tracing is shared out among tiles of the screen (Krüger, Bürger and Westermann 2006,
# section 6), by counts: 1, 2 and 4 tiles of pool and glass-bunny, by the default tracer and by
# lines, the paper's. Each picture must be that of the whole screen, to the bit. Writes tiles.csv into OUT
# and prints a table; about a quarter of an hour on two cores.
#   experiments/krueger2006_tiles.sh [KAUSTIK [OUT]]
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
export KAUSTIK=${1:-kaustik}
out=${2:-results/runs/krueger2006_tiles}
KAUSTIK=$(command -v "$KAUSTIK")
mkdir -p "$out"
for scene in pool glass-bunny; do
    for tracer in hierarchical lines; do
        settings=(run "$scene" --technique screen_space_photons --frames 1 --warmup 0 --set "trace=$tracer")
        # Rows of 800 texels would take an hour on a software rasteriser.
        [[ $tracer != lines ]] || settings+=(--size 400x300 --set emit.photons=128x128)
        whole=$out/$scene-$tracer
        "$KAUSTIK" "${settings[@]}" --out "$whole" > /dev/null
        for tiles in 1 2 4; do
            "$here/cluster/tiles.sh" --tiles "$tiles" -- "${settings[@]}" --out "$whole-$tiles" > /dev/null
            cmp "$whole/caustic.exr" "$whole-$tiles/caustic.exr"
            cmp "$whole/beauty.exr" "$whole-$tiles/beauty.exr"
        done
    done
done
exec "${PYTHON:-/usr/bin/python3}" "$here/plotting/krueger2006_tiles.py" "$out"
