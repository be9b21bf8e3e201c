"""What turns, moves and changes the view: keys, mouse, wheel, flight."""

import math
import os

from kit import *

scene = cube(os.path.join(here, "cube.gltf"))


def distance(a, b=(0, 0, 0)):
    return math.dist(a, b)


def near(a, b, tolerance=1e-3):
    return all(abs(p - q) <= tolerance for p, q in zip(a, b))


def started(*options):
    viewer = Viewer(scene, *PLAIN, *options)
    viewer.start = viewer.shown()
    viewer.point(120, 80)
    return viewer


def the_view_is_that_of_render():
    v = started()
    check(v.start == rendered(scene, *PLAIN, "--size", "240x160"), "another picture")
    v.close()
    options = ("--camera", "right", "--exposure", "0.5", "--background", "#204060")
    v = started(*options)
    check(v.start.at(1, 1) == (32, 64, 96), "the background")
    check(v.start == rendered(scene, *PLAIN, *options, "--size", "240x160"), "another one")
    v.close()


def keys_show_each_side():
    v = started()
    ways = (
        ("1", FRONT, (0, 0, -1)), ("3", RIGHT, (-1, 0, 0)), ("7", TOP, (0, -1, 0)),
        ("ctrl+1", BACK, (0, 0, 1)), ("ctrl+3", LEFT, (1, 0, 0)), ("ctrl+7", BOTTOM, (0, 1, 0)),
    )
    for key, color, way in ways:
        seen = v.key(key)
        check(seen.middle() == color, f"{key} shows {seen.middle()}")
        check(near(v.camera()[1], way), f"{key} looks along {v.camera()[1]}")
    check(v.key("Return") == v.start, "Enter: not the first view")
    v.close()


def five_is_orthographic():
    v = started()
    before = v.key("1")
    check(v.camera()[2] == "perspective", "the start")
    flat = v.key("5")
    check(v.camera()[2] == "orthographic", "5 has no effect")
    # What is at the target keeps its size: the front, half a metre nearer, gets smaller.
    near_side, far_side = before.box(FRONT), flat.box(FRONT)
    check(far_side[2] - far_side[0] < near_side[2] - near_side[0], "as large as before")
    tilted = v.drag(120, 80, 100, 80)
    check(len({tilted.at(x, 80) for x in range(240)}) >= 2, "nothing turns")
    v.key("1")
    check(v.key("5") == before, "5 and 5")
    v.close()


def cameras_of_the_file_come_in_turn():
    v = started()
    pictures = {}
    for name in ("front", "right"):
        pictures[name] = rendered(scene, *PLAIN, "--size", "240x160", "--camera", name)
    v.says("camera 0: front", "c")
    check(v.rest() == pictures["front"], "C: not the first camera")
    v.says("camera 1: right", "0")
    check(v.rest() == pictures["right"], "0: not the second camera")
    v.says("camera 0: front", "c")
    check(v.rest() == pictures["front"], "C: not the first camera again")
    v.close()


def home_and_period_frame():
    v = started()
    large = v.key("1", "Home").box(FRONT)
    away = v.wheel(-8)
    small = away.box(FRONT)
    check(small[2] - small[0] < 0.7 * (large[2] - large[0]), "the wheel does not go away")
    v.drag(120, 80, 200, 120, button=2)
    home = v.key("Home")
    again = home.box(FRONT)
    check(all(abs(a - b) <= 3 for a, b in zip(again, large)), f"Home: {again}, not {large}")
    for key in ("f", "period"):
        v.point(120, 80)
        v.wheel(-8)
        off = v.drag(120, 80, 160, 100, button=2).box(FRONT)
        check(abs(off[0] + off[2] - 240) > 20, "it is not moved")
        v.click(160, 100)
        framed = v.key(key).box(FRONT)
        check(abs(framed[0] + framed[2] - 240) <= 30, f"{key}: not in the middle, {framed}")
        check(framed[2] - framed[0] > 1.3 * (off[2] - off[0]), f"{key}: too small, {framed}")
        v.key("Escape")
    v.close()


def dragging_turns_and_moves():
    v = started()
    v.key("1")
    eye = v.camera()[0]
    turned = v.drag(120, 80, 60, 80)
    check(v.camera()[0][0] > 0.1 and turned != v.start, "left drag: the right side does not come")
    check(abs(distance(v.camera()[0]) - distance(eye)) < 1e-3, "left drag: another distance")
    v.drag(120, 80, 120, 130)
    check(v.camera()[0][1] > 0.1, "left drag down: not from above")
    for button, held in ((2, ()), (1, ("shift",))):
        before = v.key("1", "Home").box(FRONT)
        after = v.drag(100, 70, 140, 80, button=button, held=held).box(FRONT)
        moved = [a - b for a, b in zip(after, before)]
        way = v.camera()[1]
        check(near(way, (0, 0, -1)), f"moving turns: {way}")
        # The target, not the front, follows the pointer: what is nearer goes farther.
        check(38 <= moved[0] <= 60 and 8 <= moved[1] <= 16, f"moved by {moved}")
    v.close()


def the_wheel_goes_to_the_pointer():
    v = started()
    v.key("1")
    far = v.camera()[0][2]
    corner = v.picture().box(FRONT)[:2]
    v.point(*corner)
    nearer = v.wheel(3)
    check(v.camera()[0][2] < far - 0.1, "not nearer")
    box = nearer.box(FRONT)
    check(abs(box[0] - corner[0]) <= 6 and abs(box[1] - corner[1]) <= 6, f"{box}, not {corner}")
    v.wheel(-3)
    check(abs(v.camera()[0][2] - far) < 0.05, "not back")
    v.close()


def hold(viewer, letter, seconds):
    xdotool("keydown", letter)
    time.sleep(seconds)
    xdotool("keyup", letter)
    viewer.rest()


def letters_fly_while_the_right_button_is_held():
    v = started()
    v.key("1")
    eye = v.camera()[0]
    v.key("d", "q")  # not held: nothing flies
    check(v.camera()[0] == eye, "it flies without the button")
    xdotool("mousedown", 3)
    ways = {"d": (0, 1), "a": (0, -1), "e": (1, 1), "q": (1, -1), "s": (2, 1), "w": (2, -1)}
    gone = {}
    for letter, (axis, sign) in ways.items():
        before = v.camera()[0]
        hold(v, letter, 0.4)
        gone[letter] = [p - q for p, q in zip(v.camera()[0], before)]
        others = [abs(gone[letter][i]) for i in range(3) if i != axis]
        check(sign * gone[letter][axis] > 0.02 and max(others) < 0.01, f"{letter}: {gone[letter]}")
    xdotool("click", "--repeat", 6, "--delay", 30, 4)  # faster
    before = v.camera()[0]
    hold(v, "d", 0.4)
    check(v.camera()[0][0] - before[0] > 1.5 * gone["d"][0], "the wheel does not hurry")
    eye = v.camera()[0]
    for x in range(120, 180, 10):
        v.point(x, 80)
        time.sleep(0.03)
    v.rest()
    check(v.camera()[1][0] > 0.05, f"the mouse does not look about: {v.camera()[1]}")
    check(near(v.camera()[0], eye), "looking moves")
    xdotool("mouseup", 3)
    v.close()


run(
    the_view_is_that_of_render,
    keys_show_each_side,
    five_is_orthographic,
    cameras_of_the_file_come_in_turn,
    home_and_period_frame,
    dragging_turns_and_moves,
    the_wheel_goes_to_the_pointer,
    letters_fly_while_the_right_button_is_held,
)
