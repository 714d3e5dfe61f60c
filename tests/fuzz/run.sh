#!/usr/bin/env bash
# run.sh FOLDER SECONDS: runs every harness of the built FOLDER for SECONDS from the corpus that FOLDER/corpus keeps, which
# begins with the files of data/. Fails at the first find, which lies in FOLDER/finds then.
set -euo pipefail
folder=$(readlink -f "$1")
seconds=$2
data=$(readlink -f "$(dirname "$0")/../../data")
export ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=0 UBSAN_OPTIONS=print_stacktrace=1
export WRINKLE_FUZZ_READER=$folder/wrinkle

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

for program in "$folder"/tests/fuzz/*_fuzz; do
    name=$(basename "$program")
    corpus=$folder/corpus/$name
    mkdir -p "$corpus" "$folder/finds"
    seeds_of "$name" | while read -r seed; do cp -n "$seed" "$corpus/$(sha1sum <"$seed" | cut -c1-16)"; done
    log=$folder/finds/$name.log
    if ! "$program" "$corpus" -max_total_time="$seconds" -timeout=5 -rss_limit_mb=1024 -malloc_limit_mb=512 \
        -max_len=65536 -artifact_prefix="$folder/finds/$name-" -print_final_stats=1 >"$log" 2>&1; then
        tail -n 60 "$log"
        echo "$name: a find, in $folder/finds" >&2
        exit 1
    fi
    echo "$name: $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") inputs in $seconds s"
done
