#!/bin/sh
# Path traced pictures, without a Vulkan device.
#
#   reference.sh ARGAND JSON_HAS
set -eu
. "$(dirname "$0")/helpers.sh"
VK_DRIVER_FILES=/nonexistent VK_ICD_FILENAMES=/nonexistent
export VK_DRIVER_FILES VK_ICD_FILENAMES
folder=$(mktemp -d)
trap 'rm -rf "$here" "$folder" "$ARGAND_CACHE_DIR"' EXIT
# The file's unknown extension would be warned about, and what is unlit has no noise.
sed 's/XYZ_materials_plaid/KHR_materials_ior/; s/KHR_materials_unlit/KHR_materials_ior/' \
    "$triangle" >"$folder/triangle.gltf"
triangle=$folder/triangle.gltf
small="--size 32x24 --spp 4"

# Every kind of picture; one line tells samples and noise; nothing else is said.
for kind in png jpg webp exr hdr; do
    "$argand" reference "$triangle" -o x.$kind $small >out 2>err || fail "reference to .$kind"
    [ ! -s err ] || fail "reference says something on standard error"
    grep -Eqx "x.$kind: 32x24 pixels, 4 samples each, [0-9.e-]+ % noise, in [0-9.]+ s" out ||
        fail "the closing line"
    rm x.$kind
done
"$argand" reference "$triangle" -o x.png --size 8x8 --spp 1 >out 2>err || fail "one sample"
grep -q "1 sample each, in" out || fail "the closing line of one sample"
"$argand" reference "$triangle" -o x.png --size 8x8 --quiet >out 2>err || fail "--quiet"
[ ! -s out ] && [ ! -s err ] || fail "--quiet says something"
"$argand" reference "$triangle" -o x.png --size 8x8 --json >out 2>err || fail "--json"
"$json" out output=x.png width=8 height=8 samples=64 noise interrupted=false rays \
    rays_per_second triangles=1 seed=0 ms.load ms.decode ms.environment ms.prepare ms.trace \
    ms.encode ms.total peak_memory_bytes || fail "--json lacks something"
rm x.png

# It ends by time, and by noise.
"$argand" reference "$triangle" -o x.png --size 32x24 --time .3 --json >out 2>err || fail "--time"
"$json" out interrupted=false || fail "the end by time"
"$argand" reference "$triangle" -o x.png --size 16x16 --noise .1 --spp 4096 >out || fail "--noise"
awk '{ for (i = 1; i < NF; i++) if ($(i + 2) == "noise,") noise = $i; exit !(noise <= 10) }' out ||
    fail "the noise is above what was asked for"
rm x.png
if command -v script >/dev/null; then
    TERM=xterm script -qec "'$argand' reference '$triangle' -o x.png --size 64x64 --time 1" \
        /dev/null >log </dev/null
    grep -q 'trace .*spp, .* % noise, 0:0[01] left' log || fail "no bar on a terminal"
    rm log x.png
fi

# The same seed gives the same bytes on one core and on all; another one does not.
"$argand" reference "$triangle" -o all.exr $small --seed 7 >out
taskset -c 0 "$argand" reference "$triangle" -o one.exr $small --seed 7 >out
"$argand" reference "$triangle" -o other.exr $small --seed 8 >out
cmp -s all.exr one.exr || fail "one core and all cores differ"
cmp -s all.exr other.exr && fail "--seed has no effect"
rm ./*.exr

# What `render` takes, `reference` takes; its own options work.
while read -r options; do
    "$argand" reference "$triangle" -o x.png $small $options >out 2>err || fail "$options"
done <<'END'
--tonemap none --env sky --env-rotation 90 --env-intensity .5 --max-bounces 0
--exposure=2 --fov 20 --orbit=-30,75,auto --verbose --max-bounces 3 --clamp 10
--background #336699 --target 0,auto,1 --ev100=-1 --unshadowed
--background=transparent --env none --camera 0 --light=sun --estimator lights
--transfer gamma2.2 --estimator surface --parts lights,diffuse,seen
--estimator both --parts specular --parts emitted
END
rm x.png
lit="--env none --camera 0"
"$argand" reference "$triangle" -o dark.png $small $lit --light 'point intensity=0' >out
"$argand" reference "$triangle" -o lit.png $small $lit --light 'point at=.3,.3,2 intensity=9' >out
cmp -s dark.png lit.png && fail "--light has no effect"
rm ./*.png

# Each of its own options changes the picture.
spheres="reference demo:spheres --size 32x32 --spp 2"
"$argand" $spheres -o plain.png >out || fail "demo:spheres"
while read -r options; do
    "$argand" $spheres -o other.png $options >out || fail "$options"
    cmp -s plain.png other.png && fail "$options has no effect"
done <<'END'
--max-bounces 0
--bloom .3
--max-bounces 1
--parts seen
--unshadowed
--clamp .1
--estimator lights
--estimator surface
--spp 3
END
rm ./*.png

# Layers.
"$argand" reference "$triangle" -o x.exr $small --aov albedo,depth,normal,direct,indirect >out ||
    fail "--aov"
for channel in R albedo.R albedo.B normal.X normal.Z depth.Z direct.G indirect.G; do
    LC_ALL=C grep -qa "$channel" x.exr || fail "no channel $channel"
done
"$argand" reference "$triangle" -o plain.exr $small >out
"$argand" compare plain.exr x.exr --max-flip 0 >out 2>err || fail "layers change the picture"
rm ./*.exr

# The file says how it was exposed.  1.2 * 2^8 nit come out as 1.
version=$("$argand" --version | awk '{ print $NF; exit }')
for options in "-o x.png" "-o x.exr" "-o x.exr --aov depth"; do
    "$argand" reference "$triangle" $options $small --ev100 8 >out || fail "--ev100 8"
    noted $(echo "$options" | cut -d' ' -f2) Software "Argand $version" ev100 8 whiteLuminance 307.2
done
"$argand" reference "$triangle" -o x.png $small --exposure 1 >out || fail "--exposure 1"
noted x.png ev100 -0.263034
"$argand" reference "$triangle" -o x.exr $small --aperture 16 --shutter 1/100 >out || fail "f/16"
noted x.exr ev100 14.643856 aperture 16 expTime .01 isoSpeed 100
"$argand" reference demo:specular -o x.png $small >out || fail "demo:specular"
noted x.png ev100 -1.4157417 # 8 at 683 lm/W
"$argand" reference demo:spheres -o x.png $small --exposure auto --json >out || fail "auto"
ev=$(sed -n 's/.*"ev100": \(.*\),/\1/p' out)
noted x.png ev100 $ev
"$argand" reference demo:spheres -o y.png $small --ev100 $ev >out
"$argand" compare x.png y.png --max-flip 0.01 >out || fail "EV100 $ev is not what was metered"
rm x.png x.exr y.png

# What makes no sense.
bad() {
    text=$1
    shift
    expect 2 "$text" reference "$triangle" -o x.png "$@"
    nothing_left
}
bad "--spp: '0' is not a whole number, 1 to 16777216; try --spp 256" --spp 0
bad "is not a whole number" --spp 1e3
bad "is not a whole number" --spp 16777217
bad "is not between 0.001 and 1e7 seconds" --time 0
bad "is not a number" --time 1m
bad "is no relative error" --noise 1
bad "is no relative error" --noise 0
bad "is not a whole number, 0 to 999999999" --max-bounces -1
bad "is not a whole number, 0 to 999999999" --seed 1000000000
bad "is not a list of albedo, normal, depth, direct and indirect" --aov albedo,
bad "is not a list of seen, lights, diffuse, specular and emitted" --parts all
bad "not one of both, lights or surface" --estimator mis
bad "not a factor above 0" --clamp 0
bad "'x.png' cannot hold layers, OpenEXR can; name it -o picture.exr" --aov depth
bad "there is no option '--quality'" --quality best
bad "give one of them" --exposure 1 --ev100 0
expect 2 "reference: where should the picture go" reference "$triangle"
expect 2 "reference: which file? Try: argand reference model.glb" reference -o x.png
expect 2 "must end in" reference "$triangle" -o x.bmp
expect 1 "has no camera 'back'" reference "$triangle" -o x.png --camera back
expect 1 "none.glb" reference none.glb -o x.png
expect 1 "the folder 'no' does not exist" reference "$triangle" -o no/x.png
nothing_left

# An interrupt ends it with what has been gathered, saved.  (timeout alone sends two.)
timeout --foreground --preserve-status -s INT 3 \
    "$argand" reference "$triangle" -o x.png --size 64x64 --time 100 --json >out 2>err ||
    fail "an interrupt is a failure"
grep -Eq 'warning: interrupted: the picture has [0-9]+ samples? a pixel\.$' err ||
    fail "an interrupt without a sentence"
[ "$(wc -l <err)" -eq 1 ] || fail "an interrupt with more than a sentence"
"$json" out interrupted=true samples || fail "the report of what was interrupted"
[ -s x.png ] || fail "an interrupt without a picture"
rm x.png

# A second one ends it at once, and leaves nothing half done.
env --default-signal=INT \
    "$argand" reference "$triangle" -o x.png --size 512x512 --time 100 >out 2>err &
sleep 2
again=0
while [ $((again += 1)) -lt 9999 ] && kill -INT $! 2>/dev/null; do :; done
set +e
wait $!
got=$?
set -e
[ $got -eq 130 ] || fail "interrupts end with $got"
rm -f x.png
nothing_left

# `render` answers without a device, and says so in one line; not where one is asked for.
expect 0 "the picture is path traced instead, with 16 samples a pixel" \
    render "$triangle" -o x.png --size 16x16 --quality fast
[ "$(wc -l <err)" -eq 1 ] || fail "more than one line"
grep -q 'mesa-vulkan-drivers' err || fail "no way out"
grep -q '^x.png: 16x16 pixels in .* s on path tracer$' out || fail "the closing line of render"
"$argand" render "$triangle" -o x.png --size 16x16 --json --quiet >out 2>err || fail "quiet"
[ ! -s err ] || fail "--quiet says something"
"$json" out device.name="path tracer" device.kind=cpu samples=64 triangles=1 ms.frame ||
    fail "the report of a path traced picture"
rm x.png
expect 1 "mesa-vulkan-drivers" render "$triangle" -o x.png --device cpu
expect 1 "mesa-vulkan-drivers" render "$triangle" -o x.png --device 0
expect 1 "mesa-vulkan-drivers" devices
expect 1 "mesa-vulkan-drivers" render "$triangle" -o x.png --validate
nothing_left
