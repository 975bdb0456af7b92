"""Builds scenes that show one feature each: many lights on glossy surfaces, a textured lamp, parallel projection,
transparency."""

import math

from gltf_builder import Gltf, normalized, rotation_about, rotation_towards
from materials import mirror
from png import png
from shapes import box_quads, card, inner_quads, quads, sphere


def facing(direction):
    """Returns the rotation that turns +z to `direction`."""
    return rotation_towards(tuple(-d for d in direction))


# --- Veach's plates -------------------------------------------------------------------------------------------------
# The scene follows figure 9.2 of Eric Veach's thesis (1997): spheres of equal power and growing size above plates of
# growing roughness. The radii 0.2, 0.75, 2 and 3 are taken as decimetres.

PLATE_ROUGHNESS = (0.07, 0.16, 0.28, 0.45, 0.75)  # alpha is the square: 0.005 to 0.56


def veach_plates(title):
    gltf = Gltf(title)
    matt = gltf.lambertian("matt", (0.4, 0.4, 0.4))
    gltf.node("floor and wall", mesh=gltf.mesh("floor and wall", (gltf.shape(*quads(
        ((-4, 0, 4), (4, 0, 4), (4, 0, -1.5), (-4, 0, -1.5)),
        ((-4, 0, -1.5), (4, 0, -1.5), (4, 4, -1.5), (-4, 4, -1.5)))), matt)))
    eye, row = (0, 2.3, 5.6), (1.9, -0.7)  # the lamps: y, z
    for x, radius, tint in ((-1.1, 0.02, (1, 0.6, 0.5)), (-0.55, 0.075, (1, 0.9, 0.5)), (0.05, 0.2, (0.55, 1, 0.6)),
                            (0.85, 0.3, (0.6, 0.75, 1))):
        luminance = sum(w * c for w, c in zip((0.2126, 0.7152, 0.0722), tint))
        gltf.sphere_light(f"lamp of radius {radius} m", 20, radius, (x, *row),
                          tuple(0.65 * c / luminance for c in tint))
    plate = gltf.shape(*quads(*box_quads((-1.4, -0.33, -0.02), (1.4, 0.33, 0))))
    places = ((0.98, -0.1), (0.66, 0.45), (0.4, 1), (0.22, 1.55), (0.12, 2.1))  # y, z
    for i, (roughness, (y, z)) in enumerate(zip(PLATE_ROUGHNESS, places)):
        # Each plate's normal is the half vector between the camera and the row of lamps.
        to_eye, to_lamps = normalized((0, eye[1] - y, eye[2] - z)), normalized((0, row[0] - y, row[1] - z))
        normal = tuple(a + b for a, b in zip(to_eye, to_lamps))
        metal = gltf.material(f"metal of roughness {roughness}", (0.7, 0.7, 0.72), metallic=1, roughness=roughness)
        gltf.node(f"plate {i + 1}", (0, y, z), facing(normal),
                  mesh=gltf.mesh(f"plate {i + 1}", (plate, metal)))
    gltf.camera(eye, (0, -0.31, -1), math.radians(37), 4 / 3)
    return gltf


# --- A screen that lights a room --------------------------------------------------------------------------------------

def landscape(x, y):
    """Returns the colour of a picture of the sun over the sea."""
    distance = math.sqrt(x * x + (y - 0.15) * (y - 0.15))
    if y < -0.25:
        glitter = max(0.0, 1 - 6 * abs(x)) * (0.6 if int(30 * (y + 1)) % 2 else 0.25)
        return (0.05 + glitter, 0.12 + 0.7 * glitter, 0.3 + 0.1 * y + 0.3 * glitter)
    if distance < 0.3:
        return (1, 0.93, 0.6)
    glow = 0.3 / distance
    return (0.1 + 0.85 * glow, 0.25 + 0.4 * glow, 0.6 - 0.4 * glow)


def textured_emitter(title):
    gltf = Gltf(title)
    low, high = (-2, 0, -2), (2, 2.5, 2.6)
    walls = gltf.lambertian("walls", (0.7, 0.7, 0.7))
    floor = gltf.material("varnished floor", (0.35, 0.3, 0.25), roughness=0.3)
    gltf.node("walls", mesh=gltf.mesh("walls", (gltf.shape(*quads(*inner_quads(low, high, "-x+x+y-z+z"))), walls)))
    gltf.node("floor", mesh=gltf.mesh("floor", (gltf.shape(*quads(*inner_quads(low, high, "-y"))), floor)))
    image = gltf.texture("landscape", png(128, 64, landscape))
    screen = gltf.lambertian("screen", (0.02, 0.02, 0.02), emission=(300, 300, 300), emission_texture=image)
    gltf.node("screen", (0, 0.55, -1.9), mesh=gltf.mesh("screen", (gltf.shape(*card(2.6, 1.3)), screen)))
    ball = gltf.shape(*sphere(48, 24, radius=0.3))
    for name, x, z, material in (("white ball", -0.95, -0.6, gltf.lambertian("white", (0.8, 0.8, 0.8))),
                                 ("silver ball", 1.05, -0.45, mirror(gltf, "silver", (0.96, 0.95, 0.92)))):
        gltf.node(name, (x, 0.302, z), mesh=gltf.mesh(name, (ball, material)))
    gltf.camera((0.25, 1.25, 2.55), (-0.06, -0.1, -1), math.radians(48), 4 / 3)
    return gltf


# --- Parallel projection ----------------------------------------------------------------------------------------------

def orthographic(title):
    """Builds an isometric view of cubes of one size, steps and spheres: equal lengths along an axis look equal
    everywhere."""
    gltf = Gltf(title)
    floor, clay, teal, white = (gltf.lambertian(name, color) for name, color in (
        ("floor", (0.6, 0.58, 0.55)), ("clay", (0.65, 0.35, 0.25)), ("teal", (0.2, 0.45, 0.45)),
        ("white", (0.8, 0.8, 0.8))))
    ground = ((-2, 0, 2), (2, 0, 2), (2, 0, -2), (-2, 0, -2))
    behind = inner_quads((-2, 0, -2), (2, 1.5, 2), "-x-z")
    gltf.node("floor and walls", mesh=gltf.mesh("floor and walls", (gltf.shape(*quads(ground, *behind)), floor)))
    cube = gltf.mesh("cube", (gltf.shape(*quads(*box_quads((-0.2, 0, -0.2), (0.2, 0.4, 0.2), "-x+x+y-z+z"))), clay))
    for i in range(5):
        gltf.node(f"cube {i + 1}", (1.5, 0, 1.5 - 0.7 * i), mesh=cube)
    steps = []
    for i in range(5):
        steps += box_quads((-1.9, 0, -1.9 + 0.3 * i), (-0.7, 1.25 - 0.25 * i, -1.6 + 0.3 * i), "-x+x+y-z+z")
    gltf.node("steps", mesh=gltf.mesh("steps", (gltf.shape(*quads(*steps)), teal)))
    ball = gltf.shape(*sphere(48, 24, radius=0.35))
    for name, x, z, material in (("matt ball", 0.3, 0.6, white),
                                 ("mirror ball", 0.3, -0.9, mirror(gltf, "mirror"))):
        gltf.node(name, (x, 0.352, z), mesh=gltf.mesh(name, (ball, material)))
    gltf.sphere_light("lamp", 250, 0.25, (1.2, 5.8, 2.4), (1, 0.95, 0.88))
    gltf.orthographic_camera((5, 5.55, 5), (-1, -1, -1), 6.8, 5.1)
    return gltf


# --- Transparency -----------------------------------------------------------------------------------------------------

def leaf(x, y):
    """Returns the colour and alpha of an upright, pointed leaf with a vein; its surroundings are transparent."""
    half_width = 0.55 * (1 - y * y) * (1 - 0.35 * y)
    inside = abs(x) < half_width and abs(y) < 0.97
    vein = abs(x) < 0.04 or abs((y - 0.8 * abs(x)) * 3 % 1 - 0.5) < 0.06
    color = (0.45, 0.6, 0.25) if vein else (0.25, 0.5, 0.15)
    return (*color, 1.0 if inside or (abs(x) < 0.04 and y < 0) else 0.0)


def stained(x, y):
    """Returns the colour and alpha of half-transparent lozenges in an opaque frame."""
    if max(abs(x), abs(y)) > 0.92 or abs((abs(x) + abs(y)) * 2 % 1 - 0.5) > 0.46:
        return (0.2, 0.2, 0.2, 1)
    colors = ((0.95, 0.3, 0.2), (0.95, 0.8, 0.2), (0.3, 0.75, 0.4), (0.3, 0.45, 0.9))
    return (*colors[int((abs(x) + abs(y)) * 2 + 0.5) % 4], 0.6)


def alpha(title):
    gltf = Gltf(title)
    grey = gltf.lambertian("grey", (0.65, 0.65, 0.65))
    gltf.node("floor and wall", mesh=gltf.mesh("floor and wall", (gltf.shape(*quads(
        ((-3, 0, 2.5), (3, 0, 2.5), (3, 0, -1.6), (-3, 0, -1.6)),
        ((-3, 0, -1.6), (3, 0, -1.6), (3, 3, -1.6), (-3, 3, -1.6)))), grey)))
    cutout = gltf.lambertian("leaf", (1, 1, 1), texture=gltf.texture("leaf", png(64, 64, leaf)), double_sided=True,
                             alphaMode="MASK", alphaCutoff=0.5)
    leaf_mesh = gltf.mesh("leaf", (gltf.shape(*card(0.45, 0.45)), cutout))
    for i in range(24):
        row, column = divmod(i, 8)
        place = (-1.55 + 0.21 * column + 0.1 * (row % 2), 0.3 + 0.45 * row, -0.2 + 0.12 * (i * 5 % 4))
        axis = (0.3 * (i * 7 % 5 - 2), 0.4 * (i * 3 % 5 - 2), 1)
        gltf.node(f"leaf {i + 1}", place, rotation_about(axis, 35 * (i * 11 % 9 - 4)), mesh=leaf_mesh)
    window = gltf.lambertian("stained pane", (1, 1, 1), texture=gltf.texture("stained pane", png(64, 64, stained)),
                             double_sided=True, alphaMode="BLEND")
    gltf.node("stained pane", (0.45, 0.05, 0.1), rotation_about((0, 1, 0), -15),
              mesh=gltf.mesh("stained pane", (gltf.shape(*card(0.9, 1.2)), window)))
    pane = gltf.shape(*quads(((-0.2, 0, 0), (0.2, 0, 0), (0.2, 0.9, 0), (-0.2, 0.9, 0))))
    for i, opacity in enumerate((0.25, 0.5, 0.75)):
        name = f"pane of alpha {opacity}"
        tint = gltf.lambertian(name, (0.3, 0.55, 0.8), double_sided=True, alpha=opacity, alphaMode="BLEND")
        gltf.node(name, (1.1 + 0.28 * i, 0.05, 0.4 - 0.25 * i), mesh=gltf.mesh(name, (pane, tint)))
    gltf.sphere_light("lamp", 60, 0.06, (0.3, 2.4, 2.0), (1, 0.95, 0.85))
    gltf.camera((0, 1.2, 4.4), (0, -0.13, -1), math.radians(38), 4 / 3)
    return gltf


FEATURE_SCENES = {
    "veach-plates": veach_plates,
    "textured-emitter": textured_emitter,
    "orthographic": orthographic,
    "alpha": alpha,
}
