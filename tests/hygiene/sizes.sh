#!/usr/bin/env bash
# Files of at most 600 lines (page modules: 300) and functions of at most 60. A function is counted
# from its opening brace in the first column to the closing one; one of up to 80 lines that reads as a
# list is told but passes. Tables and generated text are not functions.
set -euo pipefail
. "$(dirname -- "$0")/files.sh"

{
    own_files '*.c' '*.h' '*.cu' '*.sh' '*.mjs' fairlead
    own_files '*.ts' '*.tsx'
} | grep -v '^assets/' | sort -u | awk '
{ files[++file_count] = $0 }
END {
    for (f = 1; f <= file_count; f++) {
        file = files[f]
        limit = file ~ /\.tsx?$/ && file !~ /test/ ? 300 : 600
        line = 0
        while ((getline text < file) > 0) {
            line++
            if (file !~ /\.(c|h|cu)$/) continue
            if (text ~ /^[a-zA-Z].*\(/) { head = text; sub(/\(.*/, "", head); sub(/.*[ *]/, "", head) }
            if (text ~ /^\{$/) begin = line
            if (text ~ /^\}/ && begin) {
                length_of = line - begin - 1
                if (length_of > 80) { bad = 1; mark = "too long" } else mark = "note"
                if (length_of > 60)
                    printf "%s:%d: %s: %s has %d lines, 60 are wanted\n", file, begin, mark, head, length_of
                begin = 0
            }
        }
        close(file)
        if (line > limit) { printf "%s: %d lines, at most %d\n", file, line, limit; bad = 1 }
    }
    printf "%d files looked at\n", file_count
    exit bad || !file_count
}'
