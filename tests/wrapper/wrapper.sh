#!/usr/bin/env bash
# What ./fairlead promises, tried on a copy of it whose every tool is a stand-in: no package is
# installed, nothing is compiled. Each function fact_* is one fact.
# shellcheck disable=SC2016 # stand-ins and checks are expanded when they run
set -euo pipefail

wrapper=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd -P)/fairlead
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# A tree in a path with a space, and a PATH that holds only what a minimal Debian has plus stand-ins.
fresh() {
    rm -rf "${work:?}"/*
    tree="$work/my tree" bin=$work/bin
    mkdir -p "$tree/web" "$bin"
    cp "$wrapper" "$tree/fairlead"
    echo '{}' >"$tree/web/package.json"
    echo '{}' >"$tree/web/package-lock.json"
    local tool
    for tool in bash cat chmod cp cut date dirname env find flock grep head id mkdir nproc readlink rm sed \
        sha256sum sort tail tr xargs; do
        ln -s "$(command -v "$tool")" "$bin/$tool"
    done
    stand_in id 'echo 0'
    stand_in dpkg-query 'exit 1'
    # apt-get installs a package by making its stand-in executable.
    stand_in apt-get '
        [ "$*" = "${*#*install}" ] && exit 0
        for word; do case $word in -*|install|*=*) ;; *)
            for tool in "$0.offers/$word/"*; do [ ! -e "$tool" ] || cp "$tool" "${0%/*}/"; done ;;
        esac; done'
    mkdir "$bin/apt-get.offers"
    have_all
}

# A program in PATH that writes its call down and does $2.
stand_in() {
    rm -f "$bin/$1"
    printf '#!/bin/bash\necho "%s $*" >>"%s"\n%s\n' "$1" "$work/calls" "$2" >"$bin/$1"
    chmod +x "$bin/$1"
}

have_all() {
    local tool
    for tool in gcc g++ pkg-config chromium clang-format clang-tidy shellcheck git nvcc node; do
        stand_in "$tool" :
    done
    stand_in cmake "printf 'CMAKE_HOME_DIRECTORY:INTERNAL=%s\n' '$tree' >'$tree/build/CMakeCache.txt'
        : >'$tree/build/build.ninja'"
    stand_in ninja "printf '#!/bin/bash\necho program:\"\$*\"; exit 3\n' >'$tree/build/fairlead'
        chmod +x '$tree/build/fairlead'; echo from ninja"
    stand_in npm "case \$1 in ci) mkdir -p node_modules ;; run) mkdir -p dist; : >dist/index.html ;; esac"
    stand_in ctest 'exit 8'
}

# Take a tool away and let apt-get offer it as a package.
offered() {
    mkdir -p "$bin/apt-get.offers/$2"
    mv "$bin/$1" "$bin/apt-get.offers/$2/"
}

# Run the wrapper from elsewhere; leaves $out, $said (stderr) and $status.
call() {
    status=0
    : >"$work/calls"
    (cd / && PATH=$bin exec "$tree/fairlead" "$@") >"$work/out" 2>"$work/said" </dev/null || status=$?
    out=$(cat "$work/out") said=$(cat "$work/said")
}

failures=0
check() {
    if ! eval "$1"; then
        printf '  not true: %s\n  status %s\n  stdout: %s\n  stderr: %s\n' "$1" "$status" "$out" "$said"
        failures=$((failures + 1))
    fi
}
called() { grep -q -- "$1" "$work/calls"; }

fact_words_and_exit_code_reach_the_program() {
    call run 'a case.json' --until 2
    check '[ "$status" = 3 ]'
    check '[ "$out" = "program:run a case.json --until 2" ]'
}

fact_no_word_starts_the_studio() {
    call
    check '[ "$out" = "program:serve" ]'
    check 'called "npm ci" && called "npm run build"'
}

fact_nothing_is_installed_when_nothing_is_missing() {
    call build
    check '[ "$status" = 0 ]'
    check '! called apt-get'
}

fact_only_what_is_missing_is_installed_and_said() {
    offered cmake cmake
    offered g++ build-essential
    call run x
    check '[ "$status" = 3 ]'
    check 'called "apt-get.*install.* build-essential cmake$"'
    check 'grep -q "installing cmake (configures the build)" <<<"$said"'
    check '[ "$(grep -c installing <<<"$said")" = 2 ]'
    check '[ "$out" = "program:run x" ]'
}

fact_a_node_from_elsewhere_counts() {
    offered ninja ninja-build
    call build
    check 'called "install.* ninja-build$"'
    check '! called "nodejs\|npm ninja"'
}

fact_a_package_that_cannot_be_had_is_named_in_one_line() {
    mv "$bin/ninja" "$work/"
    stand_in apt-get 'echo "E: Unable to locate package ninja-build"; exit 100'
    call build
    check '[ "$status" = 1 ]'
    check '[ "$(grep -c error: <<<"$said")" = 1 ]'
    check 'grep -q "error: could not install ninja-build: E: Unable to locate" <<<"$said"'
}

fact_without_root_and_sudo_the_command_to_type_is_told() {
    stand_in id 'echo 1000'
    mv "$bin/ninja" "$work/"
    call build
    check '[ "$status" = 1 ]'
    check 'grep -q "as root: apt-get install ninja-build$" <<<"$said"'
    check '! called apt-get'
}

fact_sudo_is_used_without_root() {
    stand_in id 'echo 1000'
    stand_in sudo '[ "$1" = -n ] && shift; exec "$@"'
    offered ninja ninja-build
    call build
    check '[ "$status" = 0 ]'
    check 'called "sudo -n env DEBIAN_FRONTEND=noninteractive apt-get"'
}

fact_a_missing_optional_part_is_one_line_and_no_error() {
    rm "$bin/nvcc"
    [ ! -x /usr/local/cuda/bin/nvcc ] || return 0
    call build
    check '[ "$status" = 0 ]'
    check '[ "$(grep -c CUDA <<<"$said")" = 1 ]'
}

fact_the_page_is_built_only_when_it_changed() {
    call build
    call build
    check '! called npm'
    echo 'x' >"$tree/web/main.ts"
    call build
    check 'called "npm run build" && ! called "npm ci"'
    echo '{ }' >"$tree/web/package-lock.json"
    call build
    check 'called "npm ci" && called "npm run build"'
}

fact_running_needs_no_node() {
    rm "$bin/node" "$bin/npm"
    call run x
    check '[ "$status" = 3 ]'
    check '! called apt-get'
}

fact_the_build_is_configured_once_and_again_after_a_move_or_an_installation() {
    call build
    check 'called cmake'
    call build
    check '! called cmake'
    offered chromium chromium
    call test
    check 'called cmake'
    sed -i 's/INTERNAL=.*/INTERNAL=elsewhere/' "$tree/build/CMakeCache.txt"
    call build
    check 'called cmake'
}

fact_a_failed_build_is_shown_and_stops() {
    stand_in ninja 'echo "step.c:1: error: no"; exit 1'
    call run x
    check '[ "$status" = 1 ]'
    check 'grep -q "step.c:1" <<<"$said"'
    check '[ -z "$out" ]'
}

fact_test_ends_with_ctest_and_its_exit_code() {
    call test -R waves
    check '[ "$status" = 8 ]'
    check 'called "ctest --test-dir .*my tree/build -LE ^long\$ .*-R waves$"'
}

total=0
while read -r fact; do
    before=$failures
    fresh
    "$fact"
    total=$((total + 1))
    [ "$failures" = "$before" ] && echo "ok   ${fact#fact_}" || echo "FAIL ${fact#fact_}"
done < <(declare -F | sed -n 's/^declare -f \(fact_.*\)/\1/p')
echo "$total facts, $failures checks failed"
[ "$failures" = 0 ] && [ "$total" -gt 0 ]
