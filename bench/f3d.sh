#!/bin/sh
# argand beside f3d (Debian's f3d under xvfb-run) on the same file, environment and size:
# whole processes in turn, f3d argand f3d argand ..., and the ratios of the medians.
#
#   bench/f3d.sh MODEL.glb ENVIRONMENT.hdr [RUNS] [ARGAND]
#
# Needs Debian's f3d, xvfb, xauth and time.  "cold" runs find no cache of ours at all.
set -eu
model=$1 environment=$2 runs=${3:-5} argand=${4:-build/release/argand}
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT

# measure NAME COMMAND...: append "wall cpu KiB" to $dir/NAME.
measure() {
    name=$1
    shift
    /usr/bin/time -o "$dir/time" -f '%e %U %S %M' "$@" >"$dir/out" 2>&1 || {
        cat "$dir/out" >&2
        exit 1
    }
    awk '{ print $1, $2 + $3, $4 }' "$dir/time" >>"$dir/$name"
}

run_argand() {
    measure "$1" env ARGAND_CACHE_DIR="$2" "$argand" render "$model" --env "$environment" \
        --size 1024x1024 -o "$dir/argand.png" --quiet
}

run_argand warm-up "$dir/cache" # fills the cache
i=0
while [ "$i" -lt "$runs" ]; do
    measure f3d xvfb-run -a f3d "$model" --hdri="$environment" -f -ta --resolution=1024,1024 \
        --output="$dir/f3d.png"
    run_argand warm "$dir/cache"
    run_argand cold "$dir/none-$i"
    i=$((i + 1))
done

median() { # FILE COLUMN
    awk -v c="$2" '{ print $c }' "$dir/$1" | sort -n | awk '{ v[NR] = $1 } END {
        print NR % 2 ? v[(NR + 1) / 2] : (v[NR / 2] + v[NR / 2 + 1]) / 2 }'
}

report() { # NAME
    for column in 1 2 3; do median "$1" $column; done | tr '\n' ' '
}
echo "$(report f3d) $(report warm) $(report cold)" | awk '
    function row(name, wall, cpu, kib) {
        printf "%-11s  %6.2f s wall  %6.2f s CPU  %5.0f MiB", name, wall, cpu, kib / 1024
    }
    function against(wall, cpu) {
        printf ": 1/%.1f of the wall time, 1/%.1f of the CPU time\n", $1 / wall, $2 / cpu
    }
    {
        row("f3d", $1, $2, $3); print ""
        row("argand warm", $4, $5, $6); against($4, $5)
        row("argand cold", $7, $8, $9); against($7, $8)
    }'
