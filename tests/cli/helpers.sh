# Sourced by the tests of argand(1).  $argand is the program, $json the checker of JSON.
argand=$1 json=$2 root=$(cd "$(dirname "$0")/../.." && pwd)
triangle=$root/tests/cli/triangle.gltf
here=$(mktemp -d)
ARGAND_CACHE_DIR=$(mktemp -d) # the user's own is left alone
export ARGAND_CACHE_DIR
trap 'chmod -R u+w "$here"; rm -rf "$here" "$ARGAND_CACHE_DIR"' EXIT
cd "$here"

fail() {
    echo "FAILED: $*"
    [ ! -s out ] || { echo "standard output:"; head -20 out; }
    [ ! -s err ] || { echo "standard error:"; head -20 err; }
    exit 1
}

# expect CODE TEXT ARGUMENT...: the exit code, and what a line of standard error contains;
# a failure says exactly one sentence and prints nothing else.
expect() {
    code=$1 text=$2
    shift 2
    set +e
    "$argand" "$@" >out 2>err
    got=$?
    set -e
    [ "$got" -eq "$code" ] || fail "exit code $got, not $code: argand $*"
    grep -qF -- "$text" err || fail "standard error lacks '$text': argand $*"
    [ "$code" -eq 0 ] && return 0
    [ ! -s out ] || fail "a failure printed something: argand $*"
    [ "$(wc -l <err)" -eq 1 ] || fail "not one line: argand $*"
}

# noted FILE KEY VALUE...: what a picture's file says of itself; numbers to five digits.
noted() {
    "$root/tests/cli/notes.py" "$1" >notes || fail "$1 is not sound"
    file=$1
    shift
    while [ $# -gt 0 ]; do
        awk -v key="$1" -v value="$2" '
            $1 == key { $1 = ""; sub(/^ /, ""); d = $0 - value
                        found = $0 == value || (value + 0 && d * d < 1e-10 * value * value) }
            END { exit !found }' notes || fail "$file: no note $1 $2, but: $(cat notes)"
        shift 2
    done
    rm notes
}

# nothing_left: no picture and no temporary file lies about.
nothing_left() {
    left=$(ls -A | grep -vx -e out -e err -e log || true)
    [ -z "$left" ] || fail "left behind: $left"
}
