#!/bin/sh
# Install what packages.txt lists and this machine lacks.
#
#   scripts/packages.sh SECTION...     sections of packages.txt: build run test format
#
# Says first what it will install; says nothing when all is there.  Uses sudo only when
# it must.
set -eu

list=$(dirname "$0")/../packages.txt

die() {
    echo "packages: $*" >&2
    exit 1
}

# The packages of the sections asked for.  A section starts with "## name".
wanted=$(awk -v sections=" $* " '
    /^## / { inside = index(sections, " " $2 " "); next }
    { sub(/#.*/, "") }
    inside && NF { print $1 }' "$list")
[ -n "$wanted" ] || die "no such section: $*"

if ! command -v dpkg-query >/dev/null 2>&1; then
    echo "packages: this is not Debian; install the equivalents of:" $wanted >&2
    exit 0 # CMake names what it does not find
fi

missing_of() { # which of the arguments are not installed
    present=$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' "$@" 2>/dev/null |
        sed -n 's/^installed //p' || true)
    for package in "$@"; do
        echo "$present" | grep -qxF "$package" || echo "$package"
    done
}

missing=$(missing_of $wanted)
[ -n "$missing" ] || exit 0
echo "packages: installing from Debian:" $missing

as_root=
if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null 2>&1 ||
        die "root is needed and sudo is not there; as root run: apt-get install" $missing
    as_root=sudo
fi

apt() {
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0 "$@"
}

has_candidates() { # does the local index know all of them?
    for package in $missing; do
        apt-cache policy "$package" | grep -q 'Candidate: [^(]' || return 1
    done
}

has_candidates || apt update || die "apt-get update failed; is there a network?"
# An old index names files that the mirror no longer has: refresh it and try once more.
apt install -y --no-install-recommends $missing >/dev/null ||
    { apt update && apt install -y --no-install-recommends $missing >/dev/null; } ||
    die "apt-get could not install:" $missing
still=$(missing_of $wanted)
[ -z "$still" ] || die "still missing after the installation:" $still
