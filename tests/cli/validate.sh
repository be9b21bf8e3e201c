#!/bin/sh
# The report that shows real time beside the reference, in a real browser.
#
#   validate.sh ARGAND JSON_HAS
set -eu
. "$(dirname "$0")/helpers.sh"
small="--size 64x64 --spp 4 --device cpu"

# What makes no sense is said at once.
expect 2 "which files?" validate
expect 2 "Add: -o report" validate demo:lights
expect 2 "did you mean demo:lights?" validate demo:spheres demo:light -o report
expect 2 "--spp: '0'" validate demo:lights -o report --spp 0
expect 2 "--max-flip: '-1'" validate demo:lights -o report --max-flip -1
echo >file
expect 1 "is a file" validate demo:lights -o file
expect 1 "does not exist" validate demo:lights -o no/report
rm file

# A scene that fails leaves nothing, and so does a disk that is full.
expect 1 "gone.glb" validate demo:lights gone.glb -o report $small
[ ! -e report ] || fail "half a report"
(ulimit -f 4 && expect 1 "cannot be written" validate demo:lights -o report $small)
[ ! -e report ] || fail "half a page"
nothing_left

# The file's name is data, whatever it looks like.
sed 's/XYZ_materials_plaid/KHR_materials_ior/' "$triangle" >'<!--<script>.gltf'

# Two scenes: a line each and one for the page; more lights than have parts of their own.
set --
for x in 1 2 3 4 5 6 7 8 9; do
    set -- "$@" --light "point at=$x,1,2 intensity=1"
done
"$argand" validate '<!--<script>.gltf' demo:lights -o report/ $small "$@" >out 2>err ||
    fail "validate"
[ "$(wc -l <out)" -eq 3 ] || fail "three lines"
grep -q "^demo:lights: FLIP 0\.[0-9]*, worst" out || fail "the numbers"
[ "$(ls report)" = index.html ] || fail "one file"
grep -q "The other" report/index.html || fail "lights share a part"
! grep -q '<!--<script>' report/index.html || fail "a name breaks the page"

# Looked through in a browser; a page with a broken picture does not pass.
look="python3 $root/tests/cli/page.py"
$look report/index.html >out 2>err || fail "the page in a browser"
sed '0,/base64,UklGR/s//base64,AAAAA/' report/index.html >broken.html
! $look broken.html >out 2>err || fail "a broken picture passes"
grep -q "do not load" err || fail "broken for another reason"

# Numbers for machines, and the limit, above which the page is there nevertheless.
set +e
"$argand" validate demo:lights -o limit $small --json --max-flip 0.0001 >out 2>err
[ $? -eq 1 ] || fail "--max-flip does not fail"
set -e
grep -q "FLIP is above 0.0001 in 1 of 1 scenes: demo:lights" err || fail "the limit's sentence"
"$json" out argand device scenes.0.input=demo:lights scenes.0.flip scenes.0.psnr_db \
    scenes.0.samples=4 scenes.0.causes.0.name scenes.0.causes.0.error || fail "--json lacks"
[ -s limit/index.html ] || fail "no page above the limit"

# One exposure for both pictures.
"$argand" validate demo:lights -o eye $small --exposure auto --json >out 2>err || fail "auto"
"$json" out scenes.0.exposure scenes.0.ev100 || fail "--json lacks the exposure"

# More samples, less noise: the mean difference falls, but not what noise is taken out of.
for n in 2 16; do
    "$argand" validate demo:materials -o few --size 64x64 --spp $n --device cpu --json >few.$n ||
        fail "--spp $n"
done
python3 -c '
import json
few, many = (json.load(open(f"few.{n}"))["scenes"][0] for n in (2, 16))
assert many["error"] < 0.8 * few["error"], (few["error"], many["error"])
assert abs(many["rms"] - few["rms"]) < 0.25 * many["rms"], (few["rms"], many["rms"])
' 2>err || fail "noise is in the wrong figures"
