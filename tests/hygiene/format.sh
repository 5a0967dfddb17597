#!/usr/bin/env bash
# Every C file is laid out as .clang-format says. Another release of clang-format lays out otherwise,
# so only the one of Debian 12 is asked.
set -euo pipefail
. "$(dirname -- "$0")/files.sh"

tool=$(command -v clang-format-14 || command -v clang-format || true)
if [ -z "$tool" ] || ! "$tool" --version | grep -q 'version 14\.'; then
    echo "no clang-format 14 here"
    exit "$SKIPPED"
fi
own_files '*.c' '*.h' '*.cu' | tr '\n' '\0' | xargs -0 "$tool" --dry-run -Werror
