#!/bin/sh
# Is the manual free of mistakes, and does it know every option that the help knows?
#
#   manual.sh ROOT ARGAND
set -eu
mandoc -T lint -W warning "$1/docs/argand.1"
for command in view render reference compare validate convert info devices demo help; do
    "$2" help $command | sed -n 's/^  \(-[a-z], \)\{0,1\}--\([a-z0-9-]*\).*/\2/p' |
        while read -r option; do
        grep -q -e "-$option\b" "$1/docs/argand.1" ||
                { echo "missing: --$option"; exit 1; }
        done
    grep -q "Cm $command" "$1/docs/argand.1" || { echo "missing: $command"; exit 1; }
done
