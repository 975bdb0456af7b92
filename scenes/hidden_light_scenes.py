"""Builds rooms whose lamp lights nothing visible directly, which is hard for unidirectional path tracing."""

import math

from gltf_builder import Gltf, rotation_about
from materials import glass, mirror
from shapes import box_quads, filleted, flipped, inner_quads, lathe, quads, sphere


def lamp_box(title):
    """Builds a room of 4 x 3 x 5 m. The lamp lies on the bottom of a box under the ceiling and emits upwards; all light
    leaves the box by a hole of 0.3 x 0.3 m in that bottom, after at least one bounce inside."""
    gltf = Gltf(title)
    white, red, blue, grey = (gltf.lambertian(name, color) for name, color in (
        ("white", (0.8, 0.8, 0.8)), ("red", (0.6, 0.2, 0.15)), ("blue", (0.2, 0.3, 0.6)), ("grey", (0.5, 0.5, 0.5))))
    low, high = (-2, 0, 0), (2, 3, 5)
    # The box is 1.2 x 0.5 x 1.2 m: four sides, and four strips around the hole.
    bottom, near, far, hole = 2.5, 0.6, -0.6, 0.15
    centre = (0, 0, 1.9)
    sides = inner_quads((far, bottom, far), (near, 3, near), "-x+x-z+z")
    strips = [(far, far, near, -hole), (far, hole, near, near), (far, -hole, -hole, hole), (hole, -hole, near, hole)]
    sides += [((x0, bottom, z0), (x0, bottom, z1), (x1, bottom, z1), (x1, bottom, z0)) for x0, z0, x1, z1 in strips]
    for name, material, shape, place in (
            ("floor, ceiling and ends", white, inner_quads(low, high, "-y+y-z+z"), None),
            ("left wall", red, inner_quads(low, high, "-x"), None),
            ("right wall", blue, inner_quads(low, high, "+x"), None),
            ("lamp box", grey, [flipped(q) for q in box_quads((far - 0.01, bottom - 0.01, far - 0.01),
                                                              (near + 0.01, 3, near + 0.01), "-x+x-z+z")], centre),
            ("lamp box inside", white, sides, centre),
            ("block", white, box_quads((-0.4, 0, -0.3), (0.4, 0.9, 0.3), "-x+x+y-z+z"), (-0.7, 0, 1.3))):
        turn = rotation_about((0, 1, 0), 20) if name == "block" else None
        gltf.node(name, place, turn, mesh=gltf.mesh(name, (gltf.shape(*quads(*shape)), material)))
    ball = gltf.mesh("ball", (gltf.shape(*sphere(48, 24, radius=0.4)), white))
    gltf.node("ball", (0.75, 0.42, 1.9), mesh=ball)
    lamp = gltf.lambertian("lamp", (0.7, 0.7, 0.7), emission=(8000, 6800, 5200))
    corners = ((0.2, 0, 0.15), (0.35, 0, 0.15), (0.35, 0, -0.15), (0.2, 0, -0.15))
    gltf.node("lamp", (0, bottom + 0.02, 1.9), mesh=gltf.mesh("lamp", (gltf.shape(*quads(corners)), lamp)))
    gltf.camera((0, 1.5, 4.9), (0, -0.02, -1), math.radians(54), 4 / 3)
    return gltf


def vase(gltf):
    """Returns a solid vase 0.32 m high."""
    outline = filleted([(0, 0.32, 0), (0.05, 0.32, 0.008), (0.035, 0.25, 0.06), (0.12, 0.12, 0.08), (0.06, 0, 0.008),
                        (0, 0, 0)], steps=8)
    return gltf.shape(*lathe(outline, 48))


def door_ajar(title):
    """Builds two rooms of 4 x 2.7 m with a door between them. The lamp of the far room lights its ceiling and is
    invisible from the near room, where the camera is."""
    gltf = Gltf(title)
    white, green, wood, brown = (gltf.lambertian(name, color) for name, color in (
        ("white", (0.78, 0.76, 0.72)), ("green", (0.3, 0.45, 0.3)), ("wood", (0.45, 0.28, 0.15)),
        ("brown", (0.35, 0.22, 0.13))))
    low, high, left, right, top, thickness = (-2, 0, -3.1), (2, 2.7, 4), -0.1, 0.8, 2.1, 0.1
    wall = [*box_quads((low[0], 0, -thickness), (left, 2.7, 0), "+x-z+z"),
            *box_quads((right, 0, -thickness), (high[0], 2.7, 0), "-x-z+z"),
            *box_quads((left, top, -thickness), (right, 2.7, 0), "-y-z+z")]
    # The table's top is a block; its legs stand well inside its edges.
    table = box_quads((-0.55, 0.7, -0.35), (0.55, 0.74, 0.35))
    for x in (-0.5, 0.45):
        for z in (-0.3, 0.25):
            table += box_quads((x, 0, z), (x + 0.05, 0.7, z + 0.05), "-x+x-z+z")
    for name, material, shape in (("walls and ceiling", white, inner_quads(low, high, "-x+x+y-z+z") + wall),
                                  ("floor", brown, inner_quads(low, high, "-y"))):
        gltf.node(name, mesh=gltf.mesh(name, (gltf.shape(*quads(*shape)), material)))
    gltf.node("table", (-1.0, 0, 1.2), mesh=gltf.mesh("table", (gltf.shape(*quads(*table)), wood)))
    # The origin of the door is its hinge at the right jamb.
    door = box_quads((-0.88, 0.01, -0.02), (0, top - 0.01, 0.02))
    gltf.node("door", (right, 0, 0.03), rotation_about((0, 1, 0), 22),
              mesh=gltf.mesh("door", (gltf.shape(*quads(*door)), green)))
    lamp = gltf.lambertian("lamp", (0.7, 0.7, 0.7), emission=(900, 800, 640))
    corners = ((-0.3, 0, -0.3), (-0.3, 0, 0.3), (0.3, 0, 0.3), (0.3, 0, -0.3))
    gltf.node("lamp", (1.2, 1.9, -2.2), mesh=gltf.mesh("lamp", (gltf.shape(*quads(corners)), lamp)))
    body = vase(gltf)
    for i, (name, material) in enumerate((("clay", gltf.lambertian("clay", (0.7, 0.4, 0.25))),
                                          ("glass", glass(gltf, "glass")),
                                          ("silver", mirror(gltf, "silver", (0.96, 0.95, 0.92))))):
        gltf.node(f"{name} vase", (-1.33 + 0.33 * i, 0.741, 1.25), mesh=gltf.mesh(f"{name} vase", (body, material)))
    gltf.camera((-0.25, 1.45, 3.9), (-0.08, -0.1, -1), math.radians(45), 4 / 3)
    return gltf


HIDDEN_LIGHT_SCENES = {"lamp-box": lamp_box, "door-ajar": door_ajar}
