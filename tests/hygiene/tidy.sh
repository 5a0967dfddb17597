#!/usr/bin/env bash
# clang-tidy has nothing to say about engine, render and server.
#   tidy.sh BUILD [CHECKS]
# BUILD has compile_commands.json. A file is looked at again only when it, a header, .clang-tidy or its
# flags changed: what was clean is remembered in BUILD/tidy.
set -euo pipefail
. "$(dirname -- "$0")/files.sh"

build=$1 checks=${2:-}
tool=$(command -v clang-tidy-14 || command -v clang-tidy || true)
if [ -z "$tool" ]; then
    echo "no clang-tidy here"
    exit "$SKIPPED"
fi

mkdir -p "$build/tidy"
# A file that is compiled at several instruction levels is looked at once; of gcc's -f options clang
# knows some only, and needs none but those for OpenMP.
awk 'BEGIN { RS = "\n}"; printf "[" }
    match($0, /"file": "[^"]*"/) && !seen[substr($0, RSTART, RLENGTH)]++ {
        sub(/^[^{]*/, "")
        gsub(/ -fopenmp/, " @openmp")
        gsub(/ -f[^ ]*/, "")
        gsub(/ @openmp/, " -fopenmp")
        printf "%s%s\n}", count++ ? "," : "", $0
    }
    END { print "]" }' "$build/compile_commands.json" >"$build/tidy/compile_commands.json"
common=$({
    own_files '*.h' '*.def' '.clang-tidy' | tr '\n' '\0' | xargs -0 cat
    cat "$build/tidy/compile_commands.json"
    echo "$checks"
} | sha256sum | cut -d' ' -f1)
# omp.h is gcc's: alone in a folder, for gcc's stdatomic.h must not stand in for clang's, and without the
# attribute's arguments that clang does not know.
gcc_headers=$build/tidy/gcc
mkdir -p "$gcc_headers"
rm -f "$gcc_headers/omp.h" # an earlier version left a link to gcc's own file here
sed -E 's/__malloc__ *\([^)]*\)/__malloc__/g' "$(gcc -print-file-name=include)/omp.h" >"$gcc_headers/omp.h"

look_at() {
    local file=$1 stamp digest
    stamp=$build/tidy/$(tr '/' '_' <<<"$file")${checks:+.deep}
    digest=$common-$(sha256sum <"$file")
    [ "$(cat "$stamp" 2>/dev/null)" != "$digest" ] || return 0
    if "$tool" -p "$build/tidy" --quiet ${checks:+"--checks=$checks"} \
        --extra-arg=-Wno-unknown-warning-option --extra-arg=-idirafter"$gcc_headers" \
        "$file" 2>"$stamp.err"; then
        printf '%s\n' "$digest" >"$stamp"
    else
        # Without a finding the complaint is clang-tidy's own.
        grep -E 'error:' "$stamp.err" || true
        return 1
    fi
}
export -f look_at
export build checks tool common gcc_headers

# shellcheck disable=SC2016 # the inner shell expands it
# What the build does not compile (tools of the developer's) is not looked at.
own_files 'engine/*.c' 'render/*.c' 'server/*.c' |
    while IFS= read -r file; do
        ! grep -qF "\"file\": \"$root/$file\"" "$build/tidy/compile_commands.json" || echo "$file"
    done | tr '\n' '\0' |
    xargs -0 -n 1 -P "$(nproc)" bash -c 'look_at "$1"' look_at
