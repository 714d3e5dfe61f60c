#!/usr/bin/env bash
# keep.sh FOLDER [HARNESS...]: makes corpus/*.zip of this folder from the corpus of the built FOLDER: the fewest inputs
# that reach what all of them reach, but for long ones. corpus_test.cpp reads them in every run of the tests.
set -euo pipefail
folder=$(readlink -f "$1")
shift
here=$(readlink -f "$(dirname "$0")")
export ASAN_OPTIONS=detect_leaks=0
mkdir -p "$here/corpus"
[ $# -gt 0 ] || set -- $(cd "$folder/tests/fuzz" && ls -d ./*_fuzz)
for name in "${@#./}"; do
    longest=8192
    [ "$name" != nvdb_fuzz ] || longest=400000
    fewest=$(mktemp -d)
    find "$folder/corpus/$name" -type f -size -"$((longest + 1))"c -exec cp -t "$fewest" {} +
    all=$fewest.all
    mv "$fewest" "$all"
    mkdir "$fewest"
    "$folder/tests/fuzz/$name" -merge=1 -max_len="$longest" "$fewest" "$all" >/dev/null 2>&1
    (cd "$fewest" && rm -f "$here/corpus/$name.zip" && python3 -m zipfile -c "$here/corpus/$name.zip" ./*)
    echo "$name: $(ls "$fewest" | wc -l) inputs, $(stat -c %s "$here/corpus/$name.zip") bytes"
    rm -r "$fewest" "$all"
done
