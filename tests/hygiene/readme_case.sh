#!/usr/bin/env bash
# The program accepts the case that README.md shows, and README.md shows each of its subcommands.
#   readme_case.sh PROGRAM
set -euo pipefail
. "$(dirname -- "$0")/files.sh"

program=$1
case_file=$(mktemp --suffix=.json)
trap 'rm -f "$case_file"' EXIT
# shellcheck disable=SC2016 # backquotes of Markdown
sed -n '/^```json/,/^```/p' README.md | sed '1d;$d' >"$case_file"
"$program" explain "$case_file"
for word in $("$program" --help | sed -nE 's/^  ([a-z]+)  .*/\1/p'); do
    grep -qE "\./fairlead $word( |\`|\$)" README.md || {
        echo "README.md does not show ./fairlead $word"
        exit 1
    }
done
