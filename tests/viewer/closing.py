"""Closed at any moment, and no memory is left: in the sanitized build this proves it."""

import os
import time

from kit import *

INPUTS = ("demo:lights", os.path.join(here, "cube.gltf"))
cube(INPUTS[1])


def closing(moment, *keys):
    """Close `moment` seconds after the window has come."""
    for input in INPUTS:
        v = Viewer(input, words=True)
        window = v.window()
        time.sleep(moment)
        for key in keys:
            xdotool("key", key)
        xdotool("key", "ctrl+q")
        check(v.ended() == 0, f"exit code {v.process.returncode}: {v.lines[-3:]}")


def while_it_loads():
    for moment in (0, 0.05, 0.2, 0.6):
        closing(moment)


def while_it_works():
    closing(0.5, "3", "F12", "F5", "r")


def before_its_jobs_have_ended():
    """The window goes at once, however long they take."""
    input, hold, held = large(os.path.join(here, "large.gltf"))
    v = Viewer(input, words=True, **held)
    window = v.window()
    v.heard("shown: ")  # a draft; the rest waits for `hold`
    start = time.monotonic()
    xdotool("key", "ctrl+q")
    until(lambda: window not in xdotool("search", "--onlyvisible", "--class", "argand"), "an end")
    print(f"gone after {time.monotonic() - start:.2f} s")
    check(v.process.poll() is None, "nothing was held")
    os.unlink(hold)
    check(v.ended() == 0, f"exit code {v.process.returncode}: {v.lines[-3:]}")


def with_everything_done_once():
    v = Viewer(INPUTS[0], words=True)
    v.shown()
    v.key("h", "h", "Tab", "l", "Up", "Right", "t", "b", "x", "m", "plus", "o", "F5", "F12")
    xdotool("key", "r")
    time.sleep(1)
    v.close()


run(while_it_loads, while_it_works, before_its_jobs_have_ended, with_everything_done_once)
