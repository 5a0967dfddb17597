#!/usr/bin/env bash
# The backend compiles for aarch64; without a cross compiler the check is skipped.
set -euo pipefail
. "$(dirname -- "$0")/files.sh"

compiler=aarch64-linux-gnu-gcc
if ! command -v "$compiler" >/dev/null; then
    echo "no $compiler here"
    exit "$SKIPPED"
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for source in "$root"/engine/backend/*.c "$root"/engine/base/*.c; do
    "$compiler" -std=gnu17 -O2 -Wall -Wextra -Werror -Wno-psabi -fopenmp -I "$root/engine" \
        -DSWEEP_SUFFIX=native -DSWEEP_LEVEL='"aarch64"' \
        -DSWEEP_KERNEL=KERNEL_WENDLAND -DSWEEP_KERNEL_NAME=wendland -c "$source" -o "$work/object.o"
done
