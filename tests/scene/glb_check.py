"""Is a .glb sound, as the glTF 2.0 specification has it?

    glb_check.py FILE

Reads the container, follows every index and measures every accessor; knows nothing of Argand.
"""
import json
import math
import struct
import sys
import zlib

SIZES = {5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4}
LETTERS = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", 5126: "f"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


def need(holds, sentence):
    if not holds:
        sys.exit(f"{sys.argv[1]}: {sentence}")


def read_container(data):
    magic, version, total = struct.unpack_from("<4sII", data)
    need(magic == b"glTF" and version == 2, "no glTF 2")
    need(total == len(data), "the header's length is not the file's")
    chunks, at = [], 12
    while at < total:
        size, kind = struct.unpack_from("<I4s", data, at)
        need(size % 4 == 0, "a chunk is no multiple of 4")
        chunks.append((kind, data[at + 8:at + 8 + size]))
        at += 8 + size
    need(at == total, "the last chunk ends elsewhere")
    need([kind for kind, _ in chunks] in ([b"JSON"], [b"JSON", b"BIN\0"]), "its chunks")
    binary = chunks[1][1] if len(chunks) > 1 else b""
    return json.loads(chunks[0][1].decode("utf-8")), binary


def check_views(root, binary):
    buffers = root.get("buffers", [])
    need(len(buffers) == (1 if binary else 0), "not one buffer")
    end = 0
    for view in root.get("bufferViews", []):
        need(view["buffer"] == 0 and view["byteLength"] > 0, "a view is empty")
        need(view["byteOffset"] % 4 == 0, "a view is not aligned")
        need(view["byteOffset"] >= end, "views overlap")
        end = view["byteOffset"] + view["byteLength"]
        need(end <= buffers[0]["byteLength"] <= len(binary), "a view leaves the buffer")
    need(len(binary) - end < 4, "bytes that nothing uses")


def columns_of(root, binary, index):
    accessor = root["accessors"][index]
    view = root["bufferViews"][accessor["bufferView"]]
    width = WIDTHS[accessor["type"]]
    size = width * SIZES[accessor["componentType"]]
    need(size % 4 == 0 or accessor["type"] == "SCALAR", "rows are not aligned")
    need(accessor["count"] * size == view["byteLength"], "an accessor does not fill its view")
    values = struct.unpack_from(
        "<%d%s" % (accessor["count"] * width, LETTERS[accessor["componentType"]]),
        binary, view["byteOffset"])
    need(all(map(math.isfinite, values)), f"accessor {index} is not finite")
    return [values[i::width] for i in range(width)]


def single(x):
    return struct.unpack("<f", struct.pack("<f", x))[0]


def check_primitive(root, binary, primitive):
    attributes, columns = primitive["attributes"], {}
    count = root["accessors"][attributes["POSITION"]]["count"]
    for name, index in attributes.items():
        accessor, columns[name] = root["accessors"][index], columns_of(root, binary, index)
        target = root["bufferViews"][accessor["bufferView"]].get("target")
        need(target == 34962, "an attribute's view is not an ARRAY_BUFFER")
        need(accessor["count"] == count, f"{name} has other counts")
        if "min" in accessor or name == "POSITION":
            low, high = map(min, columns[name]), map(max, columns[name])
            need([single(x) for x in accessor["min"]] == list(low), f"{name}: min")
            need([single(x) for x in accessor["max"]] == list(high), f"{name}: max")
    for name in {"NORMAL", "TANGENT"} & set(columns):
        lengths = list(map(math.hypot, *columns[name][:3]))
        need(0.999999 < min(lengths) and max(lengths) < 1.000001, f"{name} is not unit")
    need(set(columns.get("TANGENT", [[]])[-1]) <= {1, -1}, "a handedness")
    need("TEXCOORD_0" in columns or "TEXCOORD_1" not in columns, "a second uv set without a first")
    indices = columns_of(root, binary, primitive["indices"])[0]
    kind = root["accessors"][primitive["indices"]]
    need(root["bufferViews"][kind["bufferView"]]["target"] == 34963, "indices' view")
    need(len(indices) % 3 == 0 and max(indices) < count, "indices")
    need(max(indices) != {5123: 65535, 5125: 2**32 - 1}[kind["componentType"]], "restart")


def check_png(root, binary, image):
    need(image["mimeType"] == "image/png", "an image is no PNG")
    view = root["bufferViews"][image["bufferView"]]
    data = binary[view["byteOffset"]:view["byteOffset"] + view["byteLength"]]
    need(data[:8] == b"\x89PNG\r\n\x1a\n", "a PNG's signature")
    at = 8
    while at < len(data):
        size, = struct.unpack_from(">I", data, at)
        crc, = struct.unpack_from(">I", data, at + 8 + size)
        need(zlib.crc32(data[at + 4:at + 8 + size]) == crc, "a PNG's checksum")
        at += 12 + size
    need(at == len(data) and data[-8:-4] == b"IEND", "a PNG's end")


def check_nodes(root):
    nodes = root.get("nodes", [])
    need(root["scenes"][root["scene"]].get("nodes", []) == list(range(len(nodes))), "the scene")
    for node in nodes:
        need("matrix" not in node or not {"translation", "rotation", "scale"} & set(node),
             "a node has a matrix and more")
        need(node.get("mesh", 0) < len(root.get("meshes", [0])), "a node's mesh")
        need(node.get("camera", 0) < len(root.get("cameras", [0])), "a node's camera")


def check_cameras(root):
    for camera in root.get("cameras", []):
        kind = camera["type"]
        c = camera[kind]
        if kind == "perspective":
            need(0 < c["yfov"] < math.pi and c["znear"] > 0, "a perspective camera")
        else:
            need(c["xmag"] > 0 and c["ymag"] > 0 and c["znear"] >= 0, "an orthographic camera")
        need("zfar" not in c and kind == "perspective" or c["zfar"] > c["znear"], "depths")


def check_lights(root):
    for light in root.get("extensions", {}).get("KHR_lights_punctual", {}).get("lights", []):
        need(light["type"] in ("point", "spot", "directional"), "a kind of light")
        need(all(0 <= x <= 1 for x in light.get("color", [])), "a light's colour")
        need(light["intensity"] >= 0 and light.get("range", 1) > 0, "a light's numbers")
        spot = light.get("spot", {"innerConeAngle": 0, "outerConeAngle": 1})
        need(0 <= spot["innerConeAngle"] < spot["outerConeAngle"] <= math.pi / 2, "a cone")


def check_materials(root):
    for material in root.get("materials", []):
        pbr = material.get("pbrMetallicRoughness", {})
        numbers = pbr.get("baseColorFactor", []) + material.get("emissiveFactor", [])
        need(all(0 <= x <= 1 for x in numbers), "a factor")
        need(material.get("alphaMode", "OPAQUE") in ("OPAQUE", "MASK", "BLEND"), "alphaMode")


def walk(value, visit):
    visit(value)
    for item in value.values() if isinstance(value, dict) else value:
        if isinstance(item, (dict, list)):
            walk(item, visit)


def check_whole(root):
    used = set()

    def visit(value):
        if isinstance(value, dict):
            used.update(value.get("extensions", {}))
            for key in ("baseColorTexture", "metallicRoughnessTexture", "normalTexture",
                        "occlusionTexture", "emissiveTexture"):
                if key in value:
                    need(value[key]["index"] < len(root["textures"]), key)
        need(len(value) > 0 or value is not root, "nothing")
        if isinstance(value, list):
            need(value, "an empty list")

    walk(root, visit)
    need(used == set(root.get("extensionsUsed", [])), f"extensionsUsed: {used}")
    need(root["asset"]["version"] == "2.0", "asset")


def main():
    with open(sys.argv[1], "rb") as file:
        root, binary = read_container(file.read())
    check_whole(root)
    check_views(root, binary)
    check_nodes(root)
    check_cameras(root)
    check_lights(root)
    check_materials(root)
    primitives = [p for mesh in root.get("meshes", []) for p in mesh["primitives"]]
    for primitive in {p["indices"]: p for p in primitives}.values():
        check_primitive(root, binary, primitive)
    need(len(set(map(json.dumps, root.get("meshes", [])))) == len(root.get("meshes", [])), "twins")
    for primitive in primitives:
        need(primitive.get("material", 0) < len(root.get("materials", [0])), "a material")
    for texture in root.get("textures", []):
        need(texture["source"] < len(root["images"]), "a texture's image")
        need(texture.get("sampler", 0) < len(root.get("samplers", [0])), "a texture's sampler")
    for image in root.get("images", []):
        check_png(root, binary, image)


main()
