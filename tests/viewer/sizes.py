"""Sizes of the window, under validation: resized hard, tiny, hidden."""

import os
import random
import time

from kit import *

scene = cube(os.path.join(here, "cube.gltf"))
RESIZING_S = 30


def resized(viewer, width, height):
    xdotool("windowsize", "--sync", viewer.window(), width, height)
    viewer.rest()
    return viewer.picture((width, height))


def resizing_hard_is_clean():
    dice = random.Random(5)
    v = Viewer(scene, *PLAIN, "--validate", words=True)
    v.shown()
    xdotool("key", "Tab")
    window, end, count = v.window(), time.monotonic() + RESIZING_S, 0
    while time.monotonic() < end:
        words = []
        for i in range(20):
            width, height = dice.choice((1, 7, 120, 240, 333, 500)), dice.choice((1, 80, 161, 400))
            words += ["windowsize", window, width, height]
            if i % 4 == 0:
                words += ["mousemove", 5 + i, 5, "key", dice.choice(("1", "3", "7", "h"))]
            words += ["sleep", dice.choice(("0", "0.005", "0.05"))]
        xdotool(*words)
        check(v.process.poll() is None, "it ended")
        count += 20
    print(f"{count} sizes")
    check(resized(v, 240, 160), "no picture")
    v.close()


def pictures_fit_every_window():
    options = (scene, *PLAIN, "--camera", "front")
    v = Viewer(*options, "--validate")
    start = v.shown()
    resized(v, 1, 1)
    for width, height in ((333, 97), (64, 300)):
        wanted = rendered(*options, "--size", f"{width}x{height}")
        check(resized(v, width, height) == wanted, f"{width}x{height}: another picture")
    check(resized(v, 240, 160) == start, "another picture than at first")
    v.close()


def hidden_windows_wait():
    v = Viewer(scene, *PLAIN, "--validate")
    start = v.shown()
    window = v.window()
    v.point(120, 80)
    xdotool("windowunmap", "--sync", window)
    xdotool("windowsize", window, 200, 100)
    time.sleep(0.5)
    check(v.process.poll() is None, "it ended")
    xdotool("windowsize", window, 240, 160)
    xdotool("windowmap", "--sync", window)
    until(lambda: v.rest() == start, "the picture is there again")
    xdotool("windowfocus", "--sync", window)
    v.close()


run(pictures_fit_every_window, hidden_windows_wait, resizing_hard_is_clean)
