#!/bin/sh
# The command line with pictures, on the processor's Vulkan device.
#
#   render.sh ARGAND JSON_HAS
set -eu
. "$(dirname "$0")/helpers.sh"
small="--size 64x48 --device cpu"
# The file's unknown extension would be warned about.
folder=$(mktemp -d)
trap 'rm -rf "$here" "$folder" "$ARGAND_CACHE_DIR"' EXIT
sed 's/XYZ_materials_plaid/KHR_materials_ior/' "$triangle" >"$folder/triangle.gltf"
triangle=$folder/triangle.gltf

# Every kind of picture, told by its first bytes.
magic() { # magic FILE OFFSET HEX
    got=$(od -An -tx1 -j"$2" -N"$((${#3} / 2))" "$1" | tr -d ' \n')
    [ "$got" = "$3" ] || fail "$1 begins with $got"
}
for kind in png jpg jpeg webp exr hdr; do
    "$argand" render "$triangle" -o x.$kind $small >out 2>err || fail "render to .$kind"
    [ "$(wc -l <out)" -eq 1 ] || fail "one line on standard output"
    grep -q "^x.$kind: 64x48 pixels in [0-9.]* s on " out || fail "the closing line"
done
magic x.png 0 89504e470d0a1a0a
magic x.png 16 0000004000000030
magic x.jpg 0 ffd8ff
magic x.jpeg 0 ffd8ff
magic x.webp 8 57454250
magic x.exr 0 762f3101
magic x.hdr 0 233f
rm x.*

# In a pipe no progress bar, on a terminal one, nothing with --quiet.
"$argand" render "$triangle" -o x.png $small --quiet >out 2>err || fail "--quiet"
[ ! -s out ] && [ ! -s err ] || fail "--quiet says something"
"$argand" render "$triangle" -o x.png $small 2>err >out || fail "render"
[ ! -s err ] || fail "a bar where there is no terminal"
if command -v script >/dev/null; then
    TERM=xterm script -qec "'$argand' render '$triangle' -o x.png $small" /dev/null >log </dev/null
    grep -q '%' log || fail "no bar on a terminal"
    rm log
fi

# One JSON object with all its parts.
"$argand" render "$triangle" -o x.png $small --json >out 2>err || fail "--json"
"$json" out output=x.png width=64 height=48 device.name device.kind=cpu triangles=1 draws=1 \
    ms.load ms.decode ms.bake ms.compile ms.upload ms.frame ms.readback ms.encode ms.total \
    ms.device ms.environment peak_memory_bytes || fail "--json lacks something"
"$argand" render "$triangle" -o x.png $small --json --validate >out 2>err || fail "--validate"
"$json" out validation_messages=0 || fail "validation messages"

# Every option works, several at once to save time.
while read -r options; do
    "$argand" render "$triangle" -o x.png $small --validate $options >out 2>err || fail "$options"
done <<'END'
--tonemap none --quality fast --env sky --env-rotation 90 --env-intensity .5
--tonemap=reinhard --exposure=2e0 --fov 20 --orbit=-30,75,auto --verbose
--tonemap aces --background #336699 --target 0,auto,1 --orbit auto,auto,5 --ev100=-1
--tonemap aces-narkowicz --background=transparent --env none --camera 0
--tonemap agx --quality=best --camera=front -q
--transfer gamma2.2 --area-lights ltc --light=sun
--transfer=srgb --area-lights representative-point --light=sun
--area-lights exact --light=sun
--quality default --tonemap neutral --env studio --background env -v
END
# A camera through its name is the same camera as through its index; another one is not.
"$argand" render "$triangle" -o a.png $small --camera front >out
"$argand" render "$triangle" -o b.png $small --camera 0 >out
"$argand" render "$triangle" -o c.png $small >out
cmp -s a.png b.png || fail "--camera by name and by index differ"
cmp -s a.png c.png && fail "--camera has no effect"
rm ./*.png

# Coding changes the picture, and not linear light.
"$argand" render "$triangle" -o gamma.png $small --transfer gamma2.2 >out
"$argand" render "$triangle" -o srgb.png $small >out
cmp -s gamma.png srgb.png && fail "--transfer has no effect"
"$argand" render "$triangle" -o gamma.exr $small --transfer gamma2.2 >out
"$argand" render "$triangle" -o srgb.exr $small >out
cmp -s gamma.exr srgb.exr || fail "--transfer changes linear light"
rm ./*.png ./*.exr

# A built-in scene has its text's look, unless told.
demo="render demo:grid --size 32x32 --device cpu"
"$argand" $demo -o text.png >out || fail "demo:grid"
"$argand" $demo -o same.png --tonemap reinhard --transfer gamma2.2 >out
cmp -s text.png same.png || fail "the look of demo:grid is not its text's"
"$argand" $demo -o told.png --transfer srgb >out
cmp -s text.png told.png && fail "--transfer does not win over the look"
"$argand" $demo -o correct.png --correct >out || fail "--correct"
cmp -s text.png correct.png && fail "--correct has no effect"
rm ./*.png

# Lights: every kind is taken, and only they light where there is nothing else.
glow() { # glow NAME ARGUMENT...: a picture of the triangle without an environment
    name=$1
    shift
    "$argand" render "$lit" -o $name $small --tonemap none --env none --camera 0 "$@" >out 2>err ||
        fail "render $name: $*"
}
lit=$folder/lit.gltf
sed 's/KHR_materials_unlit/KHR_materials_ior/' "$triangle" >"$lit"
glow dark.png --light 'point at=0,0,2 intensity=0'
glow point.png --light 'point at=0.3,0.3,2 intensity=4'
cmp -s dark.png point.png && fail "--light has no effect"
# Two halves are one whole, a blank more or less says the same, so does where a light shines to.
glow halves.png --light 'point at=0.3,0.3,2 intensity=2' --light "  point   at=.3,.3,2 intensity=2"
cmp -s halves.png point.png || fail "two halves are not one whole"
glow to.png --light 'spot at=0,0,2 to=0,2,0 intensity=9 inner=40 outer=60'
glow direction.png --light 'spot at=0,0,2 direction=0,1,-1 intensity=9 inner=40 outer=60'
cmp -s to.png direction.png || fail "to= and direction= differ"
cmp -s to.png dark.png && fail "the spot has no effect"
# --exposure goes before what the scene says, which is 1 here.
glow one.png --light 'point at=0.3,0.3,2 intensity=4' --exposure 1
glow twice.png --light 'point at=0.3,0.3,2 intensity=4' --exposure 2
cmp -s one.png point.png || fail "the scene's exposure is not 1"
cmp -s one.png twice.png && fail "--exposure has no effect"
glow all.png --validate --light directional --light 'sun angle=5 direction=0,-1,-1 hidden' \
    --light 'sphere at=0,0,9 radius=1' --light 'disk at=0,0,9 to=0,0,0 radius=1 range=20' \
    --light 'rect at=0,0,9 width=1 height=2 up=1,0,0' --light 'tube at=0,9,0 length=1 radius=.1' \
    --light 'ambient color=1,0,0 intensity=.1' --light 'hemispheric ground=.1,.1,.1' \
    --light 'harmonics terms=1,0,.5,0' --light 'harmonics terms=1,1,1,0,0,0,0,1,0,0,0,0'
# Pixel by pixel: the files tell of their camera, too.
same() {
    "$argand" compare "$1" "$2" --max-flip 0 >/dev/null
}
# Three ways to one exposure: f/4 at 1/64 s and ISO 400 is EV100 8.
glow camera.png --light 'point at=0.3,0.3,2 intensity=4000' --aperture 4 --shutter 1/64 --iso 400
glow ev.png --light 'point at=0.3,0.3,2 intensity=4000' --ev100 9 --ev-compensation 1
glow factor.png --light 'point at=0.3,0.3,2 intensity=4000' --exposure 0.0032552083
same camera.png ev.png || fail "a camera is not its EV100"
same camera.png factor.png || fail "EV100 is not its factor"
glow white.png --light 'point at=0.3,0.3,2 intensity=4' --white-balance 3000
cmp -s white.png point.png && fail "--white-balance has no effect"
rm ./*.png

# The eye: the same bytes each time, what it found told, the same at any size; where a lamp is eight
# times as bright, EV100 is three more, and the picture the same.
eye() { # eye NAME SIZE ARGUMENT...
    name=$1 size=$2
    shift 2
    "$argand" render "$lit" -o $name --size $size --env none --json --exposure auto "$@" \
        >out 2>err || fail "render $name: $*"
    ev=$(sed -n 's/.*"ev100": \(.*\),/\1/p' out)
}
lamp='point at=0.3,0.3,2 intensity'
eye a.png 64x64 --light "$lamp=4" && first=$ev
eye b.png 64x64 --light "$lamp=4"
cmp -s a.png b.png || fail "--exposure auto is not the same each time"
noted a.png ev100 $first
eye c.png 128x128 --light "$lamp=4"
[ $ev = $first ] || fail "EV100 $ev at another size, not $first"
eye d.png 64x64 --light "$lamp=32"
awk "BEGIN { d = $ev - $first - 3; exit d * d > 1e-6 }" || fail "EV100 $ev is not $first + 3"
"$argand" compare a.png d.png --max-flip 0.01 >out || fail "what the eye sees is not the same"
eye e.png 64x64 --light "$lamp=4" --exposure-limits 20,30
[ $ev = 20 ] || fail "the limit is 20, not $ev"
eye f.png 64x64 --light "$lamp=4" --metering average --ev-compensation=-1.5
eye g.png 64x64 --light "$lamp=4" --metering spot=0.9,0.9
[ $ev = -10 ] || fail "black is metered as $ev"
"$argand" render "$lit" -o h.png $small --exposure auto >out || fail "--exposure auto"
grep -q ', EV100 [-0-9.]*$' out || fail "EV100 is not told"
rm ./*.png

# What only shows once the files are read.
expect 1 "has no camera 'back'; it has 0 (front)" render "$triangle" -o x.png $small --camera back
expect 1 "it has 0 (front)" render "$triangle" -o x.png $small --camera 1
expect 1 "none.hdr" render "$triangle" -o x.png $small --env none.hdr
expect 1 "triangle.gltf" render "$triangle" -o x.png $small --env "$triangle"
expect 1 "none.glb" render none.glb -o x.png $small
expect 1 "no-such-device" render "$triangle" -o x.png --device no-such-device
nothing_left

# A picture as --env is refused: it does not hold light.
"$argand" render "$triangle" -o picture.png $small >out
expect 1 "--env needs a Radiance .hdr or OpenEXR .exr file" \
    render "$triangle" -o x.png $small --env picture.png
rm picture.png
nothing_left

# A disk that is full: one sentence, no picture, no part of one; an old picture stays.
"$argand" render "$triangle" -o old.png --size 8x8 --device cpu >out
cp old.png before
(
    ulimit -f 1
    ARGAND_NO_CACHE=1 MESA_SHADER_CACHE_DISABLE=true \
        "$argand" render "$triangle" -o old.png --size 800x600 --device cpu >out 2>err
) && fail "a full disk is no success"
grep -q 'old.png: .*File too large' err || fail "a full disk says so"
cmp -s old.png before || fail "the old picture is gone"
rm old.png before
nothing_left
