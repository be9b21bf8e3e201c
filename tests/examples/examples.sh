#!/bin/sh
# Does each example draw the built-in scene of its name, in the look of its text?
#
#   examples.sh ARGAND PICTURES_NEAR EXAMPLES
set -eu
argand=$1 near=$2 examples=$3 size=96
here=$(mktemp -d)
ARGAND_CACHE_DIR=$(mktemp -d)
export ARGAND_CACHE_DIR
mkdir "$here/demo"
trap 'rm -rf "$here" "$ARGAND_CACHE_DIR"' EXIT

for example in specular sphere_lights direct_lighting sun ambient metals; do
    "$examples/$example" "$here" $size >>"$here/log" || { echo "$example failed"; exit 1; }
done
count=0
for picture in "$here"/*.png; do
    name=$(basename "$picture" .png)
    "$argand" render "demo:$name" -o "$here/demo/$name.png" --size ${size}x$size -q
    "$near" "$picture" "$here/demo/$name.png" 0.02 || { echo "$name is not its demo"; exit 1; }
    count=$((count + 1))
done
[ $count -eq 9 ] || { echo "$count pictures, not 9"; exit 1; }
