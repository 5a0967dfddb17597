#!/usr/bin/env bash
# Each header that a GPU backend will share compiles alone, and every FN function in it gets code.
#   headers_alone.sh c17 | cpp17 | cuda
# CUDA is compiled for sm_75 and sm_90; without nvcc the check is skipped.
set -euo pipefail
. "$(dirname -- "$0")/files.sh"

dialect=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

nvcc=$(command -v nvcc || true)
[ -n "$nvcc" ] || nvcc=/usr/local/cuda/bin/nvcc
if [ "$dialect" = cuda ] && [ ! -x "$nvcc" ]; then
    echo "no nvcc here"
    exit "$SKIPPED"
fi

# Names of the functions of a header, one a line.
functions_of() { sed -nE 's/^FN [A-Za-z_0-9 *]*[ *]([a-z_0-9]+)\(.*/\1/p' "$1"; }

# A source that includes one header and takes the address of each of its functions: on the device the
# address is what makes the compiler emit code for a function that nothing calls.
write_source() {
    local header=$1 source=$2 count=0 name
    printf '#include "%s"\n' "${header#engine/}" >"$source"
    if [ "$dialect" = cuda ]; then
        printf '__global__ void take_addresses(void **taken)\n{\n' >>"$source"
    else
        printf 'void take_addresses(void **taken);\nvoid take_addresses(void **taken)\n{\n' >>"$source"
    fi
    for name in $(functions_of "$header"); do
        printf '    taken[%d] = (void *)%s;\n' "$count" "$name" >>"$source"
        count=$((count + 1))
    done
    printf '    taken[%d] = 0;\n}\n' "$count" >>"$source"
    echo "$count"
}

compile() {
    case $dialect in
    c17) gcc -x c -std=c17 -Wall -Wextra -Wshadow -Werror -Iengine -c "$1" -o "$2" ;;
    cpp17) g++ -x c++ -std=c++17 -Wall -Wextra -Wshadow -Werror -Iengine -c "$1" -o "$2" ;;
    cuda)
        "$nvcc" -x cu -std=c++17 -Werror all-warnings -Iengine -c "$1" -o "$2" \
            -gencode arch=compute_75,code=sm_75 -gencode arch=compute_90,code=sm_90
        ;;
    esac
}

bad=0 looked=0
while IFS= read -r header; do
    source=$work/$(tr '/.' '__' <<<"$header").c
    count=$(write_source "$header" "$source")
    looked=$((looked + 1))
    if compile "$source" "$work/out.o"; then
        echo "ok   $header ($count functions)"
    else
        echo "FAIL $header"
        bad=1
    fi
done < <(own_files engine/base/portable.h 'engine/physics/*.h')
[ "$looked" -gt 0 ] || bad=1
exit "$bad"
