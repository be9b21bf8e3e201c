#!/bin/sh
# Install into an empty prefix; build examples/hello.c against it by pkg-config and by
# CMake, as a stranger would; run both.
#
#   install.sh ROOT BUILD CC CFLAGS
set -eu
root=$1 build=$2 cc=$3 cflags=$4
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
prefix=$here/prefix

fail() {
    echo "$*"
    exit 1
}

quietly() { # its output only when it fails
    "$@" >"$here/log" 2>&1 || { cat "$here/log"; fail "$*"; }
}

quietly cmake --install "$build" --prefix "$prefix"
# The tree may be moved: nothing in it knows where it was made.
mv "$prefix" "$here/moved"
prefix=$here/moved
if grep -rlI -e "$here/prefix" -e "$build" "$prefix"; then fail "a file knows its place"; fi

[ -f "$prefix/share/man/man1/argand.1" ] || fail "no man page"
"$prefix/bin/argand" --version | grep -q '^argand [0-9]' || fail "argand does not start"
readelf -d "$prefix/bin/argand" | grep -q 'NEEDED.*libargand.so.0' ||
    fail "argand links no libargand"
pc=$(dirname "$(find "$prefix" -name argand.pc)")
lib=$(dirname "$pc")

run() { # run PROGRAM PICTURE: it must write a PNG of 800 x 600
    LD_LIBRARY_PATH=$lib "$1" "$root/tests/cli/triangle.gltf" "$2" || fail "$1 failed"
    size=$(od -An -tu1 -j16 -N8 "$2" | tr -s ' ')
    [ "$size" = " 0 0 3 32 0 0 2 88" ] || fail "$2 is not 800x600:$size"
}

# By pkg-config.  DESTDIR-like sysroots are left alone: PKG_CONFIG_PATH is enough.
PKG_CONFIG_PATH=$pc pkg-config --exists 'argand >= 0.1' || fail "pkg-config finds no argand"
$cc $cflags -std=c11 -Wall -Wextra -Werror "$root/examples/hello.c" -o "$here/hello" \
    $(PKG_CONFIG_PATH=$pc pkg-config --cflags --libs argand)
run "$here/hello" "$here/pkg-config.png"

# By CMake, as a project of its own.
quietly cmake -S "$root/examples" -B "$here/examples" -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_C_COMPILER="$cc" -DCMAKE_C_FLAGS="$cflags"
quietly cmake --build "$here/examples"
run "$here/examples/hello" "$here/cmake.png"

cmp -s "$here/pkg-config.png" "$here/cmake.png" || fail "the two pictures differ"
lines=$(wc -l <"$root/examples/hello.c")
[ "$lines" -le 60 ] || fail "examples/hello.c has $lines lines, more than 60"
