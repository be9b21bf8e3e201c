"""What may go wrong around the viewer, and how little it does at rest."""

import json
import os
import signal
import time

from kit import *

scene = cube(os.path.join(here, "cube.gltf"))


def refused(code, sentence, *options, **environment):
    v = Viewer(*(options or (scene, *PLAIN)), **environment)
    check(v.ended() == code, f"exit code {v.process.returncode}, not {code}")
    errors = [line for line in v.lines if "Sans.ttf" not in line]
    check(len(errors) == 1 and re.search(sentence, errors[0]), f"not one sentence: {v.lines}")
    check(v.out == "", f"printed: {v.out}")


def what_is_missing_is_told_in_one_sentence():
    refused(1, "no display", DISPLAY="")
    refused(1, "no display", DISPLAY=":4095")
    absent = "/nonexistent"
    refused(1, "no Vulkan driver", VK_DRIVER_FILES=absent, VK_ICD_FILENAMES=absent)
    refused(1, "no Vulkan device is", scene, "--device", "a device of nobody's")
    refused(2, "frames", scene, "--frames", "many")
    refused(2, "-o", scene, "-o", "picture.png")


def frames_are_counted():
    for options in ((), ("--json",)):
        v = Viewer(scene, *PLAIN, "--frames", "5", "--exit", *options)
        check(v.ended() == 0, f"exit code {v.process.returncode}")
        if options:
            told = json.loads(v.out)
            check(told["frames"] == 5 and told["median_frame_ms"] > 0, v.out)
            check(0 < told["first_pixels_ms"] <= told["scene_shown_ms"], v.out)
        else:
            check(re.match(r"5 frames, \S+ ms each; the first pixels after \d+ ms", v.out), v.out)


def fonts_may_be_missing():
    v = Viewer(scene, *PLAIN)
    start = v.shown()
    v.heard("fonts-dejavu-core")
    check(v.key("h", "Tab") == start, "something is written")
    v.close()


def at_rest_nothing_is_done():
    v = Viewer(scene, *PLAIN, words=True)
    v.shown()
    v.key("Tab")
    pictures, before = v.mark(), v.cpu_s()
    time.sleep(5)
    used = (v.cpu_s() - before) / 5
    check(used < 0.02, f"{100 * used:.1f} % of a core")
    check(v.said("shown: ", pictures) is None, "it draws")
    v.close()


def no_release_is_lost():
    """However many events come while the viewer is not heard."""
    v = Viewer(scene, *PLAIN)
    v.shown()
    v.point(120, 80)
    v.process.send_signal(signal.SIGSTOP)
    xdotool("mousedown", 1)
    for _ in range(3):
        xdotool("key", "--delay", 1, *("bracketleft", "bracketright") * 100)
    xdotool("mouseup", 1)
    v.process.send_signal(signal.SIGCONT)
    before = v.rest()
    v.point(180, 80)
    check(v.rest() == before, "the button is still held: the view turns")
    v.close()


def fail_once(path, call, code):
    with open(path + ".new", "w") as file:
        file.write(f"{call} {code}\n")
    os.rename(path + ".new", path)


def a_lost_device_is_opened_again():
    fault = os.path.join(here, "fault")
    v = Viewer(scene, *PLAIN, "--validate", preload=(os.environ["ARGAND_TEST_FAULTS"],),
               ARGAND_TEST_FAULT=fault)
    v.start = v.shown()
    for call, code in (("vkQueueSubmit2", -4), ("vkQueuePresentKHR", -1000000000)):
        since = v.mark()
        fail_once(fault, call, code)
        xdotool("key", "3")
        v.heard("the device was lost and is opened again", since)
        check(v.rest().middle() == RIGHT, "the picture does not come again")
        check(v.key("Return") == v.start, "nor the one of before")
    for call in ("vkAcquireNextImageKHR", "vkQueuePresentKHR"):  # out of date
        fail_once(fault, call, -1000001004)
        check(v.key("1").middle() == FRONT, f"{call}: no picture")
        check(not os.path.exists(fault), f"{call} was not called")
        v.key("Return")
    v.close()


run(
    what_is_missing_is_told_in_one_sentence,
    frames_are_counted,
    fonts_may_be_missing,
    at_rest_nothing_is_done,
    no_release_is_lost,
    a_lost_device_is_opened_again,
)
