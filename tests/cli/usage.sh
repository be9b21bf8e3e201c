#!/bin/sh
# The command line without a picture: help, bad usage, bad files.  Needs no Vulkan.
#
#   usage.sh ARGAND JSON_HAS
set -eu
. "$(dirname "$0")/helpers.sh"

# Help.
"$argand" >out 2>err && fail "argand alone is no success"
[ $? -ne 0 ] || true
grep -q '^usage: argand render' err || fail "argand alone prints its usage"
"$argand" --version | grep -qx 'argand [0-9]*\.[0-9]*\.[0-9]*' || fail "--version"
for command in render info devices demo help; do
    "$argand" help | grep -q "^  $command " || fail "help lists $command"
    "$argand" help $command | grep -q "^usage: argand $command" || fail "help $command"
    "$argand" $command --help >out || fail "$command --help"
    "$argand" help $command | cmp -s - out || fail "$command --help is help $command"
done
"$argand" help render | grep -q 'argand render helmet.glb -o helmet.png' || fail "no example"
"$argand" demo | grep -q '^demo:spheres ' || fail "demo lists the spheres"
expect 2 "did you mean 'render'" rendr x.glb
expect 2 "argand render x.glb -o picture.png" x.glb
expect 2 "\`argand help\` lists them" xyzzy
expect 2 "did you mean 'devices'" help device

# Bad usage of render: what is wrong, with what, and what would be right.
bad() {
    text=$1
    shift
    expect 2 "$text" render "$triangle" -o x.png "$@"
    nothing_left
}
bad "--size: '12' is not WxH; try --size 1024x1024" --size 12
bad "'0x5' has no pixels" --size 0x5
bad "'16385x16384' has more than 268435456 pixels" --size 16385x16384
bad "is not WxH" --size 99999999999x1
bad "is not WxH" --size 4294967297x1
bad "is not WxH" --size -5x5
bad "is not WxH" --size 5x5x
bad "did you mean '--size'" --sise 5x5
bad "\`argand help render\` lists them" --zzzzzzzz
bad "--fov: 'nan' is not a number" --fov nan
bad "is not a number" --fov inf
bad "is not a number" --fov 0x20
bad "is not a number" --fov " 45"
bad "is not a number" --fov 45deg
bad "is not a number" --fov ""
bad "not between 0.01 and 179 degrees" --fov 0
bad "not between 0.01 and 179 degrees" --fov 180
bad "is not a number" --exposure 1e39
bad "not a factor above 0" --exposure -1
bad "not a factor above 0" --exposure 0
bad "not a factor above 0" --env-intensity 0
bad "not between -32 and 32" --ev100 33
bad "is not a number" --env-rotation north
bad "THETA,PHI,RADIUS" --orbit 1,2
bad "THETA,PHI,RADIUS" --orbit 1,2,3,4
bad "THETA,PHI,RADIUS" --orbit 1,,3
bad "THETA,PHI,RADIUS" --orbit 1,nan,3
bad "PHI outside" --orbit 0,181,1
bad "RADIUS below 0 metres" --orbit 0,90,-1
bad "X,Y,Z in metres" --target 1,2
bad "X,Y,Z in metres" --target 1,2,1e40
bad "not one of none, reinhard, aces, aces-narkowicz, neutral or agx" --tonemap filmic
bad "not one of fast, default or best" --quality great
bad "not env, transparent or a colour" --background red
bad "not env, transparent or a colour" --background '#12345'
bad "--background needs a value; try --background '#ffffff'" --background
bad "--size needs a value" --size --json
bad "--json takes no value" --json=yes
bad "neither studio, sky or none nor a file" --env sudio
bad "one argument too many" other.glb
bad "give one or the other" --camera 0 --orbit 0,90,1
bad "give one of them" --exposure 1 --ev100 0
bad "give one of them" --quiet --verbose
bad "--device: '' is empty" --device ""
expect 2 "where should the picture go" render "$triangle"
expect 2 "which file" render -o x.png
expect 2 "which file" info
expect 2 "one argument too many" devices x
expect 2 "did you mean demo:spheres" render demo:sphere -o x.png
expect 2 "must end in .png, .jpg, .webp, .exr or .hdr" render "$triangle" -o x.bmp
expect 2 "must end in" render "$triangle" -o png

# The place of the picture is looked at first.
expect 1 "the folder 'no/where' does not exist" render "$triangle" -o no/where/x.png
mkdir folder.png
expect 1 "is a folder" render "$triangle" -o folder.png
rmdir folder.png
if [ "$(id -u)" -ne 0 ]; then # root may write everywhere
    mkdir locked
    chmod a-w locked
    expect 1 "cannot be written into 'locked'" render "$triangle" -o locked/x.png
    rmdir locked
fi

# Bad files.
expect 1 "none.glb" info none.glb
expect 1 "$here" info "$here"
: >empty.glb
expect 1 "empty.glb" info empty.glb
head -c 300 "$triangle" >cut.gltf
expect 1 "cut.gltf" info cut.gltf
head -c 4096 /dev/urandom >noise.glb
expect 1 "noise.glb" info noise.glb
sed 's/"extensionsUsed"/"extensionsRequired": ["XYZ_materials_plaid"], "extensionsUsed"/' \
    "$triangle" >required.gltf
expect 1 "XYZ_materials_plaid" info required.gltf
rm ./*.gltf ./*.glb
nothing_left

# What is in a file.
"$argand" info "$triangle" >out 2>err || fail "info"
grep -q '^  triangles   1$' out || fail "info counts the triangle"
grep -q 'camera 0: front, perspective' out || fail "info names the camera"
grep -q 'XYZ_materials_plaid: not supported' out || fail "info names what is not supported"
"$argand" info "$triangle" --json >out 2>err || fail "info --json"
"$json" out triangles=1 meshes=1 cameras.0.name=front extensions.1.supported=false warnings ||
    fail "info --json"
# A name that is not UTF-8 and has quotes must not break the JSON.
odd=$(printf 'a\377"\\\t.gltf')
cp "$triangle" "$odd"
"$argand" info "$odd" --json >out 2>err || fail "info of an odd name"
"$json" out input triangles=1 || fail "JSON with an odd name"
rm "$odd"

# Output that cannot be written is a failure.
if [ -c /dev/full ]; then
    if "$argand" demo >/dev/full 2>err; then fail "a full standard output is no success"; fi
    grep -q 'standard output cannot be written' err || fail "a full standard output"
fi
