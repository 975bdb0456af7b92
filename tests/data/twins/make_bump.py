#!/usr/bin/env python3
"""Writes bump.glb, from which the sparse twin beside it was made: make_bump.py FILE.

It is a sheet of 15 x 15 vertices with a morph target that lifts those in the middle: most of the target's values are
zero. A lamp lights it.
"""

import json
import math
import struct
import sys

SIDE = 15


def vertices():
    positions, normals, lifts, turns = [], [], [], []
    for row in range(SIDE):
        for column in range(SIDE):
            x, z = 2 * column / (SIDE - 1) - 1, 2 * row / (SIDE - 1) - 1
            positions += [x, 0, z]
            normals += [0, 1, 0]
            square = (x * x + z * z) / 0.25
            inside = square < 1
            lifts += [0, 0.4 * (1 - square) ** 2 if inside else 0, 0]
            slope = 6.4 * (1 - square) if inside else 0
            length = math.sqrt(1 + slope * slope * (x * x + z * z))
            turns += [slope * x / length, 1 / length - 1, slope * z / length]
    return positions, normals, lifts, turns


def triangles():
    indices = []
    for row in range(SIDE - 1):
        for column in range(SIDE - 1):
            a = row * SIDE + column
            indices += [a, a + SIDE, a + 1, a + 1, a + SIDE, a + SIDE + 1]
    return indices


def main():
    positions, normals, lifts, turns = vertices()
    indices = triangles()
    columns = [struct.pack(f"<{len(values)}f", *values) for values in (positions, normals, lifts, turns)]
    columns.append(struct.pack(f"<{len(indices)}H", *indices))
    views, offset = [], 0
    for column in columns:
        views.append({"buffer": 0, "byteOffset": offset, "byteLength": len(column)})
        offset += len(column)
    vectors = [{"bufferView": i, "componentType": 5126, "count": SIDE * SIDE, "type": "VEC3"} for i in range(4)]
    for accessor, values in ((vectors[0], positions), (vectors[2], lifts)):
        accessor["min"], accessor["max"] = ([pick(values[axis::3]) for axis in range(3)] for pick in (min, max))
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0, 1, 2]}],
        "nodes": [
            {"mesh": 0},
            {"camera": 0, "translation": [0, 1.6, 2.4], "rotation": [-0.2873479, 0, 0, 0.9578263]},
            {"translation": [1, 2, 0.5], "extensions": {"KHR_lights_punctual": {"light": 0}}},
        ],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.01}}],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 10}]}},
        "meshes": [{"weights": [1.0], "primitives": [{
            "attributes": {"POSITION": 0, "NORMAL": 1}, "targets": [{"POSITION": 2, "NORMAL": 3}], "indices": 4,
            "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.4}}],
        "accessors": vectors + [{"bufferView": 4, "componentType": 5123, "count": len(indices), "type": "SCALAR"}],
        "bufferViews": views,
        "buffers": [{"byteLength": offset}],
    }
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    binary = b"".join(columns)
    binary += b"\0" * (-len(binary) % 4)
    with open(sys.argv[1], "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary)))
        file.write(struct.pack("<I4s", len(text), b"JSON") + text)
        file.write(struct.pack("<I4s", len(binary), b"BIN\0") + binary)


if __name__ == "__main__":
    main()
