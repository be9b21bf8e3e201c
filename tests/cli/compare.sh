#!/bin/sh
# Two pictures compared.  Needs no Vulkan.
#
#   compare.sh ARGAND JSON_HAS PICTURES
set -eu
. "$(dirname "$0")/helpers.sh"
"$3" . # black.png grey.png small.png light.exr

"$argand" compare black.png black.png >out 2>err || fail "alike"
grep -qx 'black.png, black.png: 24x16 pixels' out || fail "no headline"
grep -qx '  FLIP         0.00000' out || fail "alike: FLIP"
grep -qx '  at most      0.00000' out || fail "alike: there is no worst place"
grep -qx '  PSNR         without end: equal' out || fail "alike: PSNR"
[ ! -s err ] || fail "alike: standard error"
"$argand" compare black.png black.png --json --max-flip 0 >out 2>err || fail "alike, JSON"
"$json" out reference=black.png picture=black.png width=24 height=16 hdr=false flip=0 ||
    fail "JSON lacks something"
grep -q '"psnr_db": null' out || fail "an infinite PSNR is null"

# A grey of 51 against black, and one pixel of white.
"$argand" compare black.png grey.png --ppd 67 -o heat.png >out 2>err || fail "apart"
grep -q '^  at most      0\.[1-9][0-9]*  at 5,9$' out || fail "the worst place"
grep -qx '  RMSE sRGB    0.20616' out || fail "RMSE" # sqrt((383 0.2^2 + 1) / 384)
[ -s heat.png ] || fail "no heat map"
"$argand" compare heat.png heat.png >out 2>err || fail "the heat map is a picture"
rm heat.png
set +e
"$argand" compare black.png grey.png --max-flip 0.01 -o heat.webp >out 2>err
[ $? -eq 1 ] || fail "above the limit"
set -e
grep -q '^  FLIP         0\.[0-9]*$' out || fail "the numbers come above the limit as well"
grep -q '^argand: error: grey.png: a FLIP of 0\.[0-9]* is above the limit of 0.01\.$' err ||
    fail "the sentence about the limit"
[ "$(wc -l <err)" -eq 1 ] || fail "more than one sentence"
[ -s heat.webp ] || fail "the heat map comes above the limit as well"
rm heat.webp

# Floats.
"$argand" compare light.exr light.exr >out 2>err || fail "floats"
grep -qx '  FLIP         0.00000  over [-0-9.]* to [-0-9.]* stops' out || fail "exposures"

expect 2 "which two" compare
expect 2 "which two" compare black.png
expect 2 "one argument too many" compare black.png grey.png small.png
expect 2 "--max-flip: 'x' is not a number; try --max-flip 0.05" compare a b --max-flip x
expect 2 "--ppd: '9' is not between 10 and 500; try --ppd 67" compare a b --ppd 9
expect 2 "must end in" compare black.png grey.png -o heat.bmp
expect 1 "the folder 'no' does not exist" compare black.png grey.png -o no/heat.png
expect 1 "black.png has 24x16 pixels and small.png 8x8" compare black.png small.png
expect 1 "light.exr is linear light in floats and grey.png colours in bytes" \
    compare grey.png light.exr
expect 1 "none.png" compare black.png none.png
rm ./*.png ./*.exr
nothing_left
