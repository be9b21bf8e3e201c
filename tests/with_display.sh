#!/bin/sh
# Run a command with a display of its own:  with_display.sh COMMAND [ARGUMENT...]
#
# $ARGAND_TEST_SCREEN is then what the display shows, an XWD file that is always up to date;
# $ARGAND_TEST_DISPLAY is the display's process.
set -eu
unset WAYLAND_DISPLAY

folder=$(mktemp -d)
XDG_RUNTIME_DIR=$folder # nobody else's compositor
server=
finish() {
    [ -z "$server" ] || kill "$server" 2>/dev/null || true
    [ -z "$server" ] || wait "$server" 2>/dev/null || true
    rm -rf "$folder"
}
trap finish EXIT
trap 'exit 143' INT TERM

Xvfb -displayfd 3 -screen 0 800x500x24 -fbdir "$folder" -nolisten tcp -noreset \
    3>"$folder/number" 2>"$folder/log" &
server=$!
for attempt in $(seq 300); do
    [ ! -s "$folder/number" ] || break
    kill -0 "$server" 2>/dev/null || break
    sleep 0.1
done
if [ ! -s "$folder/number" ]; then
    echo "with_display.sh: Xvfb did not start:"
    cat "$folder/log"
    exit 1
fi
DISPLAY=:$(cat "$folder/number")
ARGAND_TEST_SCREEN=$folder/Xvfb_screen0
ARGAND_TEST_DISPLAY=$server
export DISPLAY XDG_RUNTIME_DIR ARGAND_TEST_SCREEN ARGAND_TEST_DISPLAY

"$@" & # beside it, so that a signal reaches us at once
command=$!
trap 'kill "$command" 2>/dev/null; exit 143' INT TERM
wait "$command"
