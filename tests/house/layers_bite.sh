#!/bin/sh
# Does layers.sh fail on an arrow that is not allowed?  Each line below is put into a copy of
# the house, which it must spoil.
#
#   layers_bite.sh ROOT
set -eu
here=$(cd "$(dirname "$0")" && pwd)
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
mkdir "$copy/docs" "$copy/examples"
cp "$1/docs/architecture.md" "$copy/docs"
cp -r "$1/include" "$1/src" "$1/shaders" "$1/tools" "$copy"

sh "$here/layers.sh" "$copy" >/dev/null || { echo "the untouched copy fails"; exit 1; }
while read -r file line; do
    echo "$line" >"$copy/$file"
    if sh "$here/layers.sh" "$copy" >/dev/null; then
        echo "$file may hold $line"
        exit 1
    fi
    rm "$copy/$file"
done <<'END'
src/base/x.c #include "image/image.h"
src/scene/x.c #include <vulkan/vulkan.h>
src/scene/x.h #include "bake/dfg.h"
src/gpu/x.c #  include "scene/scene.h"
src/cli/x.c #include "base/log.h"
src/image/x.c #include "../scene/scene.h"
src/render/x.c #include "nowhere/x.h"
tools/x.c #include "gpu/device.h"
shaders/physics/x.glsl #include "interop/scene.glsl"
examples/x.c #include <base/log.h>
END
