#!/bin/sh
# The viewer on a display of its own: first pixels, the whole scene, the time of a frame at full
# resolution, and how coarse the picture must get to come at 20 frames a second.
#
#   view.sh ARGAND FILE|demo:NAME ... [-- OPTION ...]
set -eu
[ $# -ge 2 ] || { sed -n '2,6s/^# \{0,1\}//p' "$0"; exit 2; }
argand=$1
shift
scenes=
while [ $# -gt 0 ] && [ "$1" != -- ]; do
    scenes="$scenes $1"
    shift
done
[ $# -eq 0 ] || shift

folder=$(mktemp -d)
Xvfb -displayfd 3 -screen 0 1400x900x24 3>"$folder/display" 2>/dev/null &
server=$!
trap 'kill $server; rm -r "$folder"' EXIT
while [ ! -s "$folder/display" ]; do sleep 0.05; done
DISPLAY=:$(cat "$folder/display")
export DISPLAY

for scene in $scenes; do
    "$argand" view "$scene" --frames 3 --exit --quiet "$@" # warms the caches
    printf '%s: ' "$scene"
    "$argand" view "$scene" --frames 60 --exit "$@"
done
