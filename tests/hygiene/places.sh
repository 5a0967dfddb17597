#!/usr/bin/env bash
# Nothing in the tree depends on the machine it was written on: no absolute home or work folder and no
# package registry's host. (The words are put together here so that this file passes its own check.)
set -euo pipefail
. "$(dirname -- "$0")/files.sh"

slash=/ dot='\.'
words="${slash}(work|root|home)${slash}|registry${dot}[a-z]|npmjs${dot}(org|com)|deb${dot}debian${dot}org"
if git ls-files --cached --others --exclude-standard -z | xargs -0 grep -nIE "(^|[^A-Za-z0-9_.}\$])($words)"; then
    echo "these lines name a place that is not part of the project"
    exit 1
fi
