#!/usr/bin/env bash
# Every file that a page of documentation links to or names as a case is there.
set -euo pipefail
. "$(dirname -- "$0")/files.sh"

bad=0 looked=0
while IFS= read -r page; do
    folder=$(dirname -- "$page")
    while IFS= read -r target; do
        looked=$((looked + 1))
        if [ ! -e "$folder/$target" ] && [ ! -e "$target" ]; then
            echo "$page: $target is not there"
            bad=1
        fi
    done < <({
        grep -oE '\]\([^)#]+' "$page" | sed 's/^](//' | grep -vE '^[a-z]+:' || true
        grep -oE 'src="[^"]+' "$page" | sed 's/^src="//' | grep -vE '^[a-z]+:' || true
        grep -oE '\bcases/[A-Za-z0-9_/]+\.json' "$page" || true
    } | sort -u)
done < <(own_files README.md 'docs/*.md')
echo "$looked names looked at"
[ "$looked" -gt 0 ] || bad=1
exit "$bad"
