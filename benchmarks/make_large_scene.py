#!/usr/bin/env python3
"""Writes a scene of many triangles for the benchmarks: make_large_scene.py FILE.glb [--triangles 1000000].

The scene is a bumpy sphere in a white room with a lamp under the ceiling; nearly all triangles are the sphere's. It has
positions, normals and texture coordinates, like scanned models. The file is a pure function of the number of triangles.
"""

import argparse
import array
import json
import math
import struct
import sys


def radius(theta, phi):
    """Returns the radius of the sphere in a direction. Bumps of several sizes avoid regular patterns for rays."""
    return (0.6 + 0.05 * math.sin(7 * theta + 1) * math.sin(5 * phi) + 0.02 * math.sin(31 * phi + 3 * theta)
            * math.sin(29 * theta) + 0.008 * math.sin(97 * theta + 11 * phi) * math.sin(89 * phi))


def ball(rings, segments):
    """Returns positions, normals, texture coordinates and indices of the sphere. Seams have duplicate vertices."""

    def find_row(ring):
        theta = math.pi * ring / rings
        row = []
        for i in range(segments + 1):
            phi = 2 * math.pi * (i % segments) / segments
            r = radius(theta, phi)
            row.append((r * math.sin(theta) * math.sin(phi), r * math.cos(theta), r * math.sin(theta) * math.cos(phi)))
        return row

    positions, normals, uvs = array.array("f"), array.array("f"), array.array("f")
    row = find_row(0)
    above, below = row, find_row(1)
    for ring in range(rings + 1):
        for i, p in enumerate(row):
            a, b = row[(i + 1) % segments], row[(i - 1) % segments]
            e = (a[0] - b[0], a[1] - b[1], a[2] - b[2])
            f = (below[i][0] - above[i][0], below[i][1] - above[i][1], below[i][2] - above[i][2])
            n = (f[1] * e[2] - f[2] * e[1], f[2] * e[0] - f[0] * e[2], f[0] * e[1] - f[1] * e[0])
            length = math.sqrt(n[0] ** 2 + n[1] ** 2 + n[2] ** 2)
            if length < 1e-12:  # a pole
                n, length = p, math.sqrt(p[0] ** 2 + p[1] ** 2 + p[2] ** 2)
            positions.extend(p)
            normals.extend((n[0] / length, n[1] / length, n[2] / length))
            uvs.extend((i / segments, ring / rings))
        above, row = row, below
        below = find_row(ring + 2) if ring + 2 <= rings else row
    indices = array.array("I")
    for ring in range(rings):
        for i in range(segments):
            a = ring * (segments + 1) + i
            b = a + segments + 1
            if ring > 0:
                indices.extend((a, b, a + 1))
            if ring + 1 < rings:
                indices.extend((a + 1, b, b + 1))
    return {"POSITION": positions, "NORMAL": normals, "TEXCOORD_0": uvs}, indices


def quads(corners):
    """Returns the same arrays for quadrilaterals, whose corners run counter-clockwise seen from the front, with face
    normals."""
    positions, indices = array.array("f"), array.array("I")
    for n, quad in enumerate(corners):
        for corner in quad:
            positions.extend(corner)
        indices.extend((4 * n, 4 * n + 1, 4 * n + 2, 4 * n, 4 * n + 2, 4 * n + 3))
    return {"POSITION": positions}, indices


WALLS = [((-1, -1, 1), (1, -1, 1), (1, -1, -1), (-1, -1, -1)), ((-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1)),
         ((-1, -1, 1), (-1, -1, -1), (-1, 1, -1), (-1, 1, 1)), ((1, -1, -1), (1, -1, 1), (1, 1, 1), (1, 1, -1)),
         ((-1, 1, -1), (1, 1, -1), (1, 1, 1), (-1, 1, 1))]
LAMP = [((-0.3, 0.99, -0.3), (0.3, 0.99, -0.3), (0.3, 0.99, 0.3), (-0.3, 0.99, 0.3))]


class Glb:
    """Collects meshes and writes them as a binary glTF file."""

    def __init__(self):
        self.data = bytearray()
        self.json = {"asset": {"version": "2.0", "generator": "bdpt benchmarks/make_large_scene.py"}, "scene": 0,
                     "scenes": [{"nodes": [0]}],
                     "nodes": [{"camera": 0, "translation": [0, 0, 3.4]}],
                     "cameras": [{"type": "perspective",
                                  "perspective": {"yfov": 0.75, "znear": 0.01, "aspectRatio": 1}}],
                     "materials": [], "meshes": [], "accessors": [], "bufferViews": []}

    def accessor(self, values, width, kind):
        """Adds elements of `width` numbers each, of the component type `kind`."""
        if sys.byteorder == "big":
            values.byteswap()
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.data),
                                         "byteLength": len(values) * values.itemsize})
        self.data += values.tobytes()
        self.json["accessors"].append({"bufferView": len(self.json["bufferViews"]) - 1, "componentType": kind,
                                       "count": len(values) // width,
                                       "type": {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}[width]})
        return len(self.json["accessors"]) - 1

    def add(self, mesh, material):
        attributes, indices = mesh
        x, y, z = (attributes["POSITION"][i::3] for i in range(3))
        bounds = {"min": [min(x), min(y), min(z)], "max": [max(x), max(y), max(z)]}
        numbers = {name: self.accessor(values, 2 if name.startswith("TEX") else 3, 5126)
                   for name, values in attributes.items()}
        self.json["accessors"][numbers["POSITION"]].update(bounds)
        self.json["materials"].append(material)
        self.json["meshes"].append({"primitives": [{"attributes": numbers, "indices": self.accessor(indices, 1, 5125),
                                                    "material": len(self.json["materials"]) - 1}]})
        self.json["nodes"].append({"mesh": len(self.json["meshes"]) - 1})
        self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]) - 1)

    def write(self, path):
        self.data += bytes(-len(self.data) % 4)
        self.json["buffers"] = [{"byteLength": len(self.data)}]
        text = json.dumps(self.json, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        with open(path, "wb") as file:
            file.write(struct.pack("<4sII", b"glTF", 2, 12 + 8 + len(text) + 8 + len(self.data)))
            file.write(struct.pack("<I4s", len(text), b"JSON") + text)
            file.write(struct.pack("<I4s", len(self.data), b"BIN\0") + self.data)


def write(path, triangles):
    """Writes a scene of about that many triangles; returns the exact number."""
    rings = max(2, math.ceil(math.sqrt(triangles / 4) + 0.5))
    white = {"pbrMetallicRoughness": {"baseColorFactor": [0.7, 0.7, 0.7, 1], "metallicFactor": 0}}
    glb = Glb()
    glb.add(ball(rings, 2 * rings), white)
    glb.add(quads(WALLS), white)
    glb.add(quads(LAMP), {**white, "emissiveFactor": [1, 1, 1],
                          "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 12}}})
    glb.json["extensionsUsed"] = ["KHR_materials_emissive_strength"]
    glb.write(path)
    return 2 * len(WALLS + LAMP) + 4 * rings * (rings - 1)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("file")
    parser.add_argument("--triangles", type=int, default=1000000, help="about as many")
    arguments = parser.parse_args()
    print(f"{arguments.file}: {write(arguments.file, arguments.triangles)} triangles")


if __name__ == "__main__":
    main()
