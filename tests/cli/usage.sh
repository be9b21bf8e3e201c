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
for command in render reference compare convert info devices demo help; do
    "$argand" help | grep -q "^  $command " || fail "help lists $command"
    "$argand" help $command | grep -q "^usage: argand $command" || fail "help $command"
    "$argand" $command --help >out || fail "$command --help"
    "$argand" help $command | cmp -s - out || fail "$command --help is help $command"
done
"$argand" help render | grep -q 'argand render helmet.glb -o helmet.png' || fail "no example"
"$argand" help render | grep -q "^  sphere       cd   at radius range hidden" || fail "no lights"
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
bad "not a number" --exposure automatic
bad "not an f-number" --aperture 0
bad "nor 1/N" --shutter 1/x
bad "not between 0.000001" --shutter 1/0
bad "not an ISO speed" --iso 100,200
bad "not average, center, spot" --metering spot:1,1
bad "no place X,Y" --metering spot=1
bad "outside the picture" --metering spot=0.5,1.5
bad "not two EV100" --exposure-limits 3
bad "lesser to a greater" --exposure-limits 3,2
bad "leaves nothing" --exposure-limits 0,0
bad "between 1667 and 25000" --white-balance 1000
bad "tint outside" --white-balance 5000,151
bad "not KELVIN" --white-balance 5000,1,1
bad "is not a share of 0 to 1" --bloom 1.5
bad "is not a share of 0 to 1" --bloom=-0.1
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
bad "not one of srgb or gamma2.2" --transfer linear
bad "not one of exact, ltc or representative-point" --area-lights good
bad "comes from no text whose look --correct could replace" --correct
bad "not one of fast, default or best" --quality great
bad "not env, transparent or a colour" --background red
bad "not env, transparent or a colour" --background '#12345'
bad "--background needs a value; try --background '#ffffff'" --background
bad "--size needs a value" --size --json
bad "--json takes no value" --json=yes
bad "neither studio, sky or none nor a file" --env sudio
bad "--light: '' is empty; try --light 'sphere at=0,2,1 radius=0.1 intensity=100'" --light ""
bad "--light needs a value; try --light 'sphere at" --light
bad "begins with 'spere', which is no kind of light: there are point, spot, dir" --light "spere a=1"
bad "tube, ambient, hemispheric and harmonics; try" --light at=0,1,0
while IFS='|' read -r light text; do
    bad "'$light' $text" --env none --light point --light "$light"
done <<'END'
sphere|lacks radius=, which a light of kind sphere needs
rect width=1|lacks height=
tube radius=1|lacks length=
harmonics|lacks terms=
sphere radius|gives 'radius' no value
sphere radius=|gives 'radius' no value
sphere radius=nan|has radius=nan, which is not a number
sphere radius=-1|has radius=-1, which is below 0
sphere radius=1e39|has radius=1e39, which is not a number
sphere radius=1 radius=1|says 'radius' twice
sphere radius=1 to=0,1,0|has 'to', which a light of kind sphere does not take: it takes at, radius,
ambient at=0,0,0|has 'at', which a light of kind ambient does not take: it takes color, intensity
sphere =1|has '', which a light of kind sphere does not take
sphere radius=1 at=1,2|has at=1,2, which is not three numbers X,Y,Z
sphere radius=1 at=1,2,3,4|has at=1,2,3,4, which is not three numbers
sphere radius=1 hidden=1|gives 'hidden' a value; it takes none
point color=1,-1,1|has color=1,-1,1, which has a weight below 0
point color=0,0,0|has color=0,0,0, which is black; intensity=0 makes a light dark
point intensity=inf|has intensity=inf, which is not a number
spot inner=45|has an inner angle of 45 degrees that is not below the outer one of 45
spot outer=90.1|has outer=90.1, which is not between 0 and 90 degrees
spot direction=0,0,0|has direction=0,0,0, which has no direction
spot to=1,0,0 direction=1,0,0|has both to= and direction=; give one of them
spot to=0,0,0|shines to where it stands
sun angle=90|has angle=90, which is not between
harmonics terms=1,2,3|has terms=1,2,3, which is not 4, 9, 12 or 27 numbers
END
bad "'$(printf '%0600d' 0)' has a word of 600 letters; try" --light "$(printf '%0600d' 0)"
bad "is one too many: at most 256 are taken" $(yes -- --light=point | head -n 257)
bad "one argument too many" other.glb
bad "give one or the other" --camera 0 --orbit 0,90,1
bad "give one of them" --exposure 1 --ev100 0
bad "give one of them" --exposure auto --aperture 4 --shutter 1
bad "give one of them" --ev100 3 --iso 200
bad "only --iso may be left out" --aperture 4
bad "only --iso may be left out" --shutter 1/30 --iso 400
bad "add --exposure auto" --metering spot
bad "add --exposure auto" --exposure 2 --exposure-limits 1,5
bad "give one of them" --quiet --verbose
bad "--device: '' is empty" --device ""
expect 2 "where should the picture go" render "$triangle"
expect 2 "which file" render -o x.png
expect 2 "which file" info
expect 2 "one argument too many" devices x
expect 2 "did you mean demo:spheres" render demo:sphere -o x.png
expect 2 "demo:spheres: comes from no text" render demo:spheres --correct -o x.png
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

# A scene as a file.
expect 2 "convert: which file? Try: argand convert model.gltf -o scene.glb" convert -o x.glb
expect 2 "convert: where should the scene go? Add: -o scene.glb" convert "$triangle"
expect 2 "x.gltf: its name must end in .glb" convert "$triangle" -o x.gltf
expect 2 "there is no option '--size'" convert "$triangle" -o x.glb --size 1x1
expect 2 "give one of them" convert "$triangle" -o x.glb --quiet --verbose
expect 2 "did you mean demo:spheres" convert demo:sphere -o x.glb
expect 1 "the folder 'no' does not exist" convert "$triangle" -o no/x.glb
expect 1 "none.glb" convert none.glb -o x.glb
expect 1 "none.hdr" convert demo:spheres -o x.glb --env ./none.hdr
nothing_left
"$argand" convert demo:spheres -o x.glb >out 2>err || fail "convert"
[ ! -s err ] || fail "convert says something"
grep -Eqx 'x.glb: [0-9,]+ triangles, 0 textures, [0-9]+ lights' out || fail "the closing line"
"$argand" convert x.glb -o y.glb --quiet --env sky --light 'sphere radius=1 at=1,2,3' >out 2>err ||
    fail "convert what was converted"
[ ! -s out ] && [ ! -s err ] || fail "--quiet says something"
"$argand" convert y.glb -o y.glb --light sun >out || fail "convert onto itself"
"$argand" info y.glb --json >out 2>err || fail "info of what was converted"
"$json" out lights.0.kind=sphere lights.0.position.1=2 lights.1.kind=sun ||
    fail "convert lost the lights"
rm x.glb y.glb
nothing_left

# What is in a file.
"$argand" info "$triangle" >out 2>err || fail "info"
grep -q '^  triangles   1$' out || fail "info counts the triangle"
grep -q 'camera 0: front, perspective' out || fail "info names the camera"
grep -q 'XYZ_materials_plaid: not supported' out || fail "info names what is not supported"
"$argand" info "$triangle" --json >out 2>err || fail "info --json"
"$json" out triangles=1 meshes=1 cameras.0.name=front extensions.1.supported=false warnings ||
    fail "info --json"
sed 's/"KHR_materials_unlit"/"ARGAND_lights"/; s/"name": "front"$/&, "extensions": {'\
'"ARGAND_lights": {"light": 0}}/; s/^ "meshes"/ "extensions": {"ARGAND_lights": {"lights": ['\
'{"type": "sphere", "radius": 0.5, "intensity": 9}], "exposure": {"factor": 2}}},&/' \
    "$triangle" >lamp.gltf
"$argand" info lamp.gltf >out 2>err || fail "info of a lamp"
grep -qx '  light 0: sphere, 9 cd, radius 0.5 m' out || fail "info names the light"
grep -qx '  exposure    2' out || fail "info names the exposure"
"$argand" info lamp.gltf --json >out 2>err || fail "info --json of a lamp"
"$json" out lights.0.kind=sphere lights.0.radius=0.5 lights.0.position exposure=2 ||
    fail "info --json lacks the light"
rm lamp.gltf
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
