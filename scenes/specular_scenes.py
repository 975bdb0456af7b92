"""Builds scenes of mirrors and glass: caustics, and rooms full of specular objects."""

import math

from gltf_builder import Gltf, normalized, rotation_about, sub
from materials import glass, mirror
from shapes import box_quads, filleted, inner_quads, lathe, quads, ring, sphere

SILVER, GOLD, COPPER = (0.96, 0.95, 0.92), (1, 0.77, 0.34), (0.95, 0.64, 0.54)


# --- Caustics on a table --------------------------------------------------------------------------------------------

def table(title, lamp_position):
    """Builds a table top and a wall behind it, under a lamp 3 cm wide; objects of about 0.1 m stand near the origin."""
    gltf = Gltf(title)
    for name, color, corners in (
            ("table", (0.55, 0.5, 0.45), ((-0.8, 0, 0.8), (0.8, 0, 0.8), (0.8, 0, -0.4), (-0.8, 0, -0.4))),
            ("wall", (0.3, 0.35, 0.4), ((-0.8, 0, -0.4), (0.8, 0, -0.4), (0.8, 0.8, -0.4), (-0.8, 0.8, -0.4)))):
        gltf.node(name, mesh=gltf.mesh(name, (gltf.shape(*quads(corners)), gltf.lambertian(name, color))))
    gltf.sphere_light("lamp", 40, 0.015, lamp_position, (1, 0.93, 0.82))
    eye = (0, 0.45, 0.6)
    gltf.camera(eye, sub((-0.02, 0.02, 0), eye), math.radians(28), 4 / 3)
    return gltf


def caustic_glass(title):
    gltf = table(title, (0.45, 0.5, -0.25))
    clear = glass(gltf, "glass")
    # The outline runs from the middle of the inside up, over the rim and down to the middle of the foot.
    tumbler = filleted([(0, 0.014, 0), (0.034, 0.014, 0.008), (0.038, 0.1, 0.0008), (0.041, 0.1, 0.0008),
                        (0.038, 0, 0.003), (0, 0, 0)])
    # Specular objects hover a millimetre above the table: connections near a contact would have infinite variance.
    gltf.node("tumbler", (-0.05, 0.001, -0.02), mesh=gltf.mesh("tumbler", (gltf.shape(*lathe(tumbler, 72)), clear)))
    gltf.node("ball", (0.09, 0.036, 0.06), mesh=gltf.mesh("ball", (gltf.shape(*sphere(48, 24, radius=0.035)), clear)))
    return gltf


def caustic_metal(title):
    gltf = table(title, (0.4, 0.32, 0.3))
    gold = mirror(gltf, "gold", GOLD)
    brushed = gltf.material("brushed copper", COPPER, metallic=1, roughness=0.25)
    large = gltf.shape(*ring(0.077, 0.08, 0.03, 0.001, 96))
    small = gltf.shape(*ring(0.043, 0.046, 0.02, 0.001, 64))
    gltf.node("gold ring", (-0.06, 0.001, -0.02), mesh=gltf.mesh("gold ring", (large, gold)))
    gltf.node("copper ring", (0.11, 0.001, 0.06), mesh=gltf.mesh("copper ring", (small, brushed)))
    return gltf


# --- Rooms full of mirrors and glass ---------------------------------------------------------------------------------

def specular_room(title, low, high, lamp_radiance, focus=None):
    """Builds a white room with an ochre and a blue wall, a ceiling lamp of 0.8 x 0.8 m and a camera at its front. A
    lens of 16 cm diameter is focused on the point `focus`."""
    gltf = Gltf(title)
    parts = [(gltf.shape(*quads(*inner_quads(low, high, sides))), gltf.lambertian(name, color))
             for name, color, sides in (("white", (0.75, 0.75, 0.75), "-y+y-z+z"), ("ochre", (0.65, 0.45, 0.2), "-x"),
                                        ("blue", (0.2, 0.3, 0.6), "+x"))]
    gltf.node("room", mesh=gltf.mesh("room", *parts))
    lamp = gltf.lambertian("lamp", (0.7, 0.7, 0.7), emission=lamp_radiance)
    corners = ((-0.4, 0, -0.4), (0.4, 0, -0.4), (0.4, 0, 0.4), (-0.4, 0, 0.4))
    gltf.node("lamp", ((low[0] + high[0]) / 2, high[1] - 0.01, (low[2] + high[2]) / 2),
              mesh=gltf.mesh("lamp", (gltf.shape(*quads(corners)), lamp)))
    eye, forward = (0, 1.5, high[2] - 0.05), normalized((0, -0.28, -1))
    lens = (0.08, sum(a * b for a, b in zip(sub(focus, eye), forward))) if focus else None
    gltf.camera(eye, forward, math.radians(41), 4 / 3, lens=lens)
    return gltf


def specular_palette(gltf):
    """Returns mirrors of five colours and glass of five."""
    mirrors = [mirror(gltf, f"{name} mirror", color) for name, color in (
        ("silver", SILVER), ("gold", GOLD), ("copper", COPPER), ("green", (0.45, 0.9, 0.5)),
        ("blue", (0.4, 0.55, 0.95)))]
    glasses = [glass(gltf, "clear glass")] + [glass(gltf, f"{name} glass", (color, 0.3)) for name, color in (
        ("red", (0.9, 0.15, 0.12)), ("amber", (0.95, 0.55, 0.1)), ("green", (0.15, 0.8, 0.3)),
        ("blue", (0.15, 0.35, 0.9)))]
    return mirrors, glasses


def fourteen_specular(title):
    gltf = specular_room(title, (-2, 0, -2.4), (2, 2.6, 3.5), (24, 22, 19))
    mirrors, glasses = specular_palette(gltf)
    ball = gltf.shape(*sphere(48, 24))
    cube = gltf.shape(*quads(*box_quads((-1, -1, -1), (1, 1, 1))))
    # Each row has shape, material, place of the centre on the floor, half the height, rotation in degrees.
    objects = ((ball, mirrors[0], -1.2, -1.5, 0.5, 0), (cube, mirrors[1], 0.1, -1.7, 0.4, 30),
               (ball, mirrors[2], 1.3, -1.4, 0.45, 0), (cube, glasses[4], -0.5, -0.8, 0.28, 20),
               (ball, glasses[1], 0.55, -0.7, 0.3, 0), (cube, mirrors[3], 1.35, -0.3, 0.27, -25),
               (ball, mirrors[4], -1.4, -0.3, 0.3, 0), (ball, glasses[0], -0.7, 0.05, 0.3, 0),
               (cube, glasses[2], 0.15, 0.0, 0.2, 40), (ball, mirrors[1], 0.8, 0.15, 0.22, 0),
               (cube, mirrors[0], -1.15, 0.65, 0.17, 15), (ball, glasses[3], -0.4, 0.75, 0.18, 0),
               (ball, mirrors[2], 0.25, 0.7, 0.15, 0), (cube, glasses[0], 0.8, 0.75, 0.16, 35))
    for i, (shape, material, x, z, half, turn) in enumerate(objects):
        name = f"{'ball' if shape is ball else 'block'} {i + 1}"
        gltf.node(name, (x, half + 0.002, z), rotation_about((0, 1, 0), turn), (half,) * 3,
                  mesh=gltf.mesh(name, (shape, material)))
    return gltf


def nine_spheres_dof(title):
    """Builds twelve specular objects (nine spheres, a mirror, a block and a ring), two diffuse ones (the room and a
    pedestal) and a lamp. The fifth sphere is in focus."""
    places = [(-0.7 + 0.2 * i, 0.202, 1.3 - 0.5 * i) for i in range(9)]
    gltf = specular_room(title, (-2, 0, -3.4), (2, 2.6, 3.5), (26, 24, 21), focus=places[4])
    mirrors, glasses = specular_palette(gltf)
    ball = gltf.shape(*sphere(48, 24, radius=0.2))
    for i, place in enumerate(places):
        material = mirrors[i // 2] if i % 2 == 0 else glasses[i // 2]
        gltf.node(f"ball {i + 1}", place, mesh=gltf.mesh(f"ball {i + 1}", (ball, material)))
    panel = gltf.shape(*quads(*box_quads((-0.02, 0, -0.7), (0.02, 1.1, 0.7))))
    gltf.node("mirror", (-1.5, 0.02, -1.7), rotation_about((0, 1, 0), -20),
              mesh=gltf.mesh("mirror", (panel, mirrors[0])))
    pedestal = gltf.shape(*quads(*box_quads((-0.25, 0, -0.25), (0.25, 0.4, 0.25), "-x+x+y-z+z")))
    gltf.node("pedestal", (-0.75, 0, -0.9), mesh=gltf.mesh("pedestal", (
        pedestal, gltf.lambertian("pedestal", (0.5, 0.25, 0.2)))))
    block = gltf.shape(*quads(*box_quads((-0.15, 0, -0.15), (0.15, 0.3, 0.15))))
    gltf.node("glass block", (-0.75, 0.402, -0.9), rotation_about((0, 1, 0), 30),
              mesh=gltf.mesh("glass block", (block, glasses[4])))
    gltf.node("gold ring", (0.7, 0.002, 0.9), mesh=gltf.mesh("gold ring", (
        gltf.shape(*ring(0.2, 0.24, 0.12, 0.01, 64)), mirrors[1])))
    return gltf


SPECULAR_SCENES = {
    "caustic-glass": caustic_glass,
    "caustic-metal": caustic_metal,
    "fourteen-specular": fourteen_specular,
    "nine-spheres-dof": nine_spheres_dof,
}
