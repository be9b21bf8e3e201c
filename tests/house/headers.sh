#!/bin/sh
# Does each public header compile alone, as C11 and as C++17, with every compiler there is?
#
#   headers.sh ROOT
set -eu
cd "$1"
flags='-fsyntax-only -Iinclude -Wall -Wextra -Wpedantic -Werror'
tried=0
for header in include/argand/*.h; do
    name=argand/$(basename "$header")
    for compiler in gcc clang; do
        command -v $compiler >/dev/null || continue
        echo "#include <$name>" | $compiler -x c -std=c11 $flags -
        tried=$((tried + 1))
    done
    for compiler in g++ clang++; do
        command -v $compiler >/dev/null || continue
        echo "#include <$name>" | $compiler -x c++ -std=c++17 $flags -
        tried=$((tried + 1))
    done
done
echo "$tried compilations"
[ "$tried" -ge 10 ]
