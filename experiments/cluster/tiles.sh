#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes one picture whose photons are traced on N tiles of the screen, a process each, round by round
# (K06, section 6): to the bit the picture of the whole screen. Started again, it does what is left.
#   tiles.sh --tiles N [--jobs J] -- run SCENE … --out FOLDER
# J tiles are traced at a time, as many as there are processors; within an allocation of Slurm's
# (sbatch --ntasks=N, salloc) each is a task of its own. What tiles exchange lies in FOLDER.tiles.
#   tiles.sh --tiles 4 -- run glass-bunny --technique screen_space_photons --out out/bunny
#   sbatch --ntasks=4 --wrap 'experiments/cluster/tiles.sh --tiles 4 --jobs 4 -- run pool --technique screen_space_photons --out out/pool'
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
# shellcheck source=command.sh
source "$root/experiments/cluster/command.sh"

read_options tiles "$@"
set -- "${undivided[@]}"
tiles=$count
[[ -n $jobs ]] || jobs=$(nproc)
is_whole_number "$jobs" || fail "--jobs: '$jobs' is not a number of tiles at a time"
read_arguments "$@"
[[ ${arguments[0]:-} == run ]] || fail "after -- comes 'run SCENE …'"

exchange=$out.tiles
mkdir -p "$exchange"
task=()
[[ -z ${SLURM_JOB_ID:-} ]] || task=(srun --ntasks=1 --exact --quiet)
# Mesa's software rasteriser would take every core of the machine.
processors=$(nproc)
export LP_NUM_THREADS=${LP_NUM_THREADS:-$((processors > jobs ? processors / jobs : 1))}
more=yes
while [[ -n $more ]]; do
    seq "$tiles" | xargs -P "$jobs" -I '{}' "${task[@]}" \
        "$kaustik" "${arguments[@]}" --tile '{}'"/$tiles" --tiles "$exchange"
    said=$("$kaustik" tiles "$exchange")
    echo "$said"
    [[ $said == *"another round"* ]] || more=
done
"$kaustik" "${arguments[@]}" --tiles "$exchange" --out "$out"
