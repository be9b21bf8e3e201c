#!/bin/sh
# Is no line above 100 columns and no .c file above 800 lines?  Data is exempt, and rows of
# tables in Markdown, which cannot be broken.
#
#   lines.sh ROOT
set -eu
cd "$1"
tracked() {
    git -c safe.directory='*' ls-files -- "$@" ':!*.gltf' ':!*.json' ':!*.svg' ':!*corpus*'
}
if ! tracked Makefile >/dev/null 2>&1; then
    echo "not a git checkout"
    exit 77
fi
long=$(LC_ALL=C.UTF-8 git -c safe.directory='*' grep -InE '.{101,}' -- . ':!*.gltf' ':!*.json' \
    ':!*.svg' ':!*corpus*' | grep -vE '^[^:]*\.md:[0-9]+:\|' | cut -c1-80)
[ -z "$long" ] || { printf 'above 100 columns:\n%s\n' "$long"; exit 1; }

big=$(tracked '*.c' | xargs wc -l | awk '$2 != "total" && $1 > 800 { print $2 " has " $1 }')
[ -z "$big" ] || { printf 'above 800 lines:\n%s\n' "$big"; exit 1; }
