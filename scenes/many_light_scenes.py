"""Builds scenes of many lights, which depend on the selection of lights."""

import math

from gltf_builder import Gltf, rotation_about
from shapes import box_quads, quads, sphere


def night_market(title):
    """Builds a lane of 6 x 26 m between stalls and a wall of 3 m, at night. 48 bulbs on strings and 8 lanterns are
    spheres of light, 8 lamps and 20 spots have no size, and the stalls have luminous signs. The brightest lights,
    panels that face away and spots, are behind the wall; they reach the lane only indirectly, over the wall."""
    gltf = Gltf(title)
    grey, wall, wood, cloth, iron, wet = (
        gltf.lambertian("paving", (0.4, 0.4, 0.42)), gltf.lambertian("plaster", (0.65, 0.6, 0.5)),
        gltf.lambertian("wood", (0.45, 0.3, 0.18)), gltf.lambertian("cloth", (0.6, 0.2, 0.15)),
        gltf.material("iron", (0.5, 0.5, 0.52), metallic=1, roughness=0.5),
        gltf.material("wet stone", (0.1, 0.1, 0.11), roughness=0.25))
    left, right, far, near = -3, 3, -24, 2

    def place(name, material, *shapes, at=None, turn=None):
        gltf.node(name, at, turn, mesh=gltf.mesh(name, (gltf.shape(*quads(*shapes)), material)))

    place("paving", grey, ((left, 0, near), (9, 0, near), (9, 0, far), (left, 0, far)))
    place("gutter", wet, ((-0.5, 0.005, near), (0.5, 0.005, near), (0.5, 0.005, far), (-0.5, 0.005, far)))
    place("wall", wall, *box_quads((right, 0, far), (right + 0.2, 3, near), "-x+x+y+z"))
    place("houses", wall, ((left, 0, near), (left, 0, far), (left, 5, far), (left, 5, near)),
          ((left, 0, far), (9, 0, far), (9, 5, far), (left, 5, far)))
    counter = gltf.mesh("counter", (gltf.shape(*quads(*box_quads((0, 0, -1), (0.8, 0.9, 1), "+x+y-z+z"))), wood))
    awning = gltf.mesh("awning", (gltf.shape(*quads(
        ((0, 2.7, 1.2), (1.4, 2.3, 1.2), (1.4, 2.3, -1.2), (0, 2.7, -1.2)))), cloth))
    goods = gltf.mesh("goods", (gltf.shape(*sphere(16, 8, radius=0.16)), iron))
    colors = ((1, 0.3, 0.15), (1, 0.75, 0.3), (0.4, 0.9, 0.5), (0.4, 0.6, 1))
    board = quads(((0, 0, 0.4), (0, 0, -0.4), (0, 0.25, -0.4), (0, 0.25, 0.4)))
    signs = [gltf.mesh(f"sign {i + 1}", (gltf.shape(*board), gltf.lambertian(
        f"sign {i + 1}", (0.3, 0.3, 0.3), emission=[12 * c for c in color]))) for i, color in enumerate(colors)]
    for i in range(8):
        z = 0.2 - 3 * i
        for mesh, height, x in ((counter, 0, left), (awning, 0, left), (goods, 1.07, left + 0.4)):
            gltf.node("stall", (x, height, z), mesh=mesh)
        gltf.node("sign", (left + 0.05, 3, z), mesh=signs[i % 4])
        gltf.light("counter lamp", "spot", 30, (1, 0.85, 0.6), (left + 0.7, 2.3, z), (0.05, -1, 0.1),
                   spot={"innerConeAngle": 0.5, "outerConeAngle": 0.9})
        gltf.sphere_light("lantern", 8, 0.12, (left + 1.5, 2.1, z + 1.2), colors[i % 4])
        gltf.light("wall lamp", "point", 6, (1, 0.8, 0.55), (right - 0.35, 2.2, z - 1.4))
    for i in range(6):
        for k in range(8):
            t = (k + 0.5) / 8
            gltf.sphere_light("bulb", 1.5, 0.04, (left + 6 * t, 3.6 - 0.8 * math.sin(math.pi * t), -1.5 - 3.6 * i),
                              colors[(i + k) % 4])
    bright = gltf.lambertian("bright panel", (0.3, 0.3, 0.3), emission=(400, 380, 350))
    panel = gltf.mesh("bright panel", (gltf.shape(*quads(((0, 0, 0.4), (0, 0, -0.4), (0, 0.8, -0.4), (0, 0.8, 0.4)))),
                                       bright))
    for i in range(12):
        gltf.node("panel behind the wall", (right + 0.25, 1.6, 1 - 2 * i), mesh=panel)
        gltf.light("spot behind the wall", "spot", 900, (0.9, 0.95, 1), (right + 2, 2.6, 0.2 - 2 * i), (0.4, -1, 0),
                   spot={"innerConeAngle": 0.3, "outerConeAngle": 0.6})
    crate = gltf.mesh("crate", (gltf.shape(*quads(*box_quads((-0.3, 0, -0.3), (0.3, 0.6, 0.3), "-x+x+y-z+z"))), wood))
    for x, z, angle in ((1.6, -2.2, 20), (2.2, -3.4, -10), (0.9, -7.5, 40), (1.9, -12, 15)):
        gltf.node("crate", (x, 0, z), rotation_about((0, 1, 0), angle), mesh=crate)
    gltf.camera((0.6, 1.65, 1.9), (-0.1, -0.09, -1), math.radians(52), 4 / 3)
    return gltf


MANY_LIGHT_SCENES = {
    "night-market": night_market,
}
