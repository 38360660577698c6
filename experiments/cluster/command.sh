# SPDX-License-Identifier: MIT
# For the scripts next to it: one kaustik command, done in shards. Sets `arguments` (without --out),
# `out`, `kind` (reference or experiment) and `logs`; the functions do a shard and merge all.
kaustik=${KAUSTIK:-$root/build/release/bin/kaustik}
# Where it is installed, these scripts are in PREFIX/share/kaustik/experiments/cluster.
installed=$root/../../bin/kaustik
if [[ -z ${KAUSTIK:-} && ! -x $kaustik && -x $installed ]]; then kaustik=$installed; fi

fail() {
    echo "${0##*/}: $1" >&2
    exit 2
}

# read_options NAME ARGUMENT... : of `--NAME N [--jobs J] -- COMMAND…` N goes to `count`, J to `jobs`
# ("" where it is not given) and the rest to `undivided`; --help prints the head of the calling script.
read_options() {
    local name=$1
    shift
    count= jobs=
    while (($# > 0)); do
        case $1 in
            -h | --help)
                sed -n '3,10s/^# \{0,1\}//p' "${BASH_SOURCE[1]}"
                exit 0
                ;;
            "--$name") count=${2:-} && shift ;;
            --jobs) jobs=${2:-} && shift ;;
            --)
                shift
                break
                ;;
            *) fail "there is no option '$1'; the command comes after --" ;;
        esac
        (($# > 0)) && shift
    done
    undivided=("$@")
    is_whole_number "$count" || fail "--$name: '$count' is not a number of $name"
}

# read_arguments ARGUMENT... : those of the undivided command, whatever it is.
read_arguments() {
    arguments=()
    out=
    while (($# > 0)); do
        case $1 in
            --out)
                (($# > 1)) || fail "--out: name the file or folder"
                out=$2
                shift
                ;;
            --out=*) out=${1#--out=} ;;
            --shard | --shard=* | --tile | --tile=* | --tiles | --tiles=*) fail "${1%%=*} is this script's to give" ;;
            --merge | --merge=*)
                # Of `run` it is a file of settings.
                [[ ${arguments[0]:-} == run ]] || fail "${1%%=*} is this script's to give"
                arguments+=("$1")
                ;;
            *) arguments+=("$1") ;;
        esac
        shift
    done
    [[ -x $kaustik ]] || fail "$kaustik is not there; build it (experiments/quickstart.sh), or say where with KAUSTIK"
    [[ -n $out ]] || fail "name with --out what the whole command would write"
}

# read_command ARGUMENT... : of a reference or a study.
read_command() {
    read_arguments "$@"
    case ${arguments[0]:-}:${arguments[1]:-} in
        reference:*)
            kind=reference
            parts=${out%.*}.shards
            logs=$parts/logs
            ;;
        experiment:run)
            kind=experiment
            logs=$out/logs
            ;;
        *) fail "after -- comes 'reference SCENE …' or 'experiment run SPEC …'" ;;
    esac
}

is_whole_number() { [[ $1 =~ ^[1-9][0-9]{0,6}$ ]]; }

# do_shard K N THREADS
do_shard() {
    if [[ $kind == reference ]]; then
        mkdir -p "$parts"
        local threads=()
        [[ " ${arguments[*]} " == *" --threads"* ]] || threads=(--threads "$3")
        "$kaustik" "${arguments[@]}" "${threads[@]}" --shard "$1/$2" --out "$parts/$1-of-$2.shard"
    else
        # Mesa's software rasteriser would take every core of the machine.
        LP_NUM_THREADS=${LP_NUM_THREADS:-$3} \
            "$kaustik" "${arguments[@]}" --resume --shard "$1/$2" --out "$out"
    fi
}

# merge_all N
merge_all() {
    if [[ $kind == reference ]]; then
        local found=("$parts"/*-of-"$1".shard)
        [[ -e ${found[0]} ]] || fail "no shard has finished; what they said is in $logs"
        "$kaustik" reference --merge "${found[@]}" --out "$out"
    else
        "$kaustik" experiment merge "$out"
    fi
}
