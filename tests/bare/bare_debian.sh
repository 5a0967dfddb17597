#!/usr/bin/env bash
# Does `./fairlead` set everything up on a Debian 12 that has nothing?
#   bare_debian.sh [FOLDER [test]]     as root, with debootstrap; needs about 4 GB in FOLDER
# Makes a minimal root in FOLDER/base (kept, so that a second trial is quicker), copies it to
# FOLDER/trial, clones the committed tree into it under a name with a space and, inside, builds and
# runs a short case and asks the studio for its page; with the word `test` it also runs every test that CI
# runs. The package mirror, npm's registry and certificates are this machine's own, asked
# for at run time. Without FOLDER a temporary one is used and removed.
set -euo pipefail

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd -P)
release=bookworm

say() { printf 'bare: %s\n' "$*"; }
die() {
    printf 'bare: error: %s\n' "$*" >&2
    exit 1
}

# The sources this machine gets Debian's packages from, as lines for sources.list.
debian_sources() {
    # shellcheck disable=SC2016 # apt-get fills these in
    apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' |
        awk -v release="$release" '
            $2 ~ "^" release && !seen[$0]++ { printf "deb %s %s %s\n", $1, $2, $3 }'
}

make_base() {
    local mirror
    mirror=$(debian_sources | awk -v release="$release" '$3 == release { print $2; exit }')
    [ -n "$mirror" ] || die "apt on this machine has no source for $release (apt-get update first?)"
    say "making a minimal $release"
    debootstrap --variant=minbase "$release" "$folder/base.new" "$mirror" >"$folder/debootstrap.log" 2>&1 ||
        die "debootstrap failed (log: $folder/debootstrap.log)"
    debian_sources >"$folder/base.new/etc/apt/sources.list"
    apt-config dump --no-empty --format '%f "%v";%n' |
        grep -E '^Acquire::(https?|Check|ForceIP|Retries|Languages)' \
            >"$folder/base.new/etc/apt/apt.conf.d/99trial" || true
    mv "$folder/base.new" "$folder/base"
}

# What the network needs, which is the machine's and not Debian's.
share_network() {
    cp -L /etc/resolv.conf /etc/hosts "$trial/etc/"
    mkdir -p "$trial/opt/trial"
    cp -L "${NODE_EXTRA_CA_CERTS:-/etc/ssl/certs/ca-certificates.crt}" "$trial/opt/trial/ca.crt" 2>/dev/null || true
    {
        env | grep -iE '^(https?|no|all)_proxy=' || true
        echo "NODE_EXTRA_CA_CERTS=/opt/trial/ca.crt"
        echo "npm_config_cafile=/opt/trial/ca.crt"
        if command -v npm >/dev/null; then
            echo "npm_config_registry=$(cd / && npm config get registry 2>/dev/null)"
        fi
    } >"$trial/opt/trial/network.env"
}

inside() {
    local settings
    mapfile -t settings <"$trial/opt/trial/network.env"
    chroot "$trial" env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
        HOME=/root LANG=C.UTF-8 "${settings[@]}" "$@" </dev/null
}

# The trial itself; runs in a mount namespace of its own, so that nothing stays mounted.
try_out() {
    local began=$SECONDS tree="/opt/trial/fair lead"
    mount -t proc proc "$trial/proc"
    mount --rbind /dev "$trial/dev"
    say "./fairlead build"
    inside "$tree/fairlead" build
    say "built after $((SECONDS - began)) s"
    began=$SECONDS
    say "./fairlead run cases/still_water.json"
    inside bash -c "cd '$tree' && ./fairlead run cases/still_water.json --until 0.05 --out /tmp/o --frames 20 --quiet"
    say "ran after $((SECONDS - began)) s"
    inside ls -l /tmp/o
    [ -s "$trial/tmp/o/series.csv" ] || die "the run left no series.csv"
    began=$SECONDS
    inside "$tree/fairlead" explain "$tree/cases/still_water.json" --json >/dev/null
    say "explain answered after $((SECONDS - began)) s"
    inside bash -c "cd '$tree' && $(declare -f page_answers) && page_answers"
    [ "$word" = test ] || return 0
    began=$SECONDS
    say "./fairlead test"
    inside "$tree/fairlead" test
    say "tested after $((SECONDS - began)) s"
}

# Start the studio, ask for its page as a browser would, stop it. Runs inside the trial.
page_answers() {
    local port="" answer began=$SECONDS
    ./fairlead serve --port 0 --data /tmp/data >/tmp/serve.log 2>&1 &
    local server=$!
    while [ -z "$port" ] && kill -0 "$server" && [ $((SECONDS - began)) -lt 60 ]; do
        sleep 0.2
        port=$(sed -nE 's#.*http://127\.0\.0\.1:([0-9]+)/.*#\1#p' /tmp/serve.log)
    done
    cat /tmp/serve.log
    exec 3<>"/dev/tcp/127.0.0.1/$port"
    printf 'GET / HTTP/1.1\r\nHost: 127.0.0.1:%s\r\nConnection: close\r\n\r\n' "$port" >&3
    answer=$(timeout 10 head -n 1 <&3)
    echo "the page answers: $answer"
    kill "$server"
    wait "$server" || true
    [ "${answer#*200}" != "$answer" ]
}

if [ "${1:-}" = --inside ]; then
    folder=$2 trial=$2/trial word=$3
    try_out
    exit
fi

[ "$(id -u)" = 0 ] || die "only root can chroot"
command -v debootstrap >/dev/null || die "debootstrap is missing: apt-get install debootstrap"
if [ "$#" -gt 0 ]; then
    mkdir -p "$1"
    folder=$(cd -- "$1" && pwd -P)
else
    folder=$(mktemp -d)
    trap 'rm -rf --one-file-system "$folder"' EXIT
fi
trial=$folder/trial

[ -d "$folder/base" ] || make_base
rm -rf --one-file-system "$trial"
cp -a "$folder/base" "$trial"
share_network
git clone --quiet --no-hardlinks "$root" "$trial/opt/trial/fair lead"
say "$(git -C "$root" log -1 --format='trying %h %s')"
unshare --mount bash "$0" --inside "$folder" "${2:-}"
say "the set-up works on a bare $release"
