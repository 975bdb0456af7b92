#!/usr/bin/env python3
"""Writes wave.glb, from which the compressed twins beside it were made: make_wave.py FILE.

It is a waving sheet of 13 x 9 vertices with normals, texture coordinates and vertex colours, which turns and grows in
an animation of one second.
"""

import json
import math
import struct
import sys

COLUMNS, ROWS = 13, 9


def vertices():
    positions, normals, coordinates, colors = [], [], [], []
    for row in range(ROWS):
        for column in range(COLUMNS):
            u, v = column / (COLUMNS - 1), row / (ROWS - 1)
            x, z = 3 * u - 1, 2 * v - 1
            y = 0.2 * math.sin(4 * x) * math.cos(3 * z)
            dx, dz = 0.8 * math.cos(4 * x) * math.cos(3 * z), -0.6 * math.sin(4 * x) * math.sin(3 * z)
            length = math.sqrt(dx * dx + 1 + dz * dz)
            positions += [x, y, z]
            normals += [-dx / length, 1 / length, -dz / length]
            coordinates += [u, v]
            colors += [round(255 * u), round(255 * v), 128, 255]
    return positions, normals, coordinates, colors


def triangles():
    indices = []
    for row in range(ROWS - 1):
        for column in range(COLUMNS - 1):
            a = row * COLUMNS + column
            b, c, d = a + 1, a + COLUMNS, a + COLUMNS + 1
            indices += [a, c, b, b, c, d]
    return indices


class Document:
    def __init__(self):
        self.bytes = b""
        self.views, self.accessors = [], []

    def add(self, code, component, kind, width, values, **more):
        data = struct.pack(f"<{len(values)}{code}", *values)
        self.views.append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)})
        self.bytes += data + b"\0" * (-len(data) % 4)
        self.accessors.append({"bufferView": len(self.views) - 1, "componentType": component, "type": kind,
                               "count": len(values) // width, **more})
        return len(self.accessors) - 1


def main():
    document = Document()
    positions, normals, coordinates, colors = vertices()
    limits = {"min": [min(positions[i::3]) for i in range(3)], "max": [max(positions[i::3]) for i in range(3)]}
    attributes = {"POSITION": document.add("f", 5126, "VEC3", 3, positions, **limits),
                  "NORMAL": document.add("f", 5126, "VEC3", 3, normals),
                  "TEXCOORD_0": document.add("f", 5126, "VEC2", 2, coordinates),
                  "COLOR_0": document.add("B", 5121, "VEC4", 4, colors, normalized=True)}
    indices = document.add("H", 5123, "SCALAR", 1, triangles())
    keys = 17
    times = [i / (keys - 1) for i in range(keys)]
    turns = [x for t in times for x in (0, math.sin(t), 0, math.cos(t))]
    sizes = [x for t in times for x in (1 + t, 1 + t * t, 1)]
    time = document.add("f", 5126, "SCALAR", 1, times, min=[0], max=[1])
    samplers = [{"input": time, "output": document.add("f", 5126, "VEC4", 4, turns)},
                {"input": time, "output": document.add("f", 5126, "VEC3", 3, sizes)}]
    channels = [{"sampler": 0, "target": {"node": 0, "path": "rotation"}},
                {"sampler": 1, "target": {"node": 0, "path": "scale"}}]
    text = json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": attributes, "indices": indices}]}],
        "animations": [{"channels": channels, "samplers": samplers}],
        "accessors": document.accessors, "bufferViews": document.views,
        "buffers": [{"byteLength": len(document.bytes)}]}).encode()
    text += b" " * (-len(text) % 4)
    size = 12 + 8 + len(text) + 8 + len(document.bytes)
    with open(sys.argv[1], "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, size) + struct.pack("<I4s", len(text), b"JSON") + text +
                   struct.pack("<I4s", len(document.bytes), b"BIN\0") + document.bytes)


if __name__ == "__main__":
    main()
