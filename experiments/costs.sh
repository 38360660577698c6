#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Counts what a frame of each technique reads and writes at 1024² photons, 1920×1080 pixels and 8 layers, on whatever device there is: the counts are the
# same on all, but for what shaders race for. Writes results/costs/passes.csv, of which results/costs.md is made.
#   costs.sh [--out results/runs/costs] [--scenes "pool ring"] [--techniques "exact_rays planar"]
# What is finished in the folder is not done again; rows of frames that are not in it stay as they are.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
out=$root/results/runs/costs
scenes="pool"
techniques="exact_rays screen_space_photons caustic_map vertex_caustics multi_resolution lens_splats eye_gather caustic_triangles adaptive_caustic_map
hierarchical_caustic_map planar differential_area"
while (($# > 0)); do
    case $1 in
        --out) out=${2:?"--out needs a folder"} ;;
        --scenes) scenes=${2:?"--scenes needs names"} ;;
        --techniques) techniques=${2:?"--techniques needs names"} ;;
        *)
            echo "costs: there is no option '$1'; there are --out, --scenes and --techniques" >&2
            exit 2
            ;;
    esac
    shift 2
done
for scene in $scenes; do
    for technique in $techniques; do
        folder=$out/$scene-$technique
        [[ -f $folder/report.json ]] && continue
        "$root/build/release/bin/kaustik" run "$scene" --technique "$technique" --size 1920x1080 --set emit.photons=1024x1024 --set layers.count=8 \
            --frames 1 --warmup 0 --device-model 1000GB/s --out "$folder" || echo "costs: $scene with $technique was refused" >&2
    done
done
/usr/bin/python3 -B "$root/experiments/plotting/costs.py" slim "$out"/*/report.json --csv "$root/results/costs/passes.csv"
/usr/bin/python3 -B "$root/experiments/plotting/pages.py" "$root/results/costs.md"
