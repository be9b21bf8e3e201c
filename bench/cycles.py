"""Argand's path tracer beside Blender's, Cycles.  Runs in Blender; cycles.sh calls it.

colors: spheres of several materials under an environment and under a sphere light, in the
        same glTF file for both; the mean colour of each sphere's disk, Argand's over Cycles'.
cost:   a model under an environment: processor time, and noise at equal samples.

Cycles gets the file by Blender's importer, multiple-scattering GGX, and neither denoising,
adaptive sampling, clamping nor blurred reflections; the rest is as Blender has it.
"""
import argparse
import json
import math
import os
import resource
import statistics
import struct
import subprocess
import sys
import tempfile

import bpy
import mathutils
import numpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import walk  # beside this file

numpy.bool = bool  # Blender 3.4's importer wants the name that numpy has dropped

LUMINANCE = numpy.array([0.2126, 0.7152, 0.0722])

# ---- The spheres' file -----------------------------------------------------

# Name, base colour, metallic, roughness, share of the specular lobe.
SPHERES = [
    ("base alone, grey", (0.8, 0.8, 0.8), 0, 1.0, 0),
    ("matte, grey", (0.8, 0.8, 0.8), 0, 1.0, 1),
    ("matte, orange", (0.8, 0.3, 0.1), 0, 1.0, 1),
    ("half rough, grey", (0.5, 0.5, 0.5), 0, 0.5, 1),
    ("half rough, blue", (0.1, 0.2, 0.6), 0, 0.5, 1),
    ("half rough metal", (0.6, 0.6, 0.6), 1, 0.5, 1),
    ("rough gold", (1.0, 0.77, 0.34), 1, 0.8, 1),
    ("rough white metal", (1.0, 1.0, 1.0), 1, 0.8, 1),
]
COLUMNS, ROWS, SPACING = 4, 2, 3.0  # of spheres of radius 1
RINGS, SECTORS = 96, 192
LIGHT = {"position": (-3.0, 9.0, 14.0), "radius": 0.8, "intensity": 900.0}
SIZE = 480, 240


def sphere_center(index):
    x = index % COLUMNS - (COLUMNS - 1) / 2
    y = (ROWS - 1) / 2 - index // COLUMNS
    return [SPACING * x, SPACING * y, 0.0]


def sphere_mesh():
    theta = numpy.linspace(0, math.pi, RINGS + 1)[:, None]
    phi = numpy.linspace(0, 2 * math.pi, SECTORS + 1)[None, :]
    normals = numpy.stack(numpy.broadcast_arrays(
        numpy.sin(theta) * numpy.cos(phi), numpy.cos(theta), -numpy.sin(theta) * numpy.sin(phi)),
        -1).reshape(-1, 3).astype("<f4")
    first = (numpy.arange(RINGS)[:, None] * (SECTORS + 1) + numpy.arange(SECTORS)).reshape(-1)
    below = first + SECTORS + 1
    upper = numpy.stack([first, below + 1, first + 1], -1)[SECTORS:]  # none at the poles
    lower = numpy.stack([first, below, below + 1], -1)[:-SECTORS]
    return normals, numpy.concatenate([upper, lower]).reshape(-1).astype("<u4")


def material(name, color, metallic, roughness, specular):
    return {"name": name, "pbrMetallicRoughness": {
        "baseColorFactor": [*color, 1], "metallicFactor": metallic, "roughnessFactor": roughness},
        "extensions": {"KHR_materials_specular": {"specularFactor": specular}}}


def write_spheres(path, lit):
    normals, indices = sphere_mesh()
    count = len(SPHERES)
    nodes = [{"mesh": i, "translation": sphere_center(i)} for i in range(count)]
    nodes.append({"camera": 0, "translation": [0, 0, 20]})
    document = {
        "asset": {"version": "2.0"}, "scene": 0,
        "extensionsUsed": ["KHR_materials_specular", "KHR_lights_punctual"],
        "materials": [material(*s) for s in SPHERES],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 0}, "indices": 1,
                                    "material": i}]} for i in range(count)],
        "cameras": [{"type": "orthographic", "orthographic": {
            "xmag": COLUMNS * SPACING / 2, "ymag": ROWS * SPACING / 2, "znear": 1, "zfar": 100}}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(normals), "type": "VEC3",
             "min": [-1, -1, -1], "max": [1, 1, 1]},
            {"bufferView": 1, "componentType": 5125, "count": len(indices), "type": "SCALAR"}],
        "bufferViews": [
            {"buffer": 0, "byteLength": normals.nbytes},
            {"buffer": 0, "byteOffset": normals.nbytes, "byteLength": indices.nbytes}],
        "buffers": [{"byteLength": normals.nbytes + indices.nbytes}],
    }
    if lit:
        nodes.append({"translation": LIGHT["position"],
                      "extensions": {"KHR_lights_punctual": {"light": 0}}})
        document["extensions"] = {"KHR_lights_punctual": {"lights": [
            {"type": "point", "intensity": LIGHT["intensity"],
             "extras": {"radius": LIGHT["radius"]}}]}}
    document["nodes"] = nodes
    document["scenes"] = [{"nodes": list(range(len(nodes)))}]
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    data = normals.tobytes() + indices.tobytes()
    with open(path, "wb") as file:
        file.write(struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + len(data), len(text),
                               0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942)
                   + data)


def boxes_of_light(width, height):
    """A dim sky and ground, a warm and a cold box of light with soft edges."""
    u = (numpy.arange(width) + 0.5)[None, :] / width
    v = (numpy.arange(height) + 0.5)[:, None] / height  # from the ground up

    def box(u0, v0, half_u, half_v):
        inside = numpy.minimum(half_u - abs(u - u0), half_v - abs(v - v0)) / 0.02
        return numpy.clip(inside, 0, 1)[..., None]

    up = (v[..., None] + 0 * u[..., None])
    light = (1 - up) * numpy.array([0.20, 0.15, 0.10]) + up * numpy.array([0.25, 0.40, 0.70])
    light = light + box(0.68, 0.75, 0.06, 0.09) * numpy.array([14.0, 11.0, 8.0])
    return light + box(0.90, 0.60, 0.04, 0.14) * numpy.array([3.0, 5.0, 8.0])


def write_environment(path, light):
    """`light`: height x width x 3, from the bottom up."""
    height, width = light.shape[:2]
    image = bpy.data.images.new("environment", width, height, float_buffer=True)
    image.pixels.foreach_set(
        numpy.concatenate([light, numpy.ones((height, width, 1))], -1).astype("f4").ravel())
    image.filepath_raw, image.file_format = path, "OPEN_EXR"
    image.save()


# ---- Both renderers --------------------------------------------------------


def load_pixels(path):
    """height x width x 4, from the bottom up."""
    image = bpy.data.images.load(path)
    width, height = image.size
    pixels = numpy.empty(width * height * 4, "f4")
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return pixels.reshape(height, width, 4).astype("f8")


def cpu_seconds(who):
    usage = resource.getrusage(who)
    return usage.ru_utime + usage.ru_stime


def quietly(call, **arguments):
    """Without what Blender prints on the way."""
    sys.stdout.flush()
    kept = os.dup(1)
    with open(os.devnull, "w") as nowhere:
        os.dup2(nowhere.fileno(), 1)
        try:
            call(**arguments)
        finally:
            os.dup2(kept, 1)
            os.close(kept)


def surfaces_of_cycles():
    for surface in bpy.data.materials:
        for node in surface.node_tree.nodes if surface.use_nodes else []:
            if node.type == "BSDF_PRINCIPLED":
                node.distribution = "MULTI_GGX"


def world_of_cycles(environment):
    world = bpy.data.worlds.new("world")
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = 0, 0, 0, 1
    if environment:
        texture = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
        texture.image = bpy.data.images.load(environment)
        world.node_tree.links.new(texture.outputs["Color"], background.inputs["Color"])
    return world


def open_in_cycles(model, environment):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    # COMPAT: candela stay what they are instead of being divided by 683.
    quietly(bpy.ops.import_scene.gltf, filepath=model, convert_lighting_mode="COMPAT")
    surfaces_of_cycles()
    scene = bpy.context.scene
    scene.world = world_of_cycles(environment)
    scene.camera = next((o for o in scene.objects if o.type == "CAMERA"), None)
    scene.render.engine = "CYCLES"
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.cycles.device = "CPU"
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.cycles.sample_clamp_indirect = 0
    scene.cycles.blur_glossy = 0
    return scene


def cycles(path, size, samples, seed=0, transparent=False):
    """Processor seconds of the render; the picture is at `path`."""
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.resolution_percentage = 100
    scene.render.film_transparent = transparent
    scene.render.filepath = path
    scene.cycles.samples, scene.cycles.seed = samples, seed
    start = cpu_seconds(resource.RUSAGE_SELF)
    quietly(bpy.ops.render.render, write_still=True)
    return cpu_seconds(resource.RUSAGE_SELF) - start


def argand(program, path, size, samples, model, environment, *more):
    """Processor seconds of the whole process, and what it says."""
    start = cpu_seconds(resource.RUSAGE_CHILDREN)
    said = subprocess.run(
        [program, "reference", model, "-o", path, "--env", environment or "none", "--json",
         "--size", "%dx%d" % size, "--spp", str(samples), "--exposure", "1", "--tonemap", "none",
         *more], check=True, stdout=subprocess.PIPE).stdout
    return cpu_seconds(resource.RUSAGE_CHILDREN) - start, json.loads(said)


# ---- Colours ---------------------------------------------------------------


def disk_mean(pixels, index):
    height, width = pixels.shape[:2]
    scale = height / (ROWS * SPACING)
    x, y, _ = sphere_center(index)
    u = (numpy.arange(width)[None, :] + 0.5 - width / 2) / scale - x
    v = (numpy.arange(height)[:, None] + 0.5 - height / 2) / scale - y
    return pixels[u * u + v * v < 0.97 ** 2][:, :3].mean(0)


def lobe_albedo(NoV, roughness, f0=0.04, count=1 << 14):
    wo = numpy.tile([math.sqrt(1 - NoV * NoV), 0, NoV], (count, 1))
    return walk.walk(wo, roughness ** 2, f0, walk.glass).mean()


def walk_over_cycles(index, count=1 << 16):
    """Of a metal sphere's disk under the light: what a walk returns over what Cycles does."""
    _, color, _, roughness, _ = SPHERES[index]
    alpha = roughness ** 2
    wo, wi = walk.ball(LIGHT["position"], sphere_center(index), count, numpy.random.default_rng(1))
    ratios = []
    for f0 in color:
        one = walk.one_bounce(wo, wi, alpha, f0, walk.glass).sum()
        more, as_cycles = (walk.walk(wo, alpha, f0, walk.glass, wi, known).sum()
                           for known in (False, True))
        ratios.append((one + more) / (one + as_cycles))
    return numpy.array(ratios)


def same_lobe(node, f0):
    """Principled's metal has any f0, and the curve of the index that `Specular` asks for."""
    node.inputs["Base Color"].default_value = *f0, 1
    node.inputs["Metallic"].default_value = 1
    node.inputs["Specular"].default_value = ((walk.INDEX - 1) / (walk.INDEX + 1)) ** 2 / 0.08


def same_surface(color, metallic, roughness, specular, tree):
    """glTF's surface of Cycles' parts: a dielectric is Lambert's base under the lobe, of what that
    leaves.  Blender's Principled surface has Disney's base, and adds the lobe to all of it.
    """
    nodes, link = tree.nodes, tree.links.new
    lobe = next(n for n in nodes if n.type == "BSDF_PRINCIPLED")
    output = next(n for n in nodes if n.type == "OUTPUT_MATERIAL")
    same_lobe(lobe, color if metallic else (0.04, 0.04, 0.04))
    if metallic:
        return
    angle, ramp = nodes.new("ShaderNodeLayerWeight"), nodes.new("ShaderNodeValToRGB")
    angle.inputs["Blend"].default_value = 0.5  # Facing is then 1 - NoV
    link(angle.outputs["Facing"], ramp.inputs["Fac"])
    stops = ramp.color_ramp.elements
    for i in range(32):
        place = 1 - (1 - i / 31) ** 2  # closer at grazing angles
        stop = stops.new(place) if 0 < i < 31 else stops[-1 if i else 0]
        left = 1 - specular * lobe_albedo(max(1 - place, 1e-3), roughness)
        stop.color = *(c * left for c in color), 1
    base, sum_of = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeAddShader")
    link(ramp.outputs["Color"], base.inputs["Color"])
    link(base.outputs["BSDF"], sum_of.inputs[0])
    if specular:
        link(lobe.outputs["BSDF"], sum_of.inputs[1])
    link(sum_of.outputs["Shader"], output.inputs["Surface"])


def compare_colors(program, folder, title, environment, samples):
    model = os.path.join(folder, "spheres.glb")
    names = ("argand", "principled", "same")
    paths = [os.path.join(folder, "%s, %s.exr" % (title, name)) for name in names]
    write_spheres(model, lit=environment is None)
    argand(program, paths[0], SIZE, samples, model, environment, "--camera", "0")
    open_in_cycles(model, environment)
    # Its walk is right as it is sampled, not as it is evaluated: the sky is met, not sought.
    bpy.context.scene.world.cycles.sampling_method = "NONE"
    for light in bpy.data.lights:
        light.shadow_soft_size = LIGHT["radius"]
    cycles(paths[1], SIZE, samples)
    for name, *surface in SPHERES:
        same_surface(*surface, bpy.data.materials[name].node_tree)
    cycles(paths[2], SIZE, samples)
    ours, *theirs = map(load_pixels, paths)
    print("\n%-20s %20s   %23s   %23s   %s"
          % (title, "Argand", "/ Principled", "/ same surface", "" if environment else "/ walk"))
    worst = 0
    for index, (name, _, metallic, _, _) in enumerate(SPHERES):
        mean = disk_mean(ours, index)
        ratios = [mean / disk_mean(t, index) for t in theirs]
        if metallic and not environment:
            ratios.append(ratios[1] / walk_over_cycles(index))
        worst = max(worst, abs(ratios[-1] - 1).max())
        print("%-20s" % name + "   ".join("%7.3f %7.3f %7.3f" % tuple(x)
                                          for x in (mean, *ratios)))
    return worst


def colors(options):
    with tempfile.TemporaryDirectory() as folder:
        folder = options.keep or folder
        boxes, even = (os.path.join(folder, n + ".exr") for n in ("boxes", "even"))
        write_environment(boxes, boxes_of_light(512, 256))
        write_environment(even, numpy.ones((16, 32, 3)))
        worst = max(compare_colors(options.argand, folder, *case, options.samples or 256)
                    for case in (("even", even), ("environment", boxes), ("sphere light", None)))
    print("\n%s: the furthest colour is %.1f %% from that of the same surface (metals under the"
          "\nlight: as a walk has them, which Cycles misses there); 2 %% was wanted"
          % ("PASS" if worst <= 0.02 else "FAIL", 100 * worst))


# ---- Cost and noise --------------------------------------------------------


def frame_model(distance):
    """A camera at 45 degrees for Cycles; the same view in Argand's words."""
    scene = bpy.context.scene
    corners = numpy.array([o.matrix_world @ mathutils.Vector(c) for o in scene.objects
                           if o.type == "MESH" for c in o.bound_box])
    low, high = corners.min(0), corners.max(0)
    target = mathutils.Vector((low + high) / 2)
    distance = distance or numpy.linalg.norm(high - low) / 2 / math.sin(math.radians(45) / 2)
    theta, phi = math.radians(35), math.radians(70)
    back = mathutils.Vector((math.sin(phi) * math.sin(theta), -math.sin(phi) * math.cos(theta),
                             math.cos(phi)))
    data = bpy.data.cameras.new("camera")
    data.sensor_fit, data.angle = "VERTICAL", math.radians(45)
    scene.camera = bpy.data.objects.new("camera", data)
    scene.camera.location = target + back * distance
    scene.camera.rotation_euler = (-back).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(scene.camera)
    return ["--orbit", "35,70,%.9g" % distance,
            "--target", "%.9g,%.9g,%.9g" % (target.x, target.z, -target.y)]


def time_both(options, folder, view):
    """A run of one sample is what it takes to start, and what each needs for its structures."""
    size = options.size, options.size
    theirs, ours = {}, {}
    for samples in options.runs * [1, options.samples or 64]:
        seconds = cycles(os.path.join(folder, "cycles.exr"), size, samples)
        theirs.setdefault(samples, []).append(seconds)
        seconds, said = argand(options.argand, os.path.join(folder, "argand.exr"), size, samples,
                               options.model, options.environment, *view)
        ours.setdefault(samples, []).append(seconds)
    (c1, c), (a1, a) = (map(statistics.median, t.values()) for t in (theirs, ours))
    print("\nprocessor seconds, %dx%d pixels, %d samples each, medians of %d runs in turn"
          % (*size, samples, options.runs))
    print("                             Cycles   Argand")
    print("  the render; the process   %7.2f  %7.2f   1/%.2f" % (c, a, c / a))
    c1, a1 = c - c1, a - a1
    print("  less that of one sample   %7.2f  %7.2f   1/%.2f" % (c1, a1, c1 / a1))
    print("  Argand's rays             %7.2f million in each such second"
          % (said["rays"] * (1 - 1 / samples) / a1 / 1e6))


def luminance(path):
    """And which pixels are the model's."""
    picture = load_pixels(path)
    return picture[..., :3] @ LUMINANCE, picture[..., 3] > 0.5


def relative_errors(paths, truth):
    """At the model's pixels; all is before black."""
    truth, seen = luminance(truth)
    floor = truth[seen].mean() / 20
    return numpy.concatenate([(abs(luminance(path)[0] - truth) / numpy.maximum(truth, floor))[seen]
                              for path in paths])


def noise_of_both(options, folder, view):
    """Some pixels find a lamp once in many thousand samples: one seed alone says little."""
    size, samples, seeds = (128, 128), options.samples or 64, range(1, options.seeds + 1)
    many = 64 * samples
    scene = bpy.context.scene  # Argand's filter, of .47 px: Blender's "width" is 4 deviations
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = "GAUSSIAN", 1.88

    def path(*words):
        return os.path.join(folder, "-".join(map(str, words)) + ".exr")

    for count, seed in [(many, 1000)] + [(samples, seed) for seed in seeds]:
        cycles(path("cycles", count, seed), size, count, seed, transparent=True)
        argand(options.argand, path("argand", count, seed), size, count, options.model,
               options.environment, *view, "--seed", str(seed), "--background", "transparent")
    c, a = (relative_errors([path(who, samples, seed) for seed in seeds], path(who, many, 1000))
            for who in ("cycles", "argand"))
    print("\nnoise of %d samples at %dx%d pixels, %d seeds, relative to each one's own %d, per cent"
          % (samples, *size, len(seeds), many))
    print("                             Cycles   Argand")
    for name, of in (("root of the mean square", lambda e: math.sqrt((e * e).mean())),
                     ("mean", numpy.mean), ("median", numpy.median),
                     ("the hundredth pixel", lambda e: numpy.percentile(e, 99)),
                     ("the thousandth", lambda e: numpy.percentile(e, 99.9))):
        print("  %-24s  %7.1f  %7.1f   1/%.2f" % (name, 100 * of(c), 100 * of(a), of(c) / of(a)))


def cost(options):
    open_in_cycles(options.model, options.environment)
    view = frame_model(options.distance)
    with tempfile.TemporaryDirectory() as folder:
        folder = options.keep or folder
        if options.runs:
            time_both(options, folder, view)
        noise_of_both(options, folder, view)


def parse():
    parser = argparse.ArgumentParser(prog="cycles.sh", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--argand", default="build/release/argand")
    parser.add_argument("--samples", type=int, help="a pixel (256 for colors, 64 for cost)")
    parser.add_argument("--keep", help="a folder for the pictures")
    tasks = parser.add_subparsers(dest="task", required=True)
    tasks.add_parser("colors").set_defaults(run=colors)
    costs = tasks.add_parser("cost")
    costs.set_defaults(run=cost)
    costs.add_argument("model")
    costs.add_argument("environment")
    costs.add_argument("--size", type=int, default=1024)
    costs.add_argument("--runs", type=int, default=3)
    costs.add_argument("--seeds", type=int, default=16, help="that noise is measured with")
    costs.add_argument("--distance", type=float, help="of the camera (all is seen)")
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1:])


options = parse()
options.run(options)
