"""The viewer on a desktop: a window manager, files that are dropped, displays of high density."""

import os
import time

from desktop_kit import *

SCREEN = (800, 500)
scene = cube(os.path.join(here, "cube.gltf"))
FRONT_VIEW = (*PLAIN, "--camera", "front")


def wanted(size, input=scene):
    return rendered(input, *FRONT_VIEW, "--size", f"{size[0]}x{size[1]}")


def fills(viewer, size):
    """The picture is that of a window of this size, once it rests."""
    want = wanted(size)
    until(lambda: viewer.rest() and viewer.picture(size) == want, f"a picture of {size}")


def on_desktop(test):
    def run_it():
        desktop = Desktop()
        try:
            test(desktop)
        finally:
            desktop.close()

    run_it.__name__ = test.__name__
    return run_it


@on_desktop
def f11_fills_the_display(desktop):
    desktop.manage()
    v = Viewer(scene, *FRONT_VIEW, "--validate")
    v.shown()
    v.point(120, 80)
    for _ in range(3):
        xdotool("key", "F11")
        fills(v, SCREEN)
        xdotool("key", "F11")
        fills(v, v.size)
    v.close()


@on_desktop
def maximised_windows_are_filled(desktop):
    desktop.manage()
    v = Viewer(scene, *FRONT_VIEW, "--validate")
    v.shown()
    window = desktop.window_of(v)
    for _ in range(2):
        desktop.maximise(window, True)
        fills(v, SCREEN)
        desktop.maximise(window, False)
        fills(v, v.size)
    v.close()


def works_little(viewer, seconds=3):
    before = viewer.cpu_s()
    time.sleep(seconds)
    used = (viewer.cpu_s() - before) / seconds
    check(used < 0.02, f"{100 * used:.1f} % of a core")


@on_desktop
def minimised_windows_do_nothing(desktop):
    desktop.manage()
    v = Viewer(scene, *FRONT_VIEW, "--validate", words=True)
    v.shown()
    v.point(2, 2)  # on nothing that has a name
    start = v.rest()
    window = desktop.window_of(v)
    desktop.minimise(window)
    v.rest()
    works_little(v)
    since = v.mark()
    cube(scene, colors=SIDES[::-1])  # it is read, but not drawn
    time.sleep(2)
    works_little(v)
    check(v.said("shown: ", since) is None, "it draws")
    desktop.restore(window)
    v.heard("shown: ", since)
    other = v.rest()
    check(other.middle() == SIDES[::-1][4], f"not the new colours: {other.middle()}")
    cube(scene)
    until(lambda: v.rest() == start, "the picture of before")
    v.says("FLIP", "r")
    desktop.minimise(window)  # nobody looks at the ground truth
    v.rest()
    works_little(v)
    since = v.mark()
    desktop.restore(window)
    v.heard("FLIP", since)
    v.window()
    v.close()


@on_desktop
def dropped_files_are_opened(desktop):
    other = cube(os.path.join(here, "a cube, größer.gltf"), colors=SIDES[::-1])
    v = Viewer(scene, *FRONT_VIEW, "--validate")
    start = v.shown()
    window = desktop.window_of(v)
    since = v.mark()
    desktop.drop(window, other)
    v.heard("shown: ", since)
    second = v.rest()
    check(second != start, "it is not shown")
    name = bytes(desktop.property(window, "_NET_WM_NAME")).decode()
    check(name.startswith("a cube, größer.gltf"), f"the title is {name}")
    broken = os.path.join(here, "broken.glb")
    with open(broken, "w") as file:
        file.write("glTF, but not really")
    for path in (broken, os.path.join(here, "absent.glb"), here):
        since = v.mark()
        desktop.drop(window, path)
        v.heard("error: ", since)
        check(v.rest() == second, "what was there does not stay")
    since = v.mark()
    xdotool("key", "o")  # what is shown, not what was dropped in vain
    v.heard("shown: ", since)
    check(v.rest() == second, "another picture")
    cube(other)
    until(lambda: v.rest() != second, "what is shown is read again when it changes")
    v.close()


def panel(viewer):
    """Of the pixels that the help is written on: left, top, right, bottom."""
    size = viewer.size
    viewer.rest()
    before = viewer.picture(size)
    viewer.key("h")
    after = viewer.picture(size)
    changed = [
        i for i in range(size[0] * size[1])
        if before.rgb[3 * i : 3 * i + 3] != after.rgb[3 * i : 3 * i + 3]
    ]
    check(changed, "nothing is written")
    x, y = [i % size[0] for i in changed], [i // size[0] for i in changed]
    return min(x), min(y), max(x) + 1, max(y) + 1


@on_desktop
def letters_are_larger_on_dense_displays(desktop):
    boxes = []
    for dpi in (96, 192):
        desktop.set_density(dpi)
        v = Viewer(scene, *FRONT_VIEW, "--validate", size=(400, 250), words=True)
        v.shown()
        v.size = desktop.size_of(desktop.window_of(v))
        check(v.size == (400 * dpi // 96, 250 * dpi // 96), f"the window has {v.size} px")
        v.point(v.size[0] - 2, v.size[1] - 2)
        boxes.append(panel(v))
        v.close()
    desktop.set_density(96)
    for small, large in zip(*boxes):
        check(abs(large - 2 * small) <= 12, f"{boxes[1]} are not twice {boxes[0]}")


run(
    f11_fills_the_display,
    maximised_windows_are_filled,
    minimised_windows_do_nothing,
    dropped_files_are_opened,
    letters_are_larger_on_dense_displays,
)
