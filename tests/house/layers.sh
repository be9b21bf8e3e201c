#!/bin/sh
# Do all #include lines follow the arrows of docs/architecture.md?
#
#   layers.sh ROOT
set -eu
cd "$1"

find src shaders include examples tools -type f \( -name '*.[ch]' -o -name '*.glsl' -o -name \
    '*.vert' -o -name '*.frag' -o -name '*.comp' \) | LC_ALL=C sort >"${TMPDIR:-/tmp}/layers.$$"
trap 'rm -f "${TMPDIR:-/tmp}/layers.$$"' EXIT

awk '
function complain(text) {
    print FILENAME ":" FNR ": " text
    bad++
}

# The part of the house that a file belongs to: src/PART/..., shaders/PART/..., or its top folder.
function part_of(path, step) {
    split(path, step, "/")
    return step[1] == "src" || step[1] == "shaders" || step[1] == "include" ? step[2] : step[1]
}

FILENAME == "docs/architecture.md" {
    if ($0 == "```arrows") { inside = 1; next }
    if ($0 ~ /^```/) inside = 0
    if (inside) {
        known[$1] = 1
        arrows++
        for (i = 3; i <= NF; i++) allowed[$1, $i] = 1
    }
    next
}

/^[ \t]*#[ \t]*include/ {
    lines++
    from = part_of(FILENAME)
    if (!(from in known)) { complain("docs/architecture.md does not know the folder " from); next }
    target = $0
    sub(/^[ \t]*#[ \t]*include[ \t]*/, "", target)
    quoted = target ~ /^"/
    gsub(/[<>"]/, "", target)
    sub(/[ \t].*/, "", target)
    if (target ~ /\.\./) { complain("climbs out of its folder: " target); next }
    to = target ~ /\// ? target : ""
    sub(/\/.*/, "", to)
    if (target ~ /^(vulkan\/|volk)/) to = "vulkan"
    if (quoted && to == "") next                  # a file of its own folder, or a generated one
    if (!quoted && to != "vulkan" && !(to in known)) next # the system, or a library
    if (quoted && !(to in known)) { complain("includes the unknown " target); next }
    if (to != from && !((from, to) in allowed)) complain(from " may not include " target)
}

END {
    if (!arrows || !lines) { print "layers: found no arrows or no #include lines"; exit 1 }
    print lines " #include lines, " bad + 0 " against docs/architecture.md"
    exit bad > 0
}' docs/architecture.md $(cat "${TMPDIR:-/tmp}/layers.$$")
