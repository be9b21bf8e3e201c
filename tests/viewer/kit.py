"""The viewer with its user's hands and eyes: for tests that run under tests/with_display.sh.

Nothing here waits for a time to pass where it can wait for something to happen.
"""

import base64
import json
import math
import mmap
import os
import re
import struct
import subprocess
import sys
import tempfile
import threading
import time
import zlib

PATIENCE_S = float(os.environ.get("ARGAND_TEST_PATIENCE", 120))  # of what comes within a second
argand = sys.argv[1]
here = tempfile.mkdtemp(prefix="argand-viewer-")


display = os.environ["ARGAND_TEST_DISPLAY"]
opened = []  # viewers, of the test that runs


class Failed(Exception):
    pass


def check(held, what):
    if not held:
        raise Failed(what)


def until(done, what, patience=PATIENCE_S):
    end = time.monotonic() + patience
    while True:
        result = done()
        if result:
            return result
        if time.monotonic() > end:
            raise Failed(f"in vain: {what}")
        time.sleep(0.02)


def xdotool(*words):
    done = subprocess.run(["xdotool", *map(str, words)], capture_output=True, text=True)
    return done.stdout.split()


def runs(folder):
    for task in os.listdir(folder):
        try:
            with open(f"{folder}/{task}/stat") as file:
                state = file.read().rsplit(")", 1)[1].split()[0]
        except OSError:  # it has ended
            continue
        if state not in "SI":
            return True
    return False


# ---- Pictures --------------------------------------------------------------------


class Picture:
    """Rows of RGB."""

    def __init__(self, width, height, rgb):
        self.width, self.height, self.rgb = width, height, bytes(rgb)

    def __eq__(self, other):
        return (self.width, self.height, self.rgb) == (other.width, other.height, other.rgb)

    def at(self, x, y):
        place = 3 * (int(y) * self.width + int(x))
        return tuple(self.rgb[place : place + 3])

    def middle(self):
        return self.at(self.width // 2, self.height // 2)

    def part(self, left, top, right, bottom):
        rows = [
            self.rgb[3 * (y * self.width + left) : 3 * (y * self.width + right)]
            for y in range(top, bottom)
        ]
        return Picture(right - left, bottom - top, b"".join(rows))

    def mean(self):
        return sum(self.rgb) / len(self.rgb)

    def apart(self, other):
        """The share of pixels that differ by more than 2 steps."""
        check((self.width, self.height) == (other.width, other.height), "sizes differ")
        count = 0
        for i in range(0, len(self.rgb), 3):
            a, b = self.rgb[i : i + 3], other.rgb[i : i + 3]
            count += a != b and max(abs(p - q) for p, q in zip(a, b)) > 2
        return 3 * count / len(self.rgb)

    def box(self, color):
        """Of the pixels of a colour: left, top, right, bottom; None: there are none."""
        found = [
            i for i in range(self.width * self.height)
            if self.at(i % self.width, i // self.width) == color
        ]
        if not found:
            return None
        x, y = [i % self.width for i in found], [i // self.width for i in found]
        return min(x), min(y), max(x) + 1, max(y) + 1


def read_png(path):
    """An RGBA or RGB PNG of 8 bits."""
    data = open(path, "rb").read()
    check(data[:8] == b"\x89PNG\r\n\x1a\n", f"{path} is no PNG")
    place, packed, head = 8, b"", None
    while place < len(data):
        length, kind = struct.unpack(">I4s", data[place : place + 8])
        body = data[place + 8 : place + 8 + length]
        head = struct.unpack(">IIBBBBB", body) if kind == b"IHDR" else head
        packed += body if kind == b"IDAT" else b""
        place += 12 + length
    width, height, size = head[0], head[1], {2: 3, 6: 4}[head[3]]
    raw, rows, before = zlib.decompress(packed), [], bytes(width * size)
    for y in range(height):
        kind, *row = raw[y * (width * size + 1) : (y + 1) * (width * size + 1)]
        for i in range(len(row)):
            a, c = (row[i - size], before[i - size]) if i >= size else (0, 0)
            b = before[i]
            p = a + b - c
            paeth = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
            row[i] = (row[i] + (0, a, b, (a + b) // 2, paeth)[kind]) & 255
        before = bytes(row)
        rows.append(b"".join(before[i : i + 3] for i in range(0, len(row), size)))
    return Picture(width, height, b"".join(rows))


def command(*words):
    """What argand(1) prints."""
    done = subprocess.run([argand, *map(str, words)], capture_output=True, text=True)
    check(done.returncode == 0, f"argand {words}: {done.stderr}")
    return done.stdout


def rendered(*options):
    path = os.path.join(here, "rendered.png")
    command("render", *options, "-o", path, "--quiet")
    return read_png(path)


# ---- The viewer ------------------------------------------------------------------


class Viewer:
    """`argand view`, with nothing written over the picture unless `words`."""

    def __init__(self, *options, size=(240, 160), words=False, preload=(), **environment):
        self.size, self.lines, self.out = size, [], ""
        env = dict(os.environ, **environment)
        # In the sanitized build leaks are found, too; those of the validation layer are its own.
        env["LD_PRELOAD"] = ":".join((*preload, os.environ["ARGAND_TEST_KEEP_LOADED"]))
        leaks = 0 if "--validate" in options else 1
        env["ASAN_OPTIONS"] = f"detect_leaks={leaks}:verify_asan_link_order=0"
        if not words:
            env["ARGAND_FONTS"] = "/nonexistent"
        look = ["--size", f"{size[0]}x{size[1]}", "--verbose"]
        self.process = subprocess.Popen(
            [argand, "view", *map(str, options), *look], env=env, cwd=here, text=True,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        )
        opened.append(self)
        self.hearing = threading.Thread(target=self._hear, daemon=True)
        self.hearing.start()

    def _hear(self):
        for line in self.process.stderr:
            self.lines.append(line.rstrip("\n"))

    def lives(self):
        check(self.process.poll() is None, f"it has ended with {self.process.returncode}")

    def ended(self):
        """The exit code, once it has ended by itself."""
        until(lambda: self.process.poll() is not None, "the end of the viewer")
        self.hearing.join()
        self.out = self.process.stdout.read()
        return self.process.returncode

    def window(self):
        """Its window, once it is there and has the keys."""
        def found():
            self.lives()
            ids = xdotool("search", "--onlyvisible", "--class", "argand")
            return ids and xdotool("getwindowfocus") == ids[:1] and ids[0]

        return until(found, "a window")

    # ---- What it says

    def mark(self):
        return len(self.lines)

    def said(self, pattern, since=0):
        """The last line since a mark that has the pattern: its match."""
        for line in reversed(self.lines[since:]):
            match = re.search(pattern, line)
            if match:
                return match
        return None

    def heard(self, pattern, since=0):
        return until(lambda: self.said(pattern, since), f"'{pattern}' is said")

    def camera(self):
        """Of the last picture at rest: where it is, where it looks, and how."""
        m = self.heard(r"shown: .* from (\S+) (\S+) (\S+) m to (\S+) (\S+) (\S+) m, (\w+)")
        eye, target = ([float(m[i + k]) for i in range(3)] for k in (1, 4))
        far = math.dist(eye, target)
        return eye, [(b - a) / far for a, b in zip(eye, target)], m[7]

    # ---- What it shows

    def picture(self, size=None):
        width, height = size or self.size
        with open(os.environ["ARGAND_TEST_SCREEN"], "rb") as file:
            with mmap.mmap(file.fileno(), 0, prot=mmap.PROT_READ) as data:
                head = struct.unpack(">25I", data[:100])
                first, line = head[0] + 12 * head[19], head[12]
                starts = range(first, first + height * line, line)
                rows = [data[start : start + 4 * width] for start in starts]
        rgb = bytearray(3 * width * height)
        raw = b"".join(rows)
        for c in range(3):
            rgb[c::3] = raw[2 - c :: 4]
        return Picture(width, height, rgb)

    def works(self):
        """Whether any thread runs, of it or of its display."""
        return any(runs(f"/proc/{pid}/task") for pid in (self.process.pid, display))

    def cpu_s(self):
        fields = open(f"/proc/{self.process.pid}/stat").read().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def rest(self):
        """Wait until it has nothing more to do; what it shows then."""
        quiet = 0
        def still():
            nonlocal quiet
            self.lives()
            quiet = 0 if self.works() else quiet + 1
            return quiet >= 13

        until(still, "rest")
        return self.picture()

    def shown(self):
        """Wait until there is a scene, and rest."""
        self.window()
        self.heard("shown: ")
        return self.rest()

    # ---- What its user does

    def point(self, x, y):
        xdotool("mousemove", x, y)

    def key(self, *names):
        """Press keys; what is shown at rest."""
        xdotool("key", *names)
        return self.rest()

    def says(self, pattern, *names):
        since = self.mark()
        xdotool("key", *names)
        return self.heard(pattern, since)

    def wheel(self, steps, *held):
        for name in held:
            xdotool("keydown", name)
        xdotool("click", "--repeat", abs(steps), "--delay", 20, 4 if steps > 0 else 5)
        for name in held:
            xdotool("keyup", name)
        return self.rest()

    def drag(self, x, y, to_x, to_y, button=1, held=(), waits=True):
        for name in held:
            xdotool("keydown", name)
        self.point(x, y)
        xdotool("mousedown", button)
        for i in range(1, 6):
            self.point(x + (to_x - x) * i // 5, y + (to_y - y) * i // 5)
            time.sleep(0.03)
        xdotool("mouseup", button)
        for name in held:
            xdotool("keyup", name)
        return self.rest() if waits else None

    def click(self, x, y):
        self.point(x, y)
        xdotool("click", 1)
        return self.rest()

    def close(self, code=0):
        xdotool("key", "ctrl+q")
        check(self.ended() == code, f"exit code {self.process.returncode}, not {code}")


# ---- Scenes ----------------------------------------------------------------------

# +X -X +Y -Y +Z -Z
RIGHT, LEFT, TOP, BOTTOM, FRONT, BACK = (
    (0, 255, 0), (0, 255, 255), (0, 0, 255), (255, 0, 255), (255, 0, 0), (255, 255, 0),
)
SIDES = (RIGHT, LEFT, TOP, BOTTOM, FRONT, BACK)
PLAIN = ("--env", "none", "--tonemap", "none", "--background", "#000000")


def cube(path, side=1.0, colors=SIDES, roughness=None):
    """A cube about the origin, each side of its own colour and seen as it is; with a roughness
    matte, white, and named.  Cameras before its front and its right side."""
    positions, indices = [], []
    for axis in range(3):
        for sign in (1, -1):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            first = len(positions)
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                p = [0, 0, 0]
                p[axis], p[u], p[v] = sign * side / 2, sign * a * side / 2, b * side / 2
                positions.append(p)
            indices += [first + i for i in (0, 1, 2, 0, 2, 3)]
    data = b"".join(struct.pack("<3f", *p) for p in positions)
    data += struct.pack(f"<{len(indices)}H", *indices)
    accessors = [{
        "bufferView": 0, "componentType": 5126, "count": 24, "type": "VEC3",
        "min": [-side / 2] * 3, "max": [side / 2] * 3,
    }]
    materials, primitives = [], []
    for i, color in enumerate(colors):
        accessors.append({
            "bufferView": 1, "byteOffset": 12 * i, "componentType": 5123, "count": 6,
            "type": "SCALAR",
        })
        material = {
            "name": f"side {i}",
            "pbrMetallicRoughness": {"baseColorFactor": [c / 255 for c in color] + [1]},
            "extensions": {"KHR_materials_unlit": {}},
        }
        if roughness is not None:
            material["pbrMetallicRoughness"] = {"roughnessFactor": roughness, "metallicFactor": 0}
            del material["extensions"]
        materials.append(material)
        primitives.append({"attributes": {"POSITION": 0}, "indices": 1 + i, "material": i})
    half = math.sqrt(0.5)
    camera = {"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.01}}
    gltf = {
        "asset": {"version": "2.0"},
        "extensionsUsed": ["KHR_materials_unlit"],
        "scene": 0,
        "scenes": [{"nodes": [0, 1, 2]}],
        "nodes": [
            {"mesh": 0},
            {"camera": 0, "name": "front", "translation": [0, 0, 3]},
            {
                "camera": 0, "name": "right", "translation": [3, 0, 0],
                "rotation": [0, half, 0, half],
            },
        ],
        "cameras": [camera],
        "meshes": [{"primitives": primitives}],
        "materials": materials,
        "accessors": accessors,
        "bufferViews": [
            {"buffer": 0, "byteLength": 288},
            {"buffer": 0, "byteOffset": 288, "byteLength": 72},
        ],
        "buffers": [{
            "byteLength": len(data),
            "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode(),
        }],
    }
    with open(path + ".new", "w") as file:
        json.dump(gltf, file)
    os.rename(path + ".new", path)
    return path


def large(path):
    """The white cube with a texture, as a large file: a draft of it is shown first.  Also the file
    that has to go before the rest is read, and what makes a viewer wait for that."""
    with open(cube(path, roughness=0.5)) as file:
        gltf = json.load(file)
    gltf["images"] = [{"uri": "white.png"}]
    gltf["textures"] = [{"source": 0}]
    gltf["materials"][4]["pbrMetallicRoughness"]["baseColorTexture"] = {"index": 0}
    with open(path, "w") as file:
        json.dump(gltf, file)
    folder = os.path.dirname(path)
    command("render", "demo:furnace", "--size", "8x8", "-o", os.path.join(folder, "white.png"))
    with open(os.path.join(folder, "large.bin"), "wb") as file:
        file.truncate(9 << 20)
    hold = os.path.join(folder, "hold")
    open(hold, "w").close()
    return path, hold, {
        "preload": (os.environ["ARGAND_TEST_HELD_FILES"],), "ARGAND_TEST_HOLD": hold,
    }


# ---- Running ---------------------------------------------------------------------


def run(*tests):
    """Run tests; all of them, so that one failure does not hide another."""
    failed = 0
    for test in tests:
        if len(sys.argv) > 2 and sys.argv[2] not in test.__name__:
            continue
        start = time.monotonic()
        try:
            test()
            verdict = "ok"
        except Exception as failure:
            failed += 1
            verdict = f"FAILED: {failure!r}"
            print("\n".join(line for viewer in opened for line in viewer.lines[-40:]))
        for viewer in opened:
            if viewer.process.poll() is None:
                viewer.process.kill()
            viewer.process.wait()
        opened.clear()
        print(f"{test.__name__}: {verdict} ({time.monotonic() - start:.1f} s)", flush=True)
    subprocess.run(["rm", "-rf", here])
    sys.exit(1 if failed else 0)
