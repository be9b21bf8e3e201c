"""Exposure, tone curve, bloom; what is written over the picture; the window; files of it."""

import os
import re

from kit import *

white = cube(os.path.join(here, "white.gltf"), roughness=0.5)
colors = cube(os.path.join(here, "cube.gltf"))
LIT = ("--env", "none", "--background", "#000000", "--camera", "front",
       "--light", "point at=0,1,3 intensity=4")


def started(scene, *options, **more):
    viewer = Viewer(scene, *options, **more)
    viewer.start = viewer.shown()
    return viewer


def plus_and_minus_are_thirds_of_a_stop():
    v = started(white, *LIT, "--exposure", "0.5")
    size = ("--size", "240x160")
    for key, stops in (("plus", 1), ("equal", 2), ("minus", 1), ("minus", 0), ("minus", -1)):
        seen = v.key(key)
        wanted = rendered(white, *LIT, *size, "--exposure", 0.5 * 2 ** (stops / 3))
        check(seen.apart(wanted) == 0, f"{key}: not {stops} thirds of a stop")
    v.close()


def curves_come_in_turn():
    v = started(white, *LIT)
    for curve in ("none", "reinhard", "aces", "aces-narkowicz", "agx", "neutral"):
        v.says("tone curve: ", "t")
        wanted = rendered(white, *LIT, "--size", "240x160", "--tonemap", curve)
        check(v.rest() == wanted, f"T: not {curve}")
    v.close()


def bloom_comes_and_goes():
    v = started(white, *LIT)
    share = float(v.says(r"bloom: (\d+) %", "b")[1]) / 100
    wanted = rendered(white, *LIT, "--size", "240x160", "--bloom", share)
    check(v.rest() == wanted, "B: not the bloom of render")
    v.says("bloom: off", "b")
    check(v.rest() == v.start, "B and B")
    v.close()


def the_eye_follows_and_is_held():
    dark = ("--light", "point at=0,1,3 intensity=0.05")
    options = [o for o in LIT if not o.startswith("point")][:-1] + list(dark)
    v = started(white, *options)
    v.says("exposure: follows the light", "x")
    followed = v.rest()
    check(followed.mean() > 1.5 * v.start.mean(), "X: the eye does not open")
    for meter in ("spot", "average", "centre"):
        v.says(f"metering: {meter}", "m")
    check(v.rest().apart(followed) < 0.01, "M three times: another picture")
    v.says("EV beside the meter", "plus")
    brighter = v.rest()
    check(brighter.mean() > followed.mean(), "+ beside the meter: not brighter")
    v.says("exposure: held", "x")
    check(v.rest().apart(brighter) < 0.01, "X: not held where it was")
    held = v.key("3")
    check(v.key("Return").apart(brighter) < 0.01 and held != brighter, "held, and yet another")
    v.close()


def words_come_and_go():
    v = started(colors, *PLAIN, size=(640, 400), words=True)
    for key in ("question", "h", "F1"):
        helped = v.key(key)
        check(helped.apart(v.start) > 0.1, f"{key}: no help")
        check(v.key(key) == v.start, f"{key}: it stays")
    v.key("h")
    check(v.key("Escape") == v.start, "Esc does not close the help")
    written = v.key("Tab").part(0, 0, 320, 400)
    check(written.apart(v.start.part(0, 0, 320, 400)) > 0.05, "Tab: nothing is written")
    check(v.key("Tab") == v.start, "Tab: it stays")
    v.says("the scene has no lights", "l")
    until(lambda: v.picture() != v.start, "a sentence")
    until(lambda: v.picture() == v.start, "it goes")
    check(v.process.poll() is None, "it ended")
    xdotool("key", "Escape")
    check(v.ended() == 0, "Esc does not quit")


def pictures_are_saved_as_shown():
    v = started(colors, *PLAIN)
    for i, key in ((1, "1"), (2, "3")):
        seen = v.key(key)
        v.says(f"saved cube-00{i}.png", "F12")
        check(read_png(os.path.join(here, f"cube-00{i}.png")) == seen, "F12: another picture")
    v.close()


def the_window_fills_the_display():
    v = started(colors, *PLAIN)
    window = v.window()
    def size():
        return xdotool("getwindowgeometry", window)[-1]
    xdotool("key", "F11")
    until(lambda: size() == "800x500", "full screen")
    full = v.rest() and v.picture((800, 500))
    wanted = rendered(colors, *PLAIN, "--size", "800x500")
    check(full == wanted, "another picture on full screen")
    xdotool("key", "F11")
    until(lambda: size() == "240x160", "the window")
    check(v.rest() == v.start, "another picture than before")
    v.close()


run(
    plus_and_minus_are_thirds_of_a_stop,
    curves_come_in_turn,
    bloom_comes_and_goes,
    the_eye_follows_and_is_held,
    words_come_and_go,
    pictures_are_saved_as_shown,
    the_window_fills_the_display,
)
