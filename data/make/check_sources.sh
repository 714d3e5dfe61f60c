#!/bin/sh
# Checks data/ against data/SHA256SUMS: every checksum must hold, and every file must have one, except the two lists
# themselves and what is written by hand (make/, scenes/, figures/, kernels/, blender/*.py).
set -eu
cd "$(dirname "$0")/.."

sha256sum --check --strict --quiet SHA256SUMS

unlisted=$(find . -path ./make -prune -o -path ./scenes -prune -o -path ./figures -prune -o -path ./kernels -prune -o ! -path './blender/*.py' -type f ! -path ./SOURCES.md ! -path ./SHA256SUMS -print |
    sed 's|^\./||' | while IFS= read -r file; do
        sed 's/^[0-9a-f]* [ *]//' SHA256SUMS | grep -Fxq -e "$file" || printf '%s\n' "$file"
    done)
if [ -n "$unlisted" ]; then
    printf 'not in data/SHA256SUMS:\n%s\n' "$unlisted" >&2
    exit 1
fi
