#!/usr/bin/env bash
# No shell script gives shellcheck anything to say.
set -euo pipefail
. "$(dirname -- "$0")/files.sh"

if ! command -v shellcheck >/dev/null; then
    echo "no shellcheck here"
    exit "$SKIPPED"
fi
own_files '*.sh' fairlead .ci/run | tr '\n' '\0' | xargs -0 shellcheck -x
