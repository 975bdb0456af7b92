#!/usr/bin/env python3
"""Writes a scene that is large in one respect: make_scale_scene.py KIND FILE.glb [--count N].

KIND is one of

  triangles   a bumpy sphere of about N triangles (10,000,000), as make_large_scene.py writes it
  instances   N small spheres (100,000) of one mesh, placed by EXT_mesh_gpu_instancing
  nodes       the same, each placed by a node of its own
  textures    N panels (1,000), each with an image of its own of 256 x 256 pixels
  panels      N emissive triangles (10,000), two a panel, in a hall of 100 rooms
  lamps       N point and spot lights (1,000) in the same hall

The file is a pure function of KIND and N.
"""

import argparse
import array
import math
import pathlib
import random
import sys
import zlib

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scenes"))
import make_large_scene
from make_large_scene import Glb, LAMP, WALLS, quads
from png import png_file

COUNTS = {"triangles": 10000000, "instances": 100000, "nodes": 100000, "textures": 1000, "panels": 10000, "lamps": 1000}
WHITE = {"pbrMetallicRoughness": {"baseColorFactor": [0.7, 0.7, 0.7, 1], "metallicFactor": 0}}


def lit(strength):
    return {**WHITE, "emissiveFactor": [1, 1, 1],
            "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": strength}}}


def unit_vector(rng):
    z, phi = 2 * rng.random() - 1, 2 * math.pi * rng.random()
    r = math.sqrt(1 - z * z)
    return (r * math.cos(phi), z, r * math.sin(phi))


def use(glb, *extensions):
    glb.json["extensionsUsed"] = sorted({*glb.json.get("extensionsUsed", []), *extensions})


def lit_room():
    glb = Glb()
    glb.add(quads(WALLS), WHITE)
    glb.add(quads(LAMP), lit(12))
    use(glb, "KHR_materials_emissive_strength")
    return glb


def balls(count, by_nodes):
    """Places spheres of 320 triangles each on a grid in the room."""
    glb = lit_room()
    mesh, indices = make_large_scene.ball(9, 18)
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
    if kind == "triangles":
        make_large_scene.write(path, count)
        return
    {"instances": lambda: balls(count, by_nodes=False), "nodes": lambda: balls(count, by_nodes=True),
     "textures": lambda: panels_with_images(count), "panels": lambda: panels(count),
     "lamps": lambda: lamps(count)}[kind]().write(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kind", choices=COUNTS)
    parser.add_argument("file")
    parser.add_argument("--count", type=int)
    arguments = parser.parse_args()
    write(arguments.kind, arguments.file, arguments.count or COUNTS[arguments.kind])


if __name__ == "__main__":
    main()
