#!/usr/bin/env bash
# Every case named in tests/bad_cases/expected.txt ("file|words") is refused with exit code 2 and one
# line on stderr that has these words. Run from the top of the tree: bad_cases.sh PROGRAM
set -uo pipefail

program=$1 list=tests/bad_cases/expected.txt
[ -f "$list" ] || {
    echo "$list is not there"
    exit 77
}

count=0 failed=0
while IFS='|' read -r file words; do
    case $file in '' | '#'*) continue ;; esac
    count=$((count + 1))
    said=$("$program" explain "tests/bad_cases/$file" 2>&1 >/dev/null)
    code=$?
    lines=$(printf '%s\n' "$said" | grep -c .)
    if [ "$code" != 2 ] || [ "$lines" != 1 ] || [[ "$said" != *"$words"* ]]; then
        failed=$((failed + 1))
        echo "FAIL $file: exit $code, $lines lines, expected words: $words"
        printf '%s\n' "$said" | head -3
    fi
done <"$list"
echo "$((count - failed)) passed, $failed failed"
[ "$count" -gt 0 ] && [ "$failed" -eq 0 ]
