"""Files that change, vanish, are broken, or are something else."""

import os
import time

from kit import *

path = os.path.join(here, "cube.gltf")
SWAPPED = (FRONT, BACK, TOP, BOTTOM, RIGHT, LEFT)


def started(*options, **more):
    viewer = Viewer(path, *PLAIN, *options, **more)
    viewer.start = viewer.shown()
    return viewer


def a_changed_file_is_read_again():
    cube(path)
    v = started()
    v.key("1")
    v.wheel(-4)
    view = v.camera()
    check(v.picture().middle() == FRONT, "the start")
    cube(path, colors=SWAPPED)
    until(lambda: v.picture().middle() == RIGHT, "the new colours")
    v.rest()
    check(v.camera() == view, "another view")
    with open(path, "w") as file:
        file.write('{ "asset": ')
    v.heard(r"error: .*cube\.gltf")
    check(v.rest().middle() == RIGHT, "what was loaded does not stay")
    cube(path)
    until(lambda: v.picture().middle() == FRONT, "the colours of before")
    check(v.camera() == view, "another view again")
    v.close()


def a_file_may_vanish():
    cube(path)
    v = started()
    os.unlink(path)
    v.heard("cube.gltf is gone; what was loaded stays")
    check(v.rest() == v.start, "it does not stay")
    since = v.mark()
    xdotool("key", "o")
    v.heard("error: ", since)
    check(v.rest() == v.start, "it does not stay after O")
    seen = v.key("1")
    cube(path, colors=SWAPPED)
    until(lambda: v.picture().middle() == RIGHT, "the file that is there again")
    v.close()


def o_reads_it_again():
    cube(path)
    v = started()
    since = v.mark()
    xdotool("key", "o")
    v.heard("shown: ", since)
    check(v.rest() == v.start, "another picture")
    v.close()


def a_broken_file_is_told():
    broken = os.path.join(here, "broken.gltf")
    with open(broken, "w") as file:
        file.write('{ "asset": { "version": "2.0" }, "meshes": 7 }')
    for input in (broken, os.path.join(here, "absent.glb")):
        v = Viewer(input, words=True, size=(480, 300))
        v.window()
        v.heard("error: ")
        told = v.rest()
        empty = told.at(1, 1)
        check(any(told.at(x, 270) != empty for x in range(40, 440)), "nothing is written")
        check(v.process.poll() is None, "it ended")
        v.close(code=1)
        v = Viewer(input, "--frames", "3", "--exit")
        check(v.ended() == 1, f"exit code {v.process.returncode} of a script")
        check(v.said("error: "), "nothing is said to a script")
    cube(path)
    v = started()
    os.unlink(path)
    v.says("error: ", "o")
    v.close()  # something was seen


run(a_changed_file_is_read_again, a_file_may_vanish, o_reads_it_again, a_broken_file_is_told)
