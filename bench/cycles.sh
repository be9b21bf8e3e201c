#!/bin/sh
# argand reference beside Blender's Cycles (Debian's blender): colours, cost and noise.
#
#   bench/cycles.sh colors
#   bench/cycles.sh cost MODEL.glb ENVIRONMENT.hdr [--size 1024] [--runs 3]
#
# cycles.py says what is compared; --argand PROGRAM, --samples N, --keep FOLDER go first.
set -eu
if ! command -v blender >/dev/null; then
    echo "There is no blender here (Debian's package blender): nothing to compare with."
    exit 77
fi
exec blender -b --factory-startup --python-exit-code 1 -P "$(dirname "$0")/cycles.py" -- "$@"
