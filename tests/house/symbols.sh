#!/bin/sh
# Does the library export nothing but ag_*, and need no window system?
#
#   symbols.sh LIBRARY
set -eu
names=$(nm -D --defined-only "$1" | awk '{ print $3 }')
count=$(echo "$names" | grep -c '^ag_')
echo "$count symbols ag_*"
[ "$count" -ge 20 ]
# Instrumented builds add names of the compiler's own.
foreign=$(echo "$names" | grep -vE '^(ag_|__odr_asan|__gcov|__asan|__ubsan|__sanitizer)' || true)
[ -z "$foreign" ] || { echo "exported besides:" $foreign; exit 1; }

windows=$(readelf -d "$1" | grep -E 'NEEDED.*lib(X11|xcb|wayland|glfw|GL|EGL|SDL)' || true)
[ -z "$windows" ] || { echo "linked: $windows"; exit 1; }
