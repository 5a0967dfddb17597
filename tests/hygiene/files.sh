# For the checks here: where the tree is and which files are the project's own. Sourced.
# shellcheck shell=bash
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd -P)
cd "$root" || exit 1

# Exit status that ctest counts as skipped.
# shellcheck disable=SC2034 # used by those who source this
SKIPPED=77

# Files of the tree that git knows or would take, matching any of the given pathspecs, one a line.
own_files() {
    git ls-files --cached --others --exclude-standard -- "$@" | while IFS= read -r file; do
        [ ! -f "$file" ] || printf '%s\n' "$file"
    done
}
