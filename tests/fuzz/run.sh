#!/usr/bin/env bash
# run.sh FOLDER SECONDS [HARNESS...]: runs the harnesses (all, unless some are named) of the built FOLDER for SECONDS
# each, one a core, from the corpus that FOLDER/corpus keeps, which begins with the files of data/ and with corpus/*.zip
# of this folder. Fails at the first find, which lies in FOLDER/finds then.
set -euo pipefail
folder=$(readlink -f "$1")
seconds=$2
shift 2
here=$(readlink -f "$(dirname "$0")")
data=$here/../../data
export ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=0 UBSAN_OPTIONS=print_stacktrace=1

# Longer seeds are slow to mutate, and few numbers of them are looked at.
seeds() { find "$data" -type f -size -64k "$@"; }
seeds_of() {
    case $1 in
        scene_fuzz) seeds -path '*/scenes/*.toml' ;;
        decal_csv_fuzz) seeds -name '*.csv' ;;
        decal_toml_fuzz) seeds -name '*.toml' ;;
        npy_fuzz | decal_npy_fuzz) seeds -name '*.npy' ;;
        camera_fuzz) seeds -name '*.camera.json' ;;
        gbuffer_fuzz) seeds -name '*.exr' ;;
        texture_fuzz) seeds '(' -name '*.png' -o -name '*.jpg' -o -name '*.tif' -o -name '*.exr' ')' ;;
        vdb_fuzz) seeds -name '*.vdb' ;;
        nvdb_fuzz) seeds -name '*.nvdb' ;;
    esac
}

# Texts show all that they can in little, and a node of a NanoVDB tree takes 270 kB as it lies in a file.
longest_of() {
    case $1 in
        scene_fuzz | decal_csv_fuzz | decal_toml_fuzz | camera_fuzz | light_json_fuzz | costs_fuzz) echo 4096 ;;
        nvdb_fuzz) echo 400000 ;;
        *) echo 65536 ;;
    esac
}

if [ $# -ne 1 ]; then
    [ $# -gt 0 ] || set -- $(cd "$folder/tests/fuzz" && ls -d ./*_fuzz)
    printf '%s\n' "${@#./}" | xargs -n 1 -P "$(nproc)" "$here/run.sh" "$folder" "$seconds"
    exit
fi

name=${1#./}
corpus=$folder/corpus/$name
mkdir -p "$corpus" "$folder/finds"
seeds_of "$name" | while read -r seed; do cp -n "$seed" "$corpus/$(sha1sum <"$seed" | cut -c1-16)"; done
[ ! -f "$here/corpus/$name.zip" ] || python3 -m zipfile -e "$here/corpus/$name.zip" "$corpus"
log=$folder/finds/$name.log
longest=$(longest_of "$name")
# Twenty times the input, and 256 MB, are what a reader may allocate at once. No input takes 5 seconds, unless the machine is busy.
if ! "$folder/tests/fuzz/$name" "$corpus" -max_total_time="$seconds" -timeout="${WRINKLE_FUZZ_TIMEOUT:-5}" -rss_limit_mb=2048 \
    -malloc_limit_mb=$((256 + 20 * longest / 1000000)) -max_len="$longest" -artifact_prefix="$folder/finds/$name-" \
    -print_final_stats=1 >"$log" 2>&1; then
    tail -n 60 "$log"
    echo "$name: a find, in $folder/finds" >&2
    exit 255  # ends xargs, too
fi
echo "$name: $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") inputs in $seconds s"
