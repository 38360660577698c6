#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Every technique on a second driver: Mesa's OpenGL on Vulkan (Zink) on its software Vulkan device (lavapipe), in a root of Debian 13, with
# Vulkan's validation layer and its check of synchronisation on, next to llvmpipe there.
#   second_driver.sh [--root /var/tmp/kaustik_debian13] [--package kaustik.tar.xz] [--scenes "pool ring"] [--out results/device]
# Zink has descriptor sets there (ZINK_DESCRIPTORS=lazy, unless that is set): of what lies in descriptor buffers, which it takes by itself,
# the layer sees no use, and with them Mesa 25.0.7 has a sum of the ledger wrong (results/device.md).
# Makes the root where it is not yet, by debootstrap from where this machine's packages come; makes the package, too, if none is given
# (experiments/package.sh). Needs to be root, two gigabytes, and half an hour on two cores. Writes to --out
#   second_driver.csv: a row a scene and technique: exit codes, relMSE of Zink's picture against llvmpipe's, of
#                      what the eye sees and of the caustic, and how many messages the layer had;
#   second_driver.log: which versions, what the layer says of a program that only makes a context, and every kind of message of a run, with
#                      how often it came.
set -euo pipefail

project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
root=/var/tmp/kaustik_debian13
package=
scenes="pool glass-sphere ring god-rays"
out=$project/results/device

fail() {
    echo "second_driver: $1" >&2
    exit 1
}

while (($# > 0)); do
    case $1 in
        --root) root=${2:?"--root needs a folder"} ;;
        --package) package=${2:?"--package needs an archive"} ;;
        --scenes) scenes=${2:?"--scenes needs names"} ;;
        --out) out=${2:?"--out needs a folder"} ;;
        *) fail "there is no option '$1'; there are --root, --package, --scenes and --out" ;;
    esac
    shift 2
done
((EUID == 0)) || fail "only root can make a root folder and enter it"
command -v debootstrap > /dev/null || fail "debootstrap is missing; apt-get install debootstrap"

if [[ ! -x $root/usr/bin/apt-get ]]; then
    # shellcheck disable=SC2016
    mirror=$(apt-get indextargets --format '$(SITE)' | head -n 1)
    [[ -n $mirror ]] || fail "this machine does not say where its packages come from"
    debootstrap --variant=minbase trixie "$root" "$mirror"
fi
if [[ ! -e $root/usr/share/vulkan/explicit_layer.d/VkLayer_khronos_validation.json ]]; then
    chroot "$root" sh -c 'apt-get update && apt-get install --yes --no-install-recommends \
        libegl1 libegl-mesa0 libgl1 libgl1-mesa-dri mesa-vulkan-drivers vulkan-validationlayers xz-utils'
fi
if [[ -z $package ]]; then
    package=$root/root/kaustik.tar.xz
    "$project/experiments/package.sh" --out "$package"
fi
rm --recursive --force "$root/root/kaustik" "$root/root/second_driver"
tar --extract --file "$package" --directory "$root/root"
mkdir --parents "$root/root/second_driver" "$out"

cat > "$root/root/second_driver/vk_layer_settings.txt" << 'SETTINGS'
khronos_validation.validate_sync = true
khronos_validation.debug_action = VK_DBG_LAYER_ACTION_LOG_MSG
khronos_validation.log_filename = /root/second_driver/messages.txt
khronos_validation.report_flags = error,warn
khronos_validation.enable_message_limit = false
SETTINGS
sed 's/error,warn/error,warn,info/' "$root/root/second_driver/vk_layer_settings.txt" > "$root/root/second_driver/vk_layer_information.txt"

cat > "$root/root/second_driver/inside.sh" << 'INSIDE'
set -eu
cd /root/second_driver
kaustik=/root/kaustik/kaustik
export LIBGL_ALWAYS_SOFTWARE=1
size="--size 160x120 --set photons=32x32 --frames 1 --warmup 0"

on_zink() {
    MESA_LOADER_DRIVER_OVERRIDE=zink ZINK_DESCRIPTORS=$ZINK_DESCRIPTORS VK_DRIVER_FILES=$(ls /usr/share/vulkan/icd.d/lvp_icd*.json | head -n 1) \
        VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation VK_LAYER_SETTINGS_PATH=$PWD/${settings:-vk_layer_settings.txt} "$@"
}
# A message is its kind in brackets; the lines below it say of which objects.
kinds() { sed -n 's/^Validation \([A-Za-z]*\): \[ \([^]]*\) \].*/\1 \2/p' messages.txt | sort | uniq -c; }
# A number of compare's JSON.
number() { sed -n "s/^ *\"$1\": \([0-9][0-9.e+-]*\),*\$/\1/p" | head -n 1; }

{
    dpkg-query --show mesa-vulkan-drivers vulkan-validationlayers
    $kaustik check | sed -n 's/^device  */llvmpipe: /p'
    on_zink $kaustik check | sed -n 's/^device  */zink: /p'
    echo "ZINK_DESCRIPTORS=$ZINK_DESCRIPTORS"
    echo
    echo "what the layer says of a program that makes a context and ends:"
    rm -f messages.txt
    settings=vk_layer_information.txt on_zink $kaustik check > /dev/null
    sed -n '/Current Enables/s/^ */  /p' messages.txt | sort -u
    kinds
    echo
    echo "runs, and what it says of each:"
} > second_driver.log
grep -q SYNCHRONIZATION_VALIDATION second_driver.log || { echo "the check of synchronisation is not on" >&2; exit 1; }

of_the_run=$($kaustik check | sed -n 's/^device  *//p'),$($kaustik --version),$(date +%F)
of_the_run=$(echo "$of_the_run" | sed 's/, 256 bits//')  # no comma within a cell
echo "scene,technique,llvmpipe,zink,beauty,caustic,messages,device,version,date" > second_driver.csv
for scene in $SCENES; do
    for technique in $($kaustik list techniques | awk '/^[a-z]/ {print $1}'); do
        rm -rf llvmpipe zink messages.txt
        first=0 second=0 beauty= caustic=
        $kaustik run "$scene" --technique "$technique" $size --out llvmpipe > llvmpipe.txt 2>&1 || first=$?
        on_zink $kaustik run "$scene" --technique "$technique" $size --out zink > zink.txt 2>&1 || second=$?
        if [ $first = 0 ] && [ $second = 0 ]; then
            for picture in beauty caustic; do
                $kaustik compare zink/$picture.exr llvmpipe/$picture.exr --json > compare.json
                eval "$picture=$(number rel_mse < compare.json)"
            done
        else
            tail -n 1 llvmpipe.txt zink.txt >> second_driver.log
        fi
        touch messages.txt
        count=$(kinds | awk '{sum += $1} END {print sum + 0}')
        echo "$scene,$technique,$first,$second,$beauty,$caustic,$count,$of_the_run" >> second_driver.csv
        echo "$scene $technique: $count" | tee -a second_driver.log
        kinds >> second_driver.log
    done
done
INSIDE
unshare --mount chroot "$root" env SCENES="$scenes" ZINK_DESCRIPTORS="${ZINK_DESCRIPTORS:-lazy}" sh -c 'mount -t proc proc /proc && exec sh /root/second_driver/inside.sh'
cp "$root/root/second_driver/second_driver.csv" "$root/root/second_driver/second_driver.log" "$out"
