#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs the Debian packages (12 or 13) that Kaustik is built, run and tested with: those that are
# missing, and only those. Answers at once when nothing is. Needs root or sudo only to install.
#   install_packages.sh [--cluster] [--fuzz]
#   --cluster: also Slurm and GNU parallel, which experiments/cluster uses
#   --fuzz: also what tests/fuzz/run.sh needs
set -euo pipefail

packages=(
    # Tools
    g++ cmake ninja-build pkg-config
    # OpenGL 4.5 without a display; Mesa's drivers render on the processor where there is no GPU.
    libepoxy-dev libegl-dev libegl-mesa0 libgl1-mesa-dri
    # Libraries
    libglm-dev libfmt-dev nlohmann-json3-dev libtomlplusplus-dev libcli11-dev
    libtinygltf-dev libpugixml-dev zlib1g-dev libopenimageio-dev libopenexr-dev libpng-dev patchelf
    # The ray-traced reference
    libembree-dev libtbb-dev
    # The workbench
    libimgui-dev libglfw3-dev fonts-dejavu-core
    # The Python module
    pybind11-dev python3-dev libdlpack-dev
    # Figures and pages of a study; OpenImageIO reads EXR there
    python3 python3-matplotlib python3-openimageio
    # Formatting, as .ci/run checks it
    clang-format
    # Tests; the page of a study is opened in a browser, the workbench on a display without a screen
    libgtest-dev libgmock-dev chromium chromium-driver xvfb x11-xkb-utils libxtst-dev python3-numpy
    python3-jsonschema
    # Another renderer's photons, which kaustik judge is tested on
    povray
    # A strict compiler for shaders, which tests/gpu/strict asks about every program
    glslang-tools spirv-tools spirv-cross
)
for argument in "$@"; do
    case $argument in
        --cluster) packages+=(slurmctld slurmd slurm-client munge parallel procps) ;;
        --fuzz) packages+=(clang libclang-rt-dev) ;;
        *)
            echo "packages: there is no option '$argument'; there are --cluster and --fuzz" >&2
            exit 2
            ;;
    esac
done

if ! command -v dpkg-query > /dev/null || ! command -v apt-get > /dev/null; then
    echo "packages: this is not Debian, so install these or their like yourself: ${packages[*]}" >&2
    exit 0
fi

missing=()
for package in "${packages[@]}"; do
    status=$(dpkg-query --show --showformat='${db:Status-Status}\n' "$package" 2> /dev/null || true)
    grep -qx installed <<< "$status" || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
    echo "packages: all ${#packages[@]} are installed"
    exit 0
fi

as_root=()
if ((EUID != 0)); then
    if ! command -v sudo > /dev/null; then
        echo "packages: neither root nor sudo, so have an administrator install: ${missing[*]}" >&2
        exit 1
    fi
    as_root=(sudo)
fi
apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive
    apt-get --quiet --option DPkg::Lock::Timeout=300)

echo "packages: installing ${missing[*]}"
"${apt[@]}" update || echo "packages: apt-get update failed; trying with the lists at hand" >&2
if ! "${apt[@]}" install --yes --no-install-recommends "${missing[@]}"; then
    echo "packages: apt-get could not install them; its own message is above" >&2
    exit 1
fi
