#!/usr/bin/env python3
"""Writes a scene that is large in one respect: make_scale_scene.py KIND FILE.glb [--count N].

KIND is one of

  triangles   a bumpy sphere of about N triangles (10,000,000) in a white room, with normals and texture coordinates
  instances   N small spheres (100,000) of one mesh, placed by EXT_mesh_gpu_instancing
  nodes       the same, each placed by a node of its own
  textures    N panels (1,000), each with an image of its own of 256 x 256 pixels
  panels      N emissive triangles (10,000), two a panel, in a hall of 100 rooms
  lamps       N point and spot lights (1,000) in the same hall

The file is a pure function of KIND and N.
"""

import argparse
import array
import json
import math
import pathlib
import random
import struct
import sys
import zlib

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scenes"))
from png import png_file

COUNTS = {"triangles": 10000000, "instances": 100000, "nodes": 100000, "textures": 1000, "panels": 10000, "lamps": 1000}
WHITE = {"pbrMetallicRoughness": {"baseColorFactor": [0.7, 0.7, 0.7, 1], "metallicFactor": 0}}


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
        self.json = {"asset": {"version": "2.0", "generator": "bdpt benchmarks/make_scale_scene.py"}, "scene": 0,
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


def lit(strength):
    return {**WHITE, "emissiveFactor": [1, 1, 1],
            "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": strength}}}


def unit_vector(rng):
    z, phi = 2 * rng.random() - 1, 2 * math.pi * rng.random()
    r = math.sqrt(1 - z * z)
    return (r * math.cos(phi), z, r * math.sin(phi))


def use(glb, *extensions):
    glb.json["extensionsUsed"] = sorted({*glb.json.get("extensionsUsed", []), *extensions})


def lit_room(*meshes):
    glb = Glb()
    for mesh in meshes:
        glb.add(mesh, WHITE)
    glb.add(quads(WALLS), WHITE)
    glb.add(quads(LAMP), lit(12))
    use(glb, "KHR_materials_emissive_strength")
    return glb


def large_ball(triangles):
    rings = max(2, math.ceil(math.sqrt(triangles / 4) + 0.5))
    return lit_room(ball(rings, 2 * rings))


def balls(count, by_nodes):
    """Places spheres of 320 triangles each on a grid in the room."""
    glb = lit_room()
    mesh, indices = ball(9, 18)
    glb.add((mesh, indices), WHITE)
    holder = glb.json["nodes"].pop()
    number = glb.json["scenes"][0]["nodes"].pop()
    side = math.ceil(count ** (1 / 3))
    rng = random.Random(1)
    places = []
    for i in range(count):
        cell = (i % side, i // side % side, i // side // side)
        places.append(([1.8 * (c + 0.5) / side - 0.9 for c in cell],
                       [x for v in (unit_vector(rng),) for x in (0.6 * v[0], 0.6 * v[1], 0.6 * v[2], 0.8)],
                       [0.6 / side] * 3))
    if by_nodes:
        for translation, rotation, scale in places:
            glb.json["nodes"].append({**holder, "translation": translation, "rotation": rotation, "scale": scale})
        glb.json["scenes"][0]["nodes"] += range(number, number + count)
        return glb
    attributes = {}
    for name, part, width in (("TRANSLATION", 0, 3), ("ROTATION", 1, 4), ("SCALE", 2, 3)):
        values = array.array("f", [x for place in places for x in place[part]])
        attributes[name] = glb.accessor(values, width, 5126)
    glb.json["nodes"].append({**holder, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": attributes}}})
    glb.json["scenes"][0]["nodes"].append(number)
    use(glb, "EXT_mesh_gpu_instancing")
    return glb


def png(size, rng):
    """Returns a PNG of colour gradients with a little noise, which compresses like photographs, not like drawings."""
    low, high = ([rng.randrange(256) for _ in range(3)] for _ in range(2))
    rows = bytearray()
    for y in range(size):
        t = y / size
        base = [a + (b - a) * t for a, b in zip(low, high)]
        noise = rng.randbytes(3 * size)
        rows += b"\0" + bytes(min(255, int(base[i % 3]) + (n & 7)) for i, n in enumerate(noise))

    return png_file(size, size, 2, zlib.compress(bytes(rows), 1))


def panels_with_images(count):
    glb = lit_room()
    rng = random.Random(2)
    side = math.ceil(math.sqrt(count))
    glb.json.update({"images": [], "textures": []})
    for i in range(count):
        x, y, h = 1.9 * (i % side + 0.5) / side - 0.95, 1.9 * (i // side + 0.5) / side - 0.95, 0.8 / side
        attributes, indices = quads([((x - h, y - h, -0.9), (x + h, y - h, -0.9), (x + h, y + h, -0.9),
                                      (x - h, y + h, -0.9))])
        attributes["TEXCOORD_0"] = array.array("f", (0, 1, 1, 1, 1, 0, 0, 0))
        data = png(256, rng)
        glb.json["bufferViews"].append({"buffer": 0, "byteOffset": len(glb.data), "byteLength": len(data)})
        glb.data += data + bytes(-len(data) % 4)
        glb.json["images"].append({"bufferView": len(glb.json["bufferViews"]) - 1, "mimeType": "image/png"})
        glb.json["textures"].append({"source": i})
        image = {"baseColorTexture": {"index": i}, "metallicFactor": 0}
        glb.add((attributes, indices), {"pbrMetallicRoughness": image})
    return glb


ROOM, ROOMS, HEIGHT = 4.0, 10, 3.0  # width of a room [m], rooms in a row, height [m]


def hall():
    """Builds ROOMS x ROOMS rooms without ceiling under a black sky; each wall has a door of a third of its width."""
    size, y = ROOM * ROOMS, HEIGHT
    corners = [((0, 0, size), (size, 0, size), (size, 0, 0), (0, 0, 0))]
    for i in range(ROOMS + 1):
        for k in range(ROOMS):
            at, begin = i * ROOM, k * ROOM
            # Outer walls have no doors.
            ends = ((0, 1),) if i in (0, ROOMS) else ((0, 1 / 3), (2 / 3, 1))
            for low, high in ends:
                a, b = begin + ROOM * low, begin + ROOM * high
                corners.append(((at, 0, a), (at, 0, b), (at, y, b), (at, y, a)))
                corners.append(((a, 0, at), (b, 0, at), (b, y, at), (a, y, at)))
    glb = Glb()
    glb.add(quads(corners), WHITE)
    middle = ROOM * (ROOMS // 2 + 0.5)
    # The camera looks from a corner of a central room through its doors into others.
    glb.json["nodes"][0] = {"camera": 0, "translation": [middle + 1.6, 1.7, middle + 1.6],
                            "rotation": [0, math.sin(math.pi / 8), 0, math.cos(math.pi / 8)]}
    glb.json["cameras"][0]["perspective"]["yfov"] = 1.1
    return glb


def place_in_hall(rng):
    """Returns a random position at least 0.4 m away from surfaces."""
    x, z = ((rng.randrange(ROOMS) * ROOM + 0.4 + (ROOM - 0.8) * rng.random()) for _ in range(2))
    return (x, 0.8 + (HEIGHT - 0.8) * rng.random(), z)


def panels(count):
    """Makes panels of 4 to 20 cm in random orientations; some are a hundred times as bright as others."""
    glb = hall()
    rng = random.Random(3)
    kinds = [[] for _ in range(4)]
    for i in range(count // 2):
        p, n = place_in_hall(rng), unit_vector(rng)
        other = unit_vector(rng)
        u = (n[1] * other[2] - n[2] * other[1], n[2] * other[0] - n[0] * other[2], n[0] * other[1] - n[1] * other[0])
        length = math.sqrt(sum(c * c for c in u))
        h = 0.02 + 0.08 * rng.random()
        u = [h * c / length for c in u]
        v = (n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2], n[0] * u[1] - n[1] * u[0])
        kinds[i % 4].append([tuple(c + a * d + b * e for c, d, e in zip(p, u, v))
                             for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))])
    for corners, strength in zip(kinds, (1, 4, 20, 100)):
        glb.add(quads(corners), lit(strength))
    use(glb, "KHR_materials_emissive_strength")
    return glb


def lamps(count):
    glb = hall()
    rng = random.Random(4)
    lights = []
    for i in range(count):
        axis = unit_vector(rng)
        half = math.acos(max(-1.0, min(1.0, -axis[2]))) / 2  # rotates -z to the axis
        length = math.hypot(axis[0], axis[1])
        s = math.sin(half) / length if length > 1e-6 else 0.0
        light = {"intensity": round(0.5 * 100 ** rng.random(), 3), "type": "point" if i % 2 else "spot"}
        if light["type"] == "spot":
            light["spot"] = {"innerConeAngle": 0.3, "outerConeAngle": 0.8}
        lights.append(light)
        glb.json["nodes"].append({"translation": place_in_hall(rng),
                                  "rotation": [axis[1] * s, -axis[0] * s, 0, math.cos(half)],
                                  "extensions": {"KHR_lights_punctual": {"light": i}}})
        glb.json["scenes"][0]["nodes"].append(len(glb.json["nodes"]) - 1)
    glb.json["extensions"] = {"KHR_lights_punctual": {"lights": lights}}
    use(glb, "KHR_lights_punctual")
    return glb


def write(kind, path, count):
    {"triangles": lambda: large_ball(count), "instances": lambda: balls(count, by_nodes=False),
     "nodes": lambda: balls(count, by_nodes=True), "textures": lambda: panels_with_images(count),
     "panels": lambda: panels(count), "lamps": lambda: lamps(count)}[kind]().write(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kind", choices=COUNTS)
    parser.add_argument("file")
    parser.add_argument("--count", type=int)
    arguments = parser.parse_args()
    write(arguments.kind, arguments.file, arguments.count or COUNTS[arguments.kind])


if __name__ == "__main__":
    main()
