"""Lights and materials: picked, dragged, changed and saved."""

import os

from kit import *

white = cube(os.path.join(here, "white.gltf"), roughness=0.5)
LIGHT = ("--light", "sphere at=0,0,2 radius=0.05 intensity=3")
FRONT_VIEW = ("--env", "none", "--tonemap", "none", "--background", "#000000", "--camera", "front")


def started(*options, **more):
    viewer = Viewer(white, *FRONT_VIEW, *options, **more)
    viewer.start = viewer.shown()
    return viewer


def contents(path):
    """The JSON of a .glb."""
    with open(path, "rb") as file:
        data = file.read()
    check(data[:4] == b"glTF", f"{path} is no .glb")
    length = int.from_bytes(data[12:16], "little")
    return json.loads(data[20 : 20 + length])


def written(viewer):
    """F5: the new file and its scene."""
    name = viewer.says(r"saved (\w+-\d+\.glb)", "F5")[1]
    path = os.path.join(here, name)
    command("info", path)
    viewer.rest()
    return path, contents(path)


def materials_change_and_are_saved():
    v = started(*LIGHT)
    v.says("nothing is picked", "Up")
    check(v.rest() == v.start, "something changed")
    v.click(120, 110)  # the front: below the light
    rougher = v.key("Up", "Up")
    check(rougher != v.start, "Up: nothing to be seen")
    check(v.key("Down", "Down") == v.start, "Down is not the opposite of Up")
    metal = v.key("Right", "Right", "Right")
    check(metal != v.start, "Right: nothing to be seen")
    check(v.key("Left", "Left", "Left") == v.start, "Left is not the opposite of Right")
    v.point(120, 110)
    v.wheel(4, "ctrl")
    v.wheel(2, "shift")
    path, scene = written(v)
    side = scene["materials"][4]
    found = side["pbrMetallicRoughness"]
    check(side["name"] == "side 4", f"another one: {side}")
    check(abs(found["roughnessFactor"] - 0.7) < 1e-5, f"roughness {found}")
    check(abs(found["metallicFactor"] - 0.1) < 1e-5, f"metalness {found}")
    other = scene["materials"][5]["pbrMetallicRoughness"]
    check(abs(other["roughnessFactor"] - 0.5) < 1e-5, "another one changed")
    again = rendered(path, *FRONT_VIEW, "--size", "240x160")
    check(again == v.picture(), "what was saved looks different")
    v.close()


def words_name_what_is_under_the_pointer():
    v = started(*LIGHT, size=(480, 300), words=True)
    v.point(470, 10)  # on nothing
    before = v.rest()
    v.point(240, 220)
    hovered = v.rest()
    lower_left = (0, 240, 240, 300)
    check(hovered.part(*lower_left) != before.part(*lower_left), "no name of the material")
    v.point(470, 10)
    check(v.rest() == before, "the name stays")
    v.click(240, 220)
    v.point(470, 10)
    named = v.rest().part(*lower_left)
    check(named != before.part(*lower_left), "what is picked is not named")
    v.key("Up")
    check(v.picture().part(*lower_left) != named, "its roughness is not written")
    xdotool("key", "Escape")
    check(v.rest().part(*lower_left) == before.part(*lower_left), "Esc does not let go")
    v.close()


def lights_are_picked_and_changed():
    v = started(*LIGHT)
    marked = v.key("l")
    check(marked != v.start, "L: no mark")
    brighter = v.key("Up", "Up")
    check(brighter.mean() > 1.1 * marked.mean(), "Up: not brighter")
    check(v.key("Down", "Down").apart(marked) == 0, "Down is not the opposite of Up")
    v.key("Right", "Right", "Right", "Right")
    v.point(120, 80)
    v.wheel(3, "ctrl")
    _, scene = written(v)
    (light,) = scene["extensions"]["ARGAND_lights"]["lights"]
    check(abs(light["intensity"] / (3 * 1.25**3) - 1) < 1e-4, f"intensity: {light}")
    check(abs(light["radius"] / (0.05 * 1.15**4) - 1) < 1e-4, f"radius: {light}")
    v.key("Escape")
    v.close()


def lights_are_dragged():
    v = started(*LIGHT)
    v.key("l")
    camera = v.camera()
    at = (120, 80)  # 1 m before the camera, on its axis
    dragged = v.drag(*at, 150, 65)
    check(v.camera() == camera, "the view turned")
    check(dragged != v.start, "nothing moved")
    # In the plane through it: 30 px of 160 px, which are 2 tan(0.4) m high there.
    px = 2 * math.tan(0.4) / 160
    moved = f"sphere at={30 * px:.6f},{15 * px:.6f},2 radius=0.05 intensity=3"
    v.key("Escape")
    wanted = rendered(white, *FRONT_VIEW, "--size", "240x160", "--light", moved)
    check(v.picture().apart(wanted) < 0.002, f"not there: {v.picture().apart(wanted)}")
    # Beside it a drag turns.
    v.drag(30, 30, 60, 30)
    check(v.camera() != camera, "the view does not turn")
    v.close()


def points_become_spheres():
    v = started("--light", "point at=0,0.3,2 intensity=3")
    v.key("l", "Right", "Right")
    _, scene = written(v)
    check("radius" in json.dumps(scene), "no radius")
    v.close()
    v = started()
    v.says("the scene has no lights", "l")
    v.close()


def edits_of_a_draft_are_kept():
    input, hold, held = large(os.path.join(here, "large.gltf"))
    v = Viewer(input, *FRONT_VIEW, *LIGHT, **held)
    v.shown()
    v.click(120, 110)
    v.key("Up", "Up", "Right")
    v.key("l", "Up")
    v.says("not yet there with all its textures", "F5")
    since = v.mark()
    os.unlink(hold)
    v.heard("shown: ", since)
    _, scene = written(v)
    found = scene["materials"][4]["pbrMetallicRoughness"]
    check("baseColorTexture" in found, "the texture did not come")
    check(abs(found["roughnessFactor"] - 0.6) < 1e-5, f"roughness {found}")
    check(abs(found["metallicFactor"] - 0.05) < 1e-5, f"metalness {found}")
    v.key("Up")  # the light is still picked
    _, scene = written(v)
    (light,) = scene["extensions"]["ARGAND_lights"]["lights"]
    check(abs(light["intensity"] / (3 * 1.25**2) - 1) < 1e-4, f"intensity: {light}")
    v.close()


def lights_come_in_turn():
    two = ("--light", "sphere at=-0.4,0,2 radius=0.05 intensity=3",
           "--light", "sphere at=0.4,0,2 radius=0.05 intensity=3")
    v = started(*two)
    left, right = v.start.part(0, 0, 120, 160), v.start.part(120, 0, 240, 160)
    first = v.key("l")
    check(first.part(120, 0, 240, 160) == right and first.part(0, 0, 120, 160) != left, "first")
    second = v.key("l")
    check(second.part(0, 0, 120, 160) == left and second.part(120, 0, 240, 160) != right, "next")
    check(v.key("l") == first, "not the first again")
    v.close()


run(
    materials_change_and_are_saved,
    words_name_what_is_under_the_pointer,
    lights_are_picked_and_changed,
    lights_are_dragged,
    points_become_spheres,
    lights_come_in_turn,
    edits_of_a_draft_are_kept,
)
