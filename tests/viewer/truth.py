"""R: the picture and its ground truth, side by side."""

import os

from kit import *

white = cube(os.path.join(here, "white.gltf"), roughness=0.8)
truth = os.path.join(here, "truth.png")
# The light stands before the cube and casts light from its side, too: the pictures differ there.
LIT = ("--env", "none", "--tonemap", "none", "--background", "#000000", "--camera", "front",
       "--light", "sphere at=0.9,0.4,1 radius=0.2 intensity=2", "--light", "ambient intensity=0.2")


def split_at(picture):
    """Where the line is: columns that are white from top to bottom; None: nowhere."""
    white_column = b"\xff" * 3 * picture.height
    columns = [
        x for x in range(picture.width)
        if b"".join(picture.rgb[3 * (y * picture.width + x) :][:3]
                    for y in range(picture.height)) == white_column
    ]
    return (columns[0] + columns[-1] + 1) / 2 if columns else None


def line_comes(viewer, at):
    until(lambda: (split_at(viewer.picture()) or -9) == at, f"the line at {at}")


def started(*options, **more):
    viewer = Viewer(white, *LIT, *options, **more)
    viewer.start = viewer.shown()
    return viewer


def off(a, b):
    return sum(abs(p - q) for p, q in zip(a.rgb, b.rgb)) / len(a.rgb)


def right_of(picture, x):
    return picture.part(x + 4, 0, picture.width, picture.height)


def left_of(picture, x):
    return picture.part(0, 0, x - 4, picture.height)


def the_truth_is_right_of_the_line():
    command("reference", white, *LIT, "--size", "240x160", "--spp", 256, "-o", truth, "--quiet")
    wanted = read_png(truth)
    v = started()
    # So different that one cannot pass for the other.
    plain = off(right_of(v.start, 120), right_of(wanted, 120))
    check(plain > 1, f"there is nothing to be seen: {plain}")
    xdotool("key", "r")
    line_comes(v, 120)
    until(lambda: off(right_of(v.picture(), 120), right_of(wanted, 120)) < plain / 4, "the truth")
    check(left_of(v.picture(), 120) == left_of(v.start, 120), "left of it is another picture")
    said = v.heard(r"FLIP to the reference of (1[6-9]|[2-9]\d|\d{3,}) samples: (\S+)\.$")
    here_png = os.path.join(here, "picture.png")
    command("render", white, *LIT, "--size", "240x160", "-o", here_png, "--quiet")
    told = json.loads(command("compare", truth, here_png, "--json"))
    ratio = float(said[2]) / told["flip"]
    check(0.8 < ratio < 1.25, f"FLIP is {said[2]}, but {told['flip']} by `argand compare`")
    xdotool("key", "r")
    check(v.rest() == v.start, "R and R")
    v.close()


def the_line_moves():
    v = started()
    xdotool("key", "r")
    line_comes(v, 120)
    for key, at in (("bracketleft", 108), ("bracketleft", 96), ("bracketright", 108)):
        xdotool("key", key)
        line_comes(v, at)
    camera = v.camera()
    v.point(108, 40)
    xdotool("mousedown", 1)
    for x in range(108, 201, 4):
        v.point(x, 60)
    xdotool("mouseup", 1)
    line_comes(v, 200)
    check(v.camera() == camera, "the view turned")
    v.close()


def movement_begins_anew():
    v = started()
    xdotool("key", "r")
    v.heard("FLIP to the reference of [4-9] samples")
    eye = v.camera()[0]
    since = v.mark()
    v.drag(30, 120, 60, 120, waits=False)
    until(lambda: v.camera()[0] != eye, "another view")
    v.heard("FLIP to the reference of [1-3] samples", since)
    line_comes(v, 120)
    xdotool("key", "r")
    v.rest()
    check(not v.said("stopped"), "that a movement ends the tracing is told")
    v.close()


run(the_truth_is_right_of_the_line, the_line_moves, movement_begins_anew)
