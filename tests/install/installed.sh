#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs a build into a prefix of its own, uses it, moves it, and builds the example technique of
# CONTRIBUTING.md outside of the tree with it. The programs run elsewhere, without the environment
# of the test; where the optimised build names the source tree nowhere, they cannot read it.
#   installed.sh CMAKE BUILD_TYPE SOURCE_TREE BUILD_TREE OUTSIDE
set -euo pipefail

cmake=$1 build_type=$2 sources=$3 build=$4 outside=$5
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT

fail() {
    echo "installed: $*" >&2
    [[ ! -s $work/log ]] || cat -- "$work/log" >&2
    exit 1
}

# What it prints is of use only when it fails.
quietly() { "$@" > "$work/log" 2>&1 || fail "'$*' failed (exit code $?)"; }

program() {
    (cd -- "$work/elsewhere" && exec env -i PATH=/usr/bin:/bin HOME="$work/home" "$@")
}

require() {
    local file
    for file in "$@"; do
        [[ -s $file ]] || fail "$file was not written"
    done
}

refuses_to_name() {
    local path=$1 what=$2 found
    [[ $build_type == Release ]] || return 0
    : > "$work/log"
    found=$(grep --recursive --files-with-matches --fixed-strings -- "$path" "$what" || true)
    [[ -z $found ]] || fail "these name $path: $found"
}

# The last error, one line that names what is missing.
expect_error() {
    local needle=$1 code=0
    shift
    program "$@" > "$work/out" 2> "$work/log" || code=$?
    ((code == 1)) || fail "'$*' ended with exit code $code, not 1"
    [[ $(wc -l < "$work/log") == 1 ]] || fail "'$*' printed more than one line"
    grep --quiet --fixed-strings -- "$needle" "$work/log" || fail "no '$needle' in its message"
}

small=(--size 64x48 --frames 1 --set photons=32x32)
mkdir "$work/elsewhere" "$work/home"

# A program, and what it needs.
quietly "$cmake" --install "$build" --prefix "$work/first"
refuses_to_name "$sources" "$work/first"
refuses_to_name "$build" "$work/first"
mv "$work/first" "$work/prefix"
kaustik=$work/prefix/bin/kaustik
program "$kaustik" check > "$work/log"
grep --quiet --line-regexp --fixed-strings \
    "project files     $work/prefix/share/kaustik" "$work/log" || fail "it reads other files"
quietly program "$kaustik" run pool "${small[@]}" --out pool
require "$work"/elsewhere/pool/{beauty.png,beauty.exr,caustic.exr,report.json,trace.json}

printf '%s\n' 'name = "tiny"' '[base]' 'scene = "flat-water"' 'size = "64x48"' 'frames = 1' \
    'photons = "32x32"' '[permute]' 'trace = ["hierarchical", "march"]' > "$work/elsewhere/tiny.toml"
quietly program "$kaustik" experiment run tiny.toml --out study
quietly program "$kaustik" experiment report study
require "$work/elsewhere/study/report.html"

# The Python module, with a study, which is another program's work.
packages=$work/prefix/lib/python3/dist-packages
if [[ -d $packages ]]; then
    cat > "$work/elsewhere/example.py" << 'PYTHON'
import kaustik
with kaustik.open("pool", size=(64, 48), set={"photons": (32, 32)}) as renderer:
    renderer.step()
    renderer.read("display").save("python.png")
assert len(kaustik.run_experiment("tiny.toml", "study of python")) == 2
PYTHON
    quietly program PYTHONPATH="$packages" /usr/bin/python3 -B example.py
    require "$work/elsewhere/python.png" "$work/elsewhere/study of python/runs.csv"
fi

# The example technique, in a folder that is not the project's.
cp -r "$outside" "$work/outside"
quietly "$cmake" -G Ninja -S "$work/outside" -B "$work/outside/build" \
    -DCMAKE_PREFIX_PATH="$work/prefix"
quietly "$cmake" --build "$work/outside/build"
mine=$work/outside/build/outside
refuses_to_name "$sources" "$mine"
quietly program "$mine" run pool --technique points "${small[@]}" --out points
require "$work/elsewhere/points/report.json" "$work/elsewhere/points/caustic.exr"
grep --quiet '"technique": "points"' "$work/elsewhere/points/report.json" ||
    fail "its report names another technique"
quietly program "$mine" run flat-water --technique planar "${small[@]}" --out planar

# What is missing is one message.
mv "$work/outside/shaders" "$work/outside/gone"
expect_error "$work/outside/shaders" "$mine" run pool --technique points "${small[@]}" --out none
rm -r "$work/prefix/share"
expect_error KAUSTIK_ROOT "$kaustik" run pool "${small[@]}" --out none
expect_error KAUSTIK_ROOT "$mine" run pool "${small[@]}" --out none
[[ -z $(find "$work/elsewhere" -path '*/none/*') ]] || fail "what failed has left files"
