#!/usr/bin/env python3
"""What a picture's file says of itself: notes.py FILE prints a line `key value` for each note.

PNG's text chunks and OpenEXR's attributes, read with nothing but Python's struct and zlib.
"""
import struct
import sys
import zlib


def png_notes(data):
    at = 8
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at : at + 8])
        body = data[at + 8 : at + 8 + size]
        (crc,) = struct.unpack(">I", data[at + 8 + size : at + 12 + size])
        assert crc == zlib.crc32(kind + body), kind
        if kind == b"tEXt":
            key, text = body.split(b"\0")
            yield key.decode("latin-1"), text.decode("latin-1")
        at += size + 12


def exr_notes(data):
    at = 8
    while data[at]:
        key, kind = data[at:].split(b"\0", 2)[:2]
        at += len(key) + len(kind) + 2
        (size,) = struct.unpack("<I", data[at : at + 4])
        body = data[at + 4 : at + 4 + size]
        at += 4 + size
        if kind == b"string":
            yield key.decode(), body.decode()
        elif kind == b"float":
            yield key.decode(), "%.9g" % struct.unpack("<f", body)


data = open(sys.argv[1], "rb").read()
for key, value in (png_notes if data[:4] == b"\x89PNG" else exr_notes)(data):
    print(key, value)
