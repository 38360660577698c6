#!/bin/sh
# SPDX-License-Identifier: MIT
# Caustics as they are seen in a mirror and through glass (Umenhoffer, Patow and Szirmay-Kalos 2008, section 6), against photon
# mapping along the eye's real paths. Prints a table; about ten minutes on two cores.
#   experiments/umenhoffer2008_seen.sh [KAUSTIK [OUT]]
set -eu
here=$(cd "$(dirname "$0")" && pwd)
kaustik=${1:-kaustik}
out=${2:-results/runs/umenhoffer2008_seen}
mkdir -p "$out"
for scene in mirror-room pane-room; do
    file="$here/umenhoffer2008/$scene.toml"
    "$kaustik" reference "$file" --estimator sppm --caustic-view --photons 67108864 --size 400x300 \
        --out "$out/$scene.exr" >/dev/null
    # All that is light is followed, and pixels without anything specular are told apart by a run without the view.
    common="--technique caustic_triangles --frames 1 --warmup 0 --size 400x300 --set emit.photons=256x256
        --set around.cubes.layers=6 --set around.cubes.size=512 --set specular=split"
    "$kaustik" run "$file" $common --disable view.around --disable gather.cube --out "$out/$scene-straight" >/dev/null
    for view in around refraction; do
        for seen in on off; do
            "$kaustik" run "$file" $common --set "view=$view" --set "view.around.caustics=$seen" \
                $([ "$seen" = off ] && echo "--disable gather.cube") --out "$out/$scene-$view-$seen" >/dev/null
        done
    done
done
exec "${PYTHON:-/usr/bin/python3}" "$here/plotting/umenhoffer2008.py" seen "$out"
