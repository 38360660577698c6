#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Unpacks the archive of experiments/package.sh in a folder of its own and uses it there, without the
# environment of the test: all libraries are its own or the machine's C library and driver, pictures
# are EXR and PNG without OpenImageIO, and every library has its licence.
#   packaged.sh SOURCE_TREE BUILD_TREE
set -euo pipefail

sources=$1 build=$2
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT

fail() {
    echo "packaged: $*" >&2
    [[ ! -s $work/log ]] || cat -- "$work/log" >&2
    exit 1
}

"$sources/experiments/package.sh" --build "$build" --out "$work/a.tar.xz" > "$work/log" 2>&1 || fail "it cannot be made"
mkdir "$work/else where"
tar xf "$work/a.tar.xz" -C "$work/else where"
here="$work/else where/kaustik"

while read -r library; do
    case $library in
        "$here"/* | */libc.so.* | */libm.so.* | */libdl.so.* | */libpthread.so.* | */libstdc++.so.* | */libgcc_s.so.*) ;;
        *) fail "it loads $library" ;;
    esac
done < <(ldd "$here/bin/kaustik" "$here/lib/kaustik/kaustik_exr_png.so" | sed --quiet 's/.*=> \(\/.*\) (0x.*/\1/p')
missing=$(ldd "$here/bin/kaustik" "$here"/lib/kaustik/* "$here"/lib/shared/* || true)
[[ $missing != *'not found'* ]] || fail "a library is missing"
[[ -s $here/licences/kaustik.txt && -s $here/licences/meshes.txt ]] || fail "a licence is missing"
(($(find "$here/licences" -size +0 | wc -l) >= 15)) || fail "licences of libraries are missing"

program() { (cd / && exec env -i HOME="$work" PATH=/usr/bin:/bin LD_LIBRARY_PATH=/nonsense LC_ALL=no_NO "$here/kaustik" "$@") > "$work/log" 2>&1; }
program check || fail "'kaustik check' failed"
grep -q 'EXR and PNG, by OpenEXR and libpng' "$work/log" || fail "it found another module for images"
program run pool --technique exact_rays --size 64x48 --frames 1 --warmup 0 --out "$work/run" || fail "'kaustik run' failed"
program compare "$work/run/caustic.exr" "$work/run/caustic.exr" || fail "it cannot read what it has written"
[[ -s $work/run/beauty.png ]] || fail "it has written no PNG"

refused() { "$sources/experiments/package.sh" "$@" > "$work/log" 2>&1 && fail "'package.sh $*' did not fail"; grep -q '^package: ' "$work/log"; }
refused --build "$work" || fail "a folder without a program is refused without a sentence"
refused --into nowhere || fail "an unknown option is refused without a sentence"
