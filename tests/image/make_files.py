#!/usr/bin/env python3
"""Make the image files that tests/image and the fuzzers begin with: make_files.py FOLDER

Nothing but Python's struct and zlib is used, so that the files stand apart from the code
under test and from the libraries that it calls.  Sample c of pixel (x, y) is
sample(x, y, c) below; tests/image/files.h says the same in C.
"""
import os
import struct
import sys
import zlib

WIDTH, HEIGHT = 9, 7


def sample(x, y, c, depth):
    return (x * 7919 + y * 10007 + c * 20011 + 1234) % 65536 >> (16 - depth)


# --- PNG ---------------------------------------------------------------------------------


def chunk(kind, data):
    body = kind + data
    return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))


def pack_row(samples, depth):
    if depth == 16:
        return b"".join(struct.pack(">H", s) for s in samples)
    bits, count, out = 0, 0, bytearray()
    for s in samples:
        bits, count = bits << depth | s, count + depth
        if count == 8:
            out.append(bits)
            bits = count = 0
    if count:
        out.append(bits << (8 - count))
    return bytes(out)


def paeth(a, b, c):
    p = a + b - c
    pa, pb, pc = abs(p - a), abs(p - b), abs(p - c)
    return a if pa <= pb and pa <= pc else b if pb <= pc else c


def filter_row(kind, row, above, bpp):
    out = bytearray([kind])
    for i, v in enumerate(row):
        a = row[i - bpp] if i >= bpp else 0
        b = above[i]
        c = above[i - bpp] if i >= bpp else 0
        out.append((v - [0, a, b, (a + b) // 2, paeth(a, b, c)][kind]) & 255)
    return bytes(out)


def png_pass(columns, rows, channels, depth):
    bpp = max(1, channels * depth // 8)
    data, above = b"", None
    for n, y in enumerate(rows):
        row = pack_row([sample(x, y, c, depth) for x in columns for c in range(channels)], depth)
        data += filter_row(n % 5, row, above or bytes(len(row)), bpp)
        above = row
    return data if columns else b""


ADAM7 = [(0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2),
         (0, 1, 1, 2)]


def png(color, depth, extra=b"", interlaced=False, width=WIDTH, height=HEIGHT):
    channels = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}[color]
    passes = ADAM7 if interlaced else [(0, 0, 1, 1)]
    data = b"".join(
        png_pass(range(x, width, dx), range(y, height, dy), channels, depth)
        for x, y, dx, dy in passes)
    header = struct.pack(">IIBBBBB", width, height, depth, color, 0, 0, int(interlaced))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + extra +
            chunk(b"IDAT", zlib.compress(data)) + chunk(b"IEND", b""))


def palette(depth):
    """Entry i is (i * 5, i * 11, 255 - i) of 8 bits, alpha i * 3, as far as tRNS goes."""
    count = 1 << depth
    entries = b"".join(bytes([i * 5 & 255, i * 11 & 255, 255 - i]) for i in range(count))
    return chunk(b"PLTE", entries) + chunk(b"tRNS", bytes(i * 3 & 255 for i in range(count // 2)))


def png_files():
    for color, name, depths in ((0, "gray", (1, 2, 4, 8, 16)), (2, "rgb", (8, 16)),
                                (4, "gray-alpha", (8, 16)), (6, "rgba", (8, 16))):
        for depth in depths:
            yield f"{name}-{depth}.png", png(color, depth)
    for depth in (1, 2, 4, 8):
        yield f"palette-{depth}.png", png(3, depth, palette(depth))
    yield "interlaced-rgb-8.png", png(2, 8, interlaced=True)
    yield "interlaced-gray-2.png", png(0, 2, interlaced=True)
    key = struct.pack(">H", sample(3, 2, 0, 16))
    yield "gray-16-key.png", png(0, 16, chunk(b"tRNS", key))
    key = struct.pack(">HHH", *[sample(3, 2, c, 8) for c in range(3)])
    yield "rgb-8-key.png", png(2, 8, chunk(b"tRNS", key))
    extras = (chunk(b"gAMA", struct.pack(">I", 100000)) +
              chunk(b"tEXt", b"Comment\0made by make_files.py") +
              chunk(b"pHYs", struct.pack(">IIB", 1000, 1000, 1)))
    yield "extra-chunks.png", png(6, 8, extras)
    # forged sizes: small data under a header of more
    header = struct.pack(">IIBBBBB", 1 << 20, 1 << 20, 8, 6, 0, 0, 0)
    yield "bad-huge.png", b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(
        b"IDAT", zlib.compress(bytes(100))) + chunk(b"IEND", b"")
    header = struct.pack(">IIBBBBB", 1 << 14, 1 << 14, 8, 6, 0, 0, 0)
    yield "bad-bomb.png", b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(
        b"IDAT", zlib.compress(bytes(100000))) + chunk(b"IEND", b"")


# --- JPEG: blocks of one colour, baseline ------------------------------------------------


def segment(marker, data):
    return struct.pack(">BBH", 0xFF, marker, len(data) + 2) + data


def jpeg(blocks, components, adobe=None, width=None):
    """`blocks`: for each 8 x 8 block the tuple of its components' values, -128 to 127."""
    out = b"\xff\xd8"
    if adobe is not None:
        out += segment(0xEE, b"Adobe" + struct.pack(">HHHB", 100, 0, 0, adobe))
    out += segment(0xDB, b"\0" + bytes([1] * 64))
    frame = struct.pack(">BHHB", 8, 8, width or 8 * len(blocks), components)
    out += segment(0xC0, frame + b"".join(bytes([i + 1, 0x11, 0]) for i in range(components)))
    # DC: the 12 lengths of differences, each a code of 4 bits; AC: 0 ends the block, of 1 bit
    out += segment(0xC4, b"\0" + bytes([0, 0, 0, 12] + [0] * 12) + bytes(range(12)))
    out += segment(0xC4, b"\x10" + bytes([1] + [0] * 15) + b"\0")
    scan = b"".join(bytes([i + 1, 0]) for i in range(components))
    out += segment(0xDA, bytes([components]) + scan + b"\0\x3f\0")
    bits, last = "", [0] * components
    for block in blocks:
        for c, value in enumerate(block):
            difference = 8 * value - last[c]  # the DC of a flat block is 8 times its value
            last[c] = 8 * value
            length = abs(difference).bit_length()
            code = difference if difference >= 0 else difference + (1 << length) - 1
            bits += format(length, "04b") + (format(code, f"0{length}b") if length else "") + "0"
    bits += "1" * (-len(bits) % 8)
    data = bytes(int(bits[i:i + 8], 2) for i in range(0, len(bits), 8))
    return out + data.replace(b"\xff", b"\xff\0") + b"\xff\xd9"


def jpeg_files():
    yield "gray.jpg", jpeg([(-128,), (-28,), (0,), (127,)], 1)
    yield "color.jpg", jpeg([(-20, 30, -40), (40, -50, 20), (-128, 0, 0)], 3)
    yield "rgb.jpg", jpeg([(-28, 72, 22), (100, -100, 0)], 3, adobe=0)
    yield "cmyk.jpg", jpeg([(72, -28, 22, 127), (0, 0, 0, 0)], 4, adobe=0)
    yield "part-block.jpg", jpeg([(10,), (20,)], 1, width=11)
    whole = jpeg([(-20, 30, -40)] * 3, 3)
    yield "bad-short.jpg", whole[:-6]
    at = whole.index(b"\xff\xc0") + 5
    yield "bad-huge.jpg", whole[:at] + b"\xff\xff\xff\xff" + whole[at + 4:]


# --- WebP, lossless, by the least of VP8L ------------------------------------------------


def vp8l(width, height, green, red, blue, alpha, pixels):
    """Two greens; `pixels`: 0 or 1 for each."""
    fields = [(0x2F, 8), (width - 1, 14), (height - 1, 14), (int(alpha != 255), 1), (0, 3)]
    fields += [(0, 1), (0, 1), (0, 1)]  # no transform, no colour cache, one set of codes
    fields += [(1, 1), (1, 1), (1, 1), (green[0], 8), (green[1], 8)]
    for value in (red, blue, alpha):
        fields += [(1, 1), (0, 1), (1, 1), (value, 8)]
    fields += [(1, 1), (0, 1), (0, 1), (0, 1)]  # no distances
    fields += [(p, 1) for p in pixels]
    value = shift = 0
    for v, bits in fields:
        value |= v << shift
        shift += bits
    data = value.to_bytes((shift + 7) // 8, "little")
    data += bytes(len(data) & 1)
    body = b"WEBP" + b"VP8L" + struct.pack("<I", (shift + 7) // 8) + data
    return b"RIFF" + struct.pack("<I", len(body)) + body


def webp_files():
    checks = [(x + y) & 1 for y in range(HEIGHT) for x in range(WIDTH)]
    yield "opaque.webp", vp8l(WIDTH, HEIGHT, (20, 200), 33, 77, 255, checks)
    yield "alpha.webp", vp8l(WIDTH, HEIGHT, (20, 200), 33, 77, 100, checks)
    yield "bad-short.webp", vp8l(WIDTH, HEIGHT, (20, 200), 33, 77, 255, checks)[:-4]
    yield "bad-huge.webp", vp8l(16384, 16384, (20, 200), 33, 77, 255, [])
    vp8x = struct.pack("<I", 2) + bytes([WIDTH - 1, 0, 0, HEIGHT - 1, 0, 0])
    anim = b"ANIM" + struct.pack("<IIH", 6, 0, 0)
    frame = vp8l(WIDTH, HEIGHT, (20, 200), 33, 77, 255, checks)[12:]
    anmf = bytes(6) + bytes([WIDTH - 1, 0, 0, HEIGHT - 1, 0, 0]) + bytes(4) + frame
    body = (b"WEBP" + b"VP8X" + struct.pack("<I", 10) + vp8x + anim + b"ANMF" +
            struct.pack("<I", len(anmf)) + anmf)
    yield "bad-animated.webp", b"RIFF" + struct.pack("<I", len(body)) + body


# --- Radiance ----------------------------------------------------------------------------


def rgbe(x, y):
    """Mantissas of 128 and more, an exponent about 128: sample() of 7 bits."""
    return bytes([128 + sample(x, y, c, 7) for c in range(3)] + [120 + sample(x, y, 3, 4)])


def hdr(body, resolution, lines=b""):
    return b"#?RADIANCE\n# made by hand\nFORMAT=32-bit_rle_rgbe\n" + lines + b"\n" + \
        resolution + b"\n" + body


def new_scanline(pixels):
    out = bytes([2, 2, len(pixels) >> 8, len(pixels) & 255])
    for c in range(4):
        plane = [p[c] for p in pixels]
        while plane:
            n = 1
            while n < min(127, len(plane)) and plane[n] == plane[0]:
                n += 1
            if n > 1:
                out += bytes([128 + n, plane[0]])
                plane = plane[n:]
            else:
                out += bytes([1, plane[0]])
                plane = plane[1:]
    return out


def hdr_files():
    size = b"-Y %d +X %d" % (HEIGHT, WIDTH)
    rows = [[rgbe(x, y) for x in range(WIDTH)] for y in range(HEIGHT)]
    yield "flat.hdr", hdr(b"".join(b"".join(r) for r in rows), size)
    yield "new.hdr", hdr(b"".join(new_scanline(r) for r in rows), size)
    old = b"".join(r[0] + bytes([1, 1, 1, WIDTH - 2]) + r[WIDTH - 1] for r in rows)
    yield "old.hdr", hdr(old, size)
    # 2 pixels, 300 more as 44 + 1 * 256, in a scanline of 302
    wide = rgbe(0, 0) + rgbe(1, 0) + bytes([1, 1, 1, 44, 1, 1, 1, 1])
    yield "old-long.hdr", hdr(wide, b"-Y 1 +X 302")
    yield "exposure.hdr", hdr(b"".join(b"".join(r) for r in rows), size,
                              b"EXPOSURE=4\nEXPOSURE= 0.5\nCOLORCORR=1 2 0.25\n")
    for y_sign in "+-":
        for x_sign in "+-":
            xs = range(WIDTH) if x_sign == "+" else range(WIDTH - 1, -1, -1)
            ys = range(HEIGHT) if y_sign == "-" else range(HEIGHT - 1, -1, -1)
            sizes = (f"{y_sign}Y {HEIGHT}", f"{x_sign}X {WIDTH}")
            name = ("up" if y_sign == "+" else "down") + "-" + (
                "right" if x_sign == "+" else "left")
            yield f"rows-{name}.hdr", hdr(b"".join(rows[y][x] for y in ys for x in xs),
                                          " ".join(sizes).encode())
            yield f"columns-{name}.hdr", hdr(b"".join(rows[y][x] for x in xs for y in ys),
                                             " ".join(reversed(sizes)).encode())
    yield "bad-huge.hdr", hdr(b"".join(b"".join(r) for r in rows), b"-Y 30000 +X 30000")
    yield "bad-run.hdr", hdr(bytes([2, 2, 0, 9, 137 + 1, 1]), b"-Y 1 +X 9")
    yield "bad-first-run.hdr", hdr(bytes([1, 1, 1, 9]) * 3, b"-Y 1 +X 9")
    yield "bad-xyze.hdr", hdr(b"", size).replace(b"rgbe", b"xyze")
    yield "bad-exposure.hdr", hdr(b"", size, b"EXPOSURE=-1\n")
    yield "bad-axes.hdr", hdr(b"", b"-Y 7 +Y 9")


# --- OpenEXR -----------------------------------------------------------------------------

UINT, HALF, FLOAT = 0, 1, 2


def attribute(name, kind, data):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(data)) + data


def exr_value(x, y, c, kind):
    """sample() / 65536 in steps of 1/256, exact as half; as an integer 0 to 255."""
    v = sample(x, y, c, 8)
    return struct.pack("<I", v) if kind == UINT else struct.pack("<e", v / 256) if kind == HALF \
        else struct.pack("<f", v / 256)


def zip_block(raw):
    """Even bytes, then odd ones; differences; deflate.  Raw where that is not smaller."""
    mixed = raw[0::2] + raw[1::2]
    out = bytearray(mixed[:1])
    for a, b in zip(mixed, mixed[1:]):
        out.append((b - a + 128) & 255)
    packed = zlib.compress(bytes(out))
    return packed if len(packed) < len(raw) else raw


def exr(channels, kinds, compression=0, origin=(0, 0), tile=None, sampling=1, flags=0,
        levels=0, names="RGBA", size=(WIDTH, HEIGHT)):
    """`channels`: their letters in the file's order; kinds: one a channel."""
    x0, y0 = origin
    width, height = size
    box = struct.pack("<iiii", x0, y0, x0 + width - 1, y0 + height - 1)
    listing = b"".join(
        c.encode() + b"\0" + struct.pack("<iBBBBii", k, 0, 0, 0, 0, sampling, sampling)
        for c, k in zip(channels, kinds)) + b"\0"
    head = struct.pack("<II", 20000630, 2 | flags | (0x200 if tile else 0))
    head += attribute("channels", "chlist", listing)
    head += attribute("compression", "compression", bytes([compression]))
    head += attribute("dataWindow", "box2i", box) + attribute("displayWindow", "box2i", box)
    head += attribute("lineOrder", "lineOrder", b"\0")
    head += attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    head += attribute("screenWindowCenter", "v2f", bytes(8))
    head += attribute("screenWindowWidth", "float", struct.pack("<f", 1))
    if tile:
        head += attribute("tiles", "tiledesc", struct.pack("<IIB", tile, tile, levels))
    head += b"\0"
    step = tile or {0: 1, 2: 1, 3: 16}[compression]
    blocks, w, h, level = [], width, height, 0
    while True:
        for y in range(0, h, step):
            ys = range(y, min(h, y + step))
            for x in range(0, w, tile or w):
                xs = range(x, min(w, x + (tile or w)))
                raw = b"".join(
                    exr_value(i, j, names.index(c) if c in names else 0, k)
                    for j in ys for c, k in zip(channels, kinds) for i in xs)
                data = zip_block(raw) if compression else raw
                where = (struct.pack("<iiii", x // tile, y // tile, level, level)
                         if tile else struct.pack("<i", y0 + y))
                blocks.append(where + struct.pack("<i", len(data)) + data)
        if not levels or (w == 1 and h == 1):
            break
        w, h, level = max(1, w // 2), max(1, h // 2), level + 1
    offset, table = len(head) + 8 * len(blocks), b""
    for block in blocks:
        table += struct.pack("<Q", offset)
        offset += len(block)
    return head + table + b"".join(blocks)


def exr_files():
    yield "float-rgba.exr", exr("ABGR", [FLOAT] * 4)
    yield "half-rgb.exr", exr("BGR", [HALF] * 3, origin=(-3, 5))
    yield "half-rgb-zip.exr", exr("BGR", [HALF] * 3, compression=3, origin=(-3, 5))
    yield "half-rgb-zips.exr", exr("BGR", [HALF] * 3, compression=2)
    yield "mixed.exr", exr("ABGRZ", [FLOAT, HALF, FLOAT, HALF, FLOAT])
    yield "luminance.exr", exr("Y", [HALF])
    yield "uint.exr", exr("BGR", [UINT] * 3)
    yield "tiles.exr", exr("BGR", [HALF] * 3, compression=3, tile=4, origin=(7, -2))
    yield "mip-tiles.exr", exr("BGR", [FLOAT] * 3, tile=4, levels=1)
    yield "bad-subsampled.exr", exr("BGR", [HALF] * 3, sampling=2)
    yield "bad-channels.exr", exr("Z", [FLOAT])
    yield "bad-chroma.exr", exr(["BY", "RY", "Y"], [HALF] * 3)
    yield "bad-dwaa.exr", exr("BGR", [HALF] * 3).replace(
        b"compression\0\x01\0\0\0\0", b"compression\0\x01\0\0\0\x08")
    yield "bad-huge.exr", exr("Y", [HALF]).replace(
        struct.pack("<iiii", 0, 0, WIDTH - 1, HEIGHT - 1), struct.pack("<iiii", 0, 0, 99999, 99999))


FOLDERS = {"png": png_files, "jpeg": jpeg_files, "webp": webp_files, "hdr": hdr_files,
           "exr": exr_files}


def main(root):
    for folder, files in FOLDERS.items():
        os.makedirs(os.path.join(root, folder), exist_ok=True)
        for name, data in files():
            with open(os.path.join(root, folder, name), "wb") as out:
                out.write(data)


if __name__ == "__main__":
    main(sys.argv[1])
