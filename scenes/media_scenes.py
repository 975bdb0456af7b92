"""Builds scenes with scattering media: fog in a room, tea, wax."""

import math

from gltf_builder import Gltf, normalized, rotation_towards, sub
from materials import glass
from shapes import box_quads, filleted, flipped, inner_quads, lathe, quads, sphere


# --- A beam in fog --------------------------------------------------------------------------------------------------

WINDOW = (1.75, 2.35, 1.7, 2.3)  # in the left wall: y, then z [m]


def left_wall(x, height, depth):
    """Returns four strips around the window, which face inwards, and the cross in it."""
    bottom, top, near, far = WINDOW
    strips = [((x, y0, z0), (x, y1, z0), (x, y1, z1), (x, y0, z1)) for y0, y1, z0, z1 in (
        (0, bottom, 0, depth), (top, height, 0, depth), (bottom, top, 0, near), (bottom, top, far, depth))]
    middle_y, middle_z = (bottom + top) / 2, (near + far) / 2
    bars = [*box_quads((x - 0.02, bottom, middle_z - 0.02), (x + 0.02, top, middle_z + 0.02)),
            *box_quads((x - 0.015, middle_y - 0.02, near), (x + 0.015, middle_y + 0.02, far))]
    return strips + bars


def searchlight(gltf, position, direction):
    """Adds a lamp at `position` in the focus of a parabolic mirror, whose rim is level with the focus: all light of the
    lamp hits the mirror and leaves as a beam. Everywhere else only the black back of the lamp is visible."""
    focus, segments = 0.17, 64
    # The mirror is y = r^2 / (4 focus) - focus, with normals on the inside.
    outline = [(r, r * r / (4 * focus) - focus, *normalized((-r / (2 * focus), 1.0)))
               for r in (2 * focus * k / 24 for k in range(25))]
    positions, triangles, normals = lathe(outline, segments)
    upright = [[(x, -z, y) for x, y, z in vectors] for vectors in (positions, normals)]
    dish = gltf.shape(upright[0], triangles, upright[1])
    turn = rotation_towards(tuple(-c for c in direction))
    gltf.node("dish", position, turn, mesh=gltf.mesh("dish", (
        dish, gltf.material("brushed silver", (0.96, 0.95, 0.92), metallic=1, roughness=0.25))))
    lamp = gltf.lambertian("lamp", (0.1, 0.1, 0.1), emission=(10000, 8500, 6500))
    half = 0.04
    plate = gltf.shape(*quads(((-half, half, 0), (half, half, 0), (half, -half, 0), (-half, -half, 0))))
    gltf.node("lamp", position, turn, mesh=gltf.mesh("lamp", (plate, lamp)))


def fog_beam(title):
    """Builds a closed room of 4 x 3 x 5 m. A searchlight outside shines through a window of 0.6 x 0.6 m; its beam is
    visible only in fog (--fog)."""
    gltf = Gltf(title)
    white, blue, clay = (gltf.lambertian(name, color) for name, color in (
        ("white", (0.55, 0.55, 0.53)), ("blue", (0.2, 0.28, 0.45)), ("clay", (0.6, 0.35, 0.22))))
    low, high = (-2, 0, 0), (2, 3, 5)
    for name, material, shape in (("floor, ceiling and ends", white, inner_quads(low, high, "-y+y-z+z")),
                                  ("left wall", white, left_wall(low[0], high[1], high[2])),
                                  ("right wall", blue, inner_quads(low, high, "+x")),
                                  ("pedestal", white, box_quads((0.25, 0, 1.65), (0.75, 0.6, 2.15), "-x+x+y-z+z"))):
        gltf.node(name, mesh=gltf.mesh(name, (gltf.shape(*quads(*shape)), material)))
    ball = gltf.mesh("ball", (gltf.shape(*sphere(48, 24, radius=0.25)), clay))
    gltf.node("ball", (0.5, 0.86, 1.9), mesh=ball)
    target, lamp = (0.6, 0.7, 1.95), (-2.9, 2.5, 2.02)
    searchlight(gltf, lamp, normalized(sub(target, lamp)))
    gltf.camera((0.6, 1.35, 4.9), (-0.24, 0, -1), math.radians(50), 4 / 3)
    return gltf


# --- A table at night -----------------------------------------------------------------------------------------------

def table(title, lamp=None):
    """Builds a table top and a wall behind it; objects of about 0.1 m stand near the origin. `lamp` is (centre, side
    [m], radiance) of a square that emits towards the origin."""
    gltf = Gltf(title)
    for name, color, corners in (
            ("table", (0.5, 0.42, 0.34), ((-0.6, 0, 0.6), (0.6, 0, 0.6), (0.6, 0, -0.3), (-0.6, 0, -0.3))),
            ("wall", (0.45, 0.48, 0.5), ((-0.6, 0, -0.3), (0.6, 0, -0.3), (0.6, 0.6, -0.3), (-0.6, 0.6, -0.3)))):
        gltf.node(name, mesh=gltf.mesh(name, (gltf.shape(*quads(corners)), gltf.lambertian(name, color))))
    if lamp:
        centre, side, radiance = lamp
        half = side / 2
        plate = gltf.shape(*quads(((-half, -half, 0), (-half, half, 0), (half, half, 0), (half, -half, 0))))
        shine = gltf.lambertian("lamp", (0.7, 0.7, 0.7), emission=radiance)
        gltf.node("lamp", centre, rotation_towards(tuple(-c for c in centre)),
                  mesh=gltf.mesh("lamp", (plate, shine)))
    return gltf


def body(ior, attenuation, scattered, anisotropy=0.0):
    """Returns the extensions of a body's medium: `attenuation` is (remaining colour of white light, after which
    distance [m]), `scattered` the multiple-scattering albedo."""
    color, distance = attenuation
    return {"ior": {"ior": ior},
            "volume": {"thicknessFactor": 0.1, "attenuationColor": list(color), "attenuationDistance": distance},
            "volume_scatter": {"multiscatterColor": list(scattered), "scatterAnisotropy": anisotropy}}


def tea_glass(title):
    """Lets the tea share faces with its glass, which it wets."""
    gltf = table(title, lamp=((-0.35, 0.5, -0.12), 0.14, (420, 390, 340)))
    bottom, level, rim = 0.012, 0.075, 0.1
    at_level = 0.032 + (level - bottom) / (rim - bottom) * (0.038 - 0.032)
    tumbler = filleted([(0, bottom, 0), (0.032, bottom, 0.008), (at_level, level, 0), (0.038, rim, 0.0008),
                        (0.041, rim, 0.0008), (0.036, 0, 0.003), (0, 0, 0)])
    tea = filleted([(0, level, 0), (at_level, level, 0), (0.032, bottom, 0.008), (0, bottom, 0)])
    liquid = gltf.material("tea", (1, 1, 1), roughness=0, extensions={
        "transmission": {"transmissionFactor": 1},
        **body(1.33, ((0.78, 0.33, 0.08), 0.03), (0.4, 0.18, 0.06), 0.6)})
    place = (0, 0.001, 0)  # a millimetre above the table, like all specular objects here
    gltf.node("tumbler", place, mesh=gltf.mesh("tumbler", (gltf.shape(*lathe(tumbler, 64)), glass(gltf, "glass"))))
    gltf.node("tea", place, mesh=gltf.mesh("tea", (gltf.shape(*lathe(tea, 64)), liquid)))
    eye = (0.03, 0.17, 0.44)
    gltf.camera(eye, sub((0.015, 0.04, 0), eye), math.radians(24), 4 / 3)
    return gltf


def candle(title):
    """Builds a candle; the flame is the only light."""
    gltf = table(title)
    wax = gltf.material("wax", (1, 1, 1), roughness=0.5, extensions={
        "diffuse_transmission": {"diffuseTransmissionFactor": 0.9, "diffuseTransmissionColorFactor": [1, 1, 1]},
        **body(1.45, ((0.45, 0.35, 0.2), 0.008), (0.92, 0.78, 0.5))})
    height = 0.11
    stick = filleted([(0, height - 0.006, 0), (0.024, height - 0.004, 0.008), (0.03, height, 0.0025),
                      (0.036, height, 0.003), (0.036, 0, 0.002), (0, 0, 0)])
    gltf.node("candle", (0, 0.001, 0), mesh=gltf.mesh("candle", (gltf.shape(*lathe(stick, 64)), wax)))
    wick = filleted([(0, 0.012, 0), (0.0009, 0.012, 0.0003), (0.0009, 0, 0.0003), (0, 0, 0)])
    gltf.node("wick", (0, height - 0.0045, 0), mesh=gltf.mesh("wick", (
        gltf.shape(*lathe(wick, 12)), gltf.lambertian("wick", (0.03, 0.025, 0.02)))))
    # Makes a drop: round below, a point above.
    angles = [math.pi * k / 20 for k in range(21)]
    drop = [(0.0062 * math.sin(a) * (1 - 0.55 * math.sin(a / 2) ** 2) if 0 < k < 20 else 0.0, -0.014 * math.cos(a)
             * (1.35 if a > math.pi / 2 else 1)) for k, a in enumerate(angles)]
    outline = []
    for k, (r, y) in enumerate(drop):
        before, after = drop[max(k - 1, 0)], drop[min(k + 1, 20)]
        normal = (0.0, -1.0) if k == 0 else (0.0, 1.0) if k == 20 else normalized((after[1] - before[1], before[0] - after[0]))
        outline.append((r, y, *normal))
    outline.reverse()  # runs from top to bottom, as lathe() expects
    flame = gltf.lambertian("flame", (0, 0, 0), emission=(9000, 4900, 1500))
    gltf.node("flame", (0, height + 0.024, 0), mesh=gltf.mesh("flame", (gltf.shape(*lathe(outline, 24)), flame)))
    gltf.node("ball", (0.1, 0.0305, 0.03), mesh=gltf.mesh("ball", (
        gltf.shape(*sphere(40, 20, radius=0.03)), gltf.lambertian("clay", (0.6, 0.35, 0.22)))))
    eye = (0.05, 0.2, 0.5)
    gltf.camera(eye, sub((0.025, 0.066, 0), eye), math.radians(24), 4 / 3)
    return gltf


MEDIA_SCENES = {"fog-beam": fog_beam, "tea-glass": tea_glass, "candle": candle}
