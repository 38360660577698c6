#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes an archive of the program that runs where it is unpacked, on a machine that has nothing but a driver with OpenGL 4.5: no package is
# installed there. It holds the programs, what they read (shaders, scenes, the free meshes), every library but the C library and the driver's, and
# the licences of all that. OpenImageIO, which brings hundreds of libraries, is left out; OpenEXR and PNG are read and written without it.
#   package.sh [--build build/release] [--out kaustik.tar.xz]
# Then, anywhere:
#   tar xf kaustik.tar.xz && kaustik/kaustik check && kaustik/kaustik run pool
# Built on Debian 12 it needs glibc 2.36 or newer.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build/release
out=kaustik.tar.xz
largest=$((60 * 1024 * 1024))

fail() {
    echo "package: $1" >&2
    exit 1
}

while (($# > 0)); do
    case $1 in
        --build) build=${2:?"--build needs a folder"} ;;
        --out) out=${2:?"--out needs a file"} ;;
        *) fail "there is no option '$1'; there are --build and --out" ;;
    esac
    shift 2
done
[[ -x $build/bin/kaustik ]] || fail "$build has no program; experiments/quickstart.sh builds it"
[[ -f $build/bin/kaustik_exr_png.so ]] || fail "$build was made without KAUSTIK_WITH_EXR_PNG"
command -v patchelf > /dev/null || fail "patchelf is missing; experiments/install_packages.sh installs it"

work=$(mktemp --directory)
trap 'rm --recursive --force "$work"' EXIT
whole=$work/kaustik
cmake --install "$build" --prefix "$whole" > /dev/null
# What only other programs are built with, and what needs libraries that are left out.
rm --recursive --force "$whole/include" "$whole"/lib/*.a "$whole/lib/cmake" "$whole"/lib/python* "$whole/lib/kaustik/kaustik_openimageio.so"
find "$whole/share/kaustik/meshes" -type f ! -name '*.3ds' ! -name bunny.obj -delete 2> /dev/null || true

programs=("$whole/bin/kaustik" "$whole/lib/kaustik/kaustik_reader" "$whole/lib/kaustik/kaustik_exr_png.so")
shared=$whole/lib/shared    # by $ORIGIN, unless LD_LIBRARY_PATH has the same
runtime=$whole/lib/runtime  # the C++ runtime, only where the host's is older: its driver may need its own newer one
licences=$whole/licences
mkdir --parents "$shared" "$runtime" "$licences"

# The machine's own: the C library, and what belongs to the driver.
is_of_the_host() {
    case $1 in
        libc.so.* | libm.so.* | libdl.so.* | libpthread.so.* | librt.so.* | ld-linux*) return 0 ;;
        libGL* | libEGL* | libOpenGL* | libvulkan*) return 0 ;;
        *) return 1 ;;
    esac
}
licence_of() {
    local package
    # By its name and last folder: of /lib and /usr/lib, which are one, packages know either.
    local file
    file=$(readlink --canonicalize "$1")
    package=$({ dpkg-query --search "*/$(basename "$(dirname "$file")")/$(basename "$file")" 2> /dev/null || true; } | sed --quiet '1s/:.*//p')
    [[ -n $package ]] || fail "no package is known to have '$1', and so no licence of it"
    cp --dereference "/usr/share/doc/$package/copyright" "$licences/$package.txt"
}
# The workbench loads GLFW when a window is asked for. All of the list is read: who writes to a closed pipe fails.
glfw=$(ldconfig -p | awk '$1 == "libglfw.so.3" && !found {print $NF; found = 1}')
{
    ldd "${programs[@]}"
    [[ -z $glfw ]] || { ldd "$glfw" && echo "libglfw.so.3 => $glfw"; }
} | awk '$2 == "=>" && $3 ~ /^\// {print $3}' | sort --unique > "$work/libraries"
while read -r library; do
    name=$(basename "$library")
    is_of_the_host "$name" && continue
    case $name in
        libstdc++.so.* | libgcc_s.so.*) cp --dereference "$library" "$runtime/$name" ;;
        *) cp --dereference "$library" "$shared/$name" ;;
    esac
    licence_of "$library"
done < "$work/libraries"
strip --strip-unneeded "${programs[@]}" "$shared"/* "$runtime"/*
# shellcheck disable=SC2016
for program in "${programs[@]}"; do
    if [[ $program == "$whole"/bin/* ]]; then
        patchelf --set-rpath '$ORIGIN/../lib/shared' "$program"
    else
        patchelf --set-rpath '$ORIGIN/../shared' "$program"
    fi
done
# shellcheck disable=SC2016
for library in "$shared"/*; do
    patchelf --set-rpath '$ORIGIN' "$library"
done
cp "$root/LICENSE" "$licences/kaustik.txt"
[[ -s $root/meshes/glmark2-data.txt ]] || fail "the meshes' licence is missing; experiments/fetch_meshes.sh fetches it"
cp "$root/meshes/glmark2-data.txt" "$licences/meshes.txt"

cat > "$whole/kaustik" << 'SCRIPT'
#!/bin/sh
# Starts the program with the C++ runtime that lies here where the machine's own is too old for it.
here=$(dirname "$(readlink -f "$0")")
if ! "$here/bin/kaustik" --version > /dev/null 2>&1; then
    LD_LIBRARY_PATH=$here/lib/runtime${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
    export LD_LIBRARY_PATH
fi
exec "$here/bin/kaustik" "$@"
SCRIPT
chmod +x "$whole/kaustik"

# It runs from here, with nothing of this machine's environment.
env --ignore-environment HOME="$work" PATH=/nowhere LD_LIBRARY_PATH=/nonsense LC_ALL=no_NO "$whole/bin/kaustik" run pool --size 64x48 --frames 1 \
    --warmup 0 --out "$work/run" > "$work/log" 2>&1 || fail "what was made does not run: $(tail --lines=1 "$work/log")"
[[ -f $work/run/beauty.png ]] || fail "what was made writes no PNG"

tar --create --xz --directory "$work" --sort=name --owner=0 --group=0 --numeric-owner --mtime="@${SOURCE_DATE_EPOCH:-0}" --file "$out" kaustik
bytes=$(stat --format=%s "$out")
((bytes <= largest)) || fail "$out has $bytes bytes, and may have $largest"
echo "package: $out, $((bytes / 1024 / 1024)) MiB, $(find "$shared" "$runtime" -type f | wc --lines) libraries"
