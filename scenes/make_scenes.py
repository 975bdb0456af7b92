#!/usr/bin/env python3
"""Writes the classical scenes of this folder as glTF files: make_scenes.py [FOLDER]. README.md says what each is for.

Needs only Python 3. Every run writes the same bytes.
"""

import math
import pathlib
import sys

sys.dont_write_bytecode = True  # writes no files but the scenes

from feature_scenes import FEATURE_SCENES
from gltf_builder import Gltf, rotation_about, sub
from hidden_light_scenes import HIDDEN_LIGHT_SCENES
from layer_scenes import LAYER_SCENES
from many_light_scenes import MANY_LIGHT_SCENES
from materials import SOLID_GLASS, THIN_GLASS
from media_scenes import MEDIA_SCENES
from motion_scenes import MOTION_SCENES
from shapes import box_quads, coil, flipped, height_field, quads, sphere
from specular_scenes import SPECULAR_SCENES


# --- The Cornell box ------------------------------------------------------------------------------------------------
# Coordinates are those that the Program of Computer Graphics of Cornell University measured and published, in
# millimetres: +x points to the viewer's left, +y up, +z away from the viewer. The RGB reflectances are the usual Rec.
# 709 equivalents of the measured spectra.

FLOOR = ((552.8, 0, 0), (0, 0, 0), (0, 0, 559.2), (549.6, 0, 559.2))
CEILING = ((556, 548.8, 0), (556, 548.8, 559.2), (0, 548.8, 559.2), (0, 548.8, 0))
BACK = ((549.6, 0, 559.2), (0, 0, 559.2), (0, 548.8, 559.2), (556, 548.8, 559.2))
RIGHT = ((0, 0, 559.2), (0, 0, 0), (0, 548.8, 0), (0, 548.8, 559.2))
LEFT = ((552.8, 0, 0), (549.6, 0, 559.2), (556, 548.8, 559.2), (556, 548.8, 0))
SHORT_BLOCK = ((130, 65), (82, 225), (240, 272), (290, 114)), 165
TALL_BLOCK = ((423, 247), (265, 296), (314, 456), (472, 406)), 330
LAMP_CORNERS = ((343, 227), (343, 332), (213, 332), (213, 227))  # x, z; seen from below
LAMP_HEIGHT = 547.8  # 1 mm below the ceiling, so that it does not coincide with it
HIDDEN_LAMP_HEIGHT = 450.0

WHITE, RED, GREEN = (0.725, 0.71, 0.68), (0.63, 0.065, 0.05), (0.14, 0.45, 0.091)
LAMP_RADIANCE = (17, 12, 4)  # [nit]
LAMP_REFLECTANCE = 0.78


def metres(*millimetre_quads):
    return [tuple(tuple(c / 1000 for c in corner) for corner in quad) for quad in millimetre_quads]


def block(corners, height):
    """Returns the visible sides of a block that stands on the floor, from the corners of its base."""
    top = tuple((x, height, z) for x, z in corners)
    sides = [((*a[:1], 0, a[1]), (a[0], height, a[1]), (b[0], height, b[1]), (b[0], 0, b[1]))
             for a, b in zip(corners[1:] + corners[:1], corners)]
    return [top, *sides]


def cornell_room(title, hidden):
    """Builds the empty box with its lamp and camera. If `hidden`, the lamp hangs lower and lights the ceiling."""
    gltf = Gltf(title)
    white = gltf.lambertian("white", WHITE)
    for name, material, *sides in (("floor, ceiling and back wall", white, FLOOR, CEILING, BACK),
                                   ("left wall", gltf.lambertian("red", RED), LEFT),
                                   ("right wall", gltf.lambertian("green", GREEN), RIGHT)):
        gltf.node(name, mesh=gltf.mesh(name, (gltf.shape(*quads(*metres(*sides))), material)))
    height = HIDDEN_LAMP_HEIGHT if hidden else LAMP_HEIGHT
    lamp = tuple((x, height, z) for x, z in LAMP_CORNERS)
    lamp_material = gltf.lambertian("lamp", (LAMP_REFLECTANCE,) * 3, emission=LAMP_RADIANCE)
    shape = gltf.shape(*quads(*metres(flipped(lamp) if hidden else lamp)))
    gltf.node("lamp", mesh=gltf.mesh("lamp", (shape, lamp_material)))
    # The published camera has a film of 25 mm behind a lens of 35 mm.
    gltf.camera((0.278, 0.273, -0.8), (0, 0, 1), 2 * math.atan(0.025 / 2 / 0.035), 1)
    return gltf, white


def cornell_box(title, hidden=False):
    gltf, white = cornell_room(title, hidden)
    for name, (corners, height) in (("short block", SHORT_BLOCK), ("tall block", TALL_BLOCK)):
        shape = gltf.shape(*quads(*metres(*block(corners, height))))
        gltf.node(name, mesh=gltf.mesh(name, (shape, white)))
    return gltf


def cornell_spheres(title, hidden=False):
    gltf, _ = cornell_room(title, hidden)
    ball = gltf.shape(*sphere(64, 32, radius=0.1))
    mirror = gltf.material("mirror", (0.95, 0.95, 0.95), metallic=1, roughness=0)
    glass = gltf.material("glass", (1, 1, 1), roughness=0, extensions={
        **SOLID_GLASS, "volume": {"thicknessFactor": 0.2}})
    # Spheres hover a millimetre above the floor: connections near a point of contact would have infinite variance.
    gltf.node("mirror ball", (0.395, 0.101, 0.37), mesh=gltf.mesh("mirror ball", (ball, mirror)))
    gltf.node("glass ball", (0.165, 0.101, 0.2), mesh=gltf.mesh("glass ball", (ball, glass)))
    return gltf


def cornell_lambertian(title):
    gltf, white = cornell_room(title, hidden=True)
    ball = gltf.mesh("ball", (gltf.shape(*sphere(64, 32, radius=0.1)), white))
    gltf.node("left ball", (0.395, 0.101, 0.37), mesh=ball)
    gltf.node("right ball", (0.165, 0.101, 0.2), mesh=ball)
    return gltf


# --- A furnace ------------------------------------------------------------------------------------------------------

def furnace(title):
    """Builds a closed box in which every wall has albedo 1/2 and emits 1 nit inwards."""
    gltf = Gltf(title)
    wall = gltf.lambertian("glowing wall", (0.5, 0.5, 0.5), emission=(1, 1, 1))
    walls = [flipped(quad) for quad in box_quads((-1, -1, -1), (1, 1, 1))]
    gltf.node("box", mesh=gltf.mesh("box", (gltf.shape(*quads(*walls)), wall)))
    gltf.camera((0.1, -0.2, 0.3), (0.3, 0.2, -1), math.radians(70), 1)
    return gltf


# --- A Lambertian room under lights of all kinds --------------------------------------------------------------------

def room(title, roof):
    """Builds a room of 4 x 3 x 5 m with a block, a sphere and a camera at its front. `roof` is the covered depth [m],
    from z = 0 (back) to 5."""
    gltf = Gltf(title)
    white, blue, ochre, grey = (gltf.lambertian(name, color) for name, color in (
        ("white", (0.8, 0.8, 0.8)), ("blue", (0.2, 0.3, 0.6)), ("ochre", (0.65, 0.45, 0.2)), ("grey", (0.5, 0.5, 0.5))))
    low, high = (-2, 0, 0), (2, 3, 5)
    walls = [flipped(q) for q in box_quads(low, high, "-z+z-y")]
    if roof > 0:
        walls += [flipped(q) for q in box_quads(low, (2, 3, roof), "+y")]
    for name, material, sides in (("floor, ends and roof", white, walls),
                                  ("left wall", ochre, [flipped(q) for q in box_quads(low, high, "-x")]),
                                  ("right wall", blue, [flipped(q) for q in box_quads(low, high, "+x")]),
                                  ("block", grey, box_quads((-0.5, 0, -0.4), (0.5, 1.1, 0.4), "-x+x+y-z+z"))):
        place = {"translation": (-0.7, 0, 1.6), "rotation": rotation_about((0, 1, 0), 25)} if name == "block" else {}
        gltf.node(name, mesh=gltf.mesh(name, (gltf.shape(*quads(*sides)), material)), **place)
    ball = gltf.mesh("ball", (gltf.shape(*sphere(48, 24, radius=0.5)), white))
    gltf.node("ball", (0.8, 0.52, 2.1), mesh=ball)
    gltf.camera((0, 1.5, 4.9), (0, -0.12, -1), math.radians(50), 4 / 3)
    return gltf


def room_point(title):
    gltf = room(title, roof=5)
    gltf.light("lamp", "point", 120, (1, 0.9, 0.75), (0.6, 2.4, 2.6))
    return gltf


def room_spot(title):
    gltf = room(title, roof=5)
    position, target = (1.2, 2.7, 3.2), (-0.3, 0.7, 1.4)
    gltf.light("spot", "spot", 600, (1, 0.95, 0.9), position, sub(target, position),
               spot={"innerConeAngle": 0.25, "outerConeAngle": 0.45})
    return gltf


def ies_file(vertical, horizontal, candela):
    """Returns the text of a type C light profile; `candela` takes both angles in degrees."""
    rows = [" ".join(f"{candela(v, h):.1f}" for v in vertical) for h in horizontal]
    return "\r\n".join(("IES:LM-63-2019", "[TEST] none: made by bdpt scenes/make_scenes.py", "[MANUFAC] bdpt", "TILT=NONE",
                        f"1 -1 1 {len(vertical)} {len(horizontal)} 1 2 0 0 0", "1 1 60",
                        " ".join(map(str, vertical)), " ".join(map(str, horizontal)), *rows, ""))


def room_profiles(title):
    gltf = room(title, roof=5)
    # Has a ring of light around a bright centre, with rotational symmetry.
    spot = ies_file(range(0, 91, 5), (0,), lambda v, h: max(0, 250 * math.cos(math.radians(4 * v)) + 150) if v < 70 else 0)
    gltf.profile_lights("downlight", spot, (1, 0.85, 0.65), [((x, 2.95, 0.45), (0, -1, 0), (0, 0, -1)) for x in (-1.3, 0, 1.3)])
    # Has two lobes, along +x and -x of the luminaire; the file holds one quadrant.
    wings = ies_file(range(0, 181, 10), range(0, 91, 15), lambda v, h: 300 * math.sin(math.radians(v)) ** 4
                     * math.cos(math.radians(h)) ** 8 * (1.5 - v / 180))
    gltf.profile_lights("wings", wings, (0.7, 0.85, 1), [((0.2, 1.9, 3.1), (0, -1, 0), (0, 0, -1))])
    return gltf


def room_sun(title):
    gltf = room(title, roof=2.5)
    gltf.light("sun", "directional", 50000, (1, 0.95, 0.85), direction=(-0.5, -1, -0.6))
    return gltf


def room_environment(title):
    return room(title, roof=2.5)


# --- Stage: two walls and a floor with a lamp above, for single subjects --------------------------------------------

def stage(title, lamp_radiance, stripes=False):
    """Builds a floor and a back wall 6 m wide with a lamp of 1.2 x 0.8 m at 2.9 m; objects stand near the origin."""
    gltf = Gltf(title)
    grey = gltf.lambertian("grey", (0.6, 0.6, 0.6))
    backdrop = [((-3, 0, 2), (3, 0, 2), (3, 0, -1.6), (-3, 0, -1.6))]
    width = 0.15 if stripes else 6
    bars = [((-3 + width * i, 0, -1.6), (-3 + width * (i + 1), 0, -1.6), (-3 + width * (i + 1), 3, -1.6),
             (-3 + width * i, 3, -1.6)) for i in range(round(6 / width))]
    parts = [(gltf.shape(*quads(*backdrop, *bars[::2])), grey)]
    if stripes:
        parts.append((gltf.shape(*quads(*bars[1::2])), gltf.lambertian("dark stripes", (0.1, 0.15, 0.25))))
    gltf.node("floor and wall", mesh=gltf.mesh("floor and wall", *parts))
    lamp = gltf.lambertian("lamp", (0.7, 0.7, 0.7), emission=(lamp_radiance,) * 3)
    corners = ((-0.6, 0, -0.4), (0.6, 0, -0.4), (0.6, 0, 0.4), (-0.6, 0, 0.4))
    gltf.node("lamp", (0, 2.9, 0.4), mesh=gltf.mesh("lamp", (gltf.shape(*quads(corners)), lamp)))
    gltf.camera((0, 1.1, 4.2), (0, -0.14, -1), math.radians(38), 4 / 3)
    return gltf


def shading_normals(title):
    gltf = stage(title, 60)
    clay = gltf.lambertian("clay", (0.7, 0.35, 0.25))
    plastic = gltf.material("plastic", (0.2, 0.4, 0.3), roughness=0.4)
    gltf.node("coarse clay ball", (-0.75, 0.45, 0), mesh=gltf.mesh("clay ball", (gltf.shape(*sphere(7, 4, 0.4)), clay)))
    gltf.node("coarse plastic ball", (0.75, 0.45, 0),
              mesh=gltf.mesh("plastic ball", (gltf.shape(*sphere(6, 4, 0.4)), plastic)))

    def waves(x, z):
        return 0.03 * math.sin(16 * x) * math.cos(12 * z)

    # Shows a flat sheet with wavy shading normals, and a sheet with coarse waves and shading normals of finer ones.
    flat = gltf.shape(*height_field(1.2, 48, lambda x, z: 0.0, waves))
    wavy = gltf.shape(*height_field(1.0, 9, lambda x, z: 0.06 * math.sin(8 * x), waves))
    gltf.node("flat sheet", (0, 0.02, 0.9), mesh=gltf.mesh("flat sheet", (flat, clay)))
    gltf.node("wavy sheet", (0, 0.75, -0.9), rotation_about((1, 0, 0), 60), mesh=gltf.mesh("wavy sheet", (wavy, plastic)))
    return gltf


def instances(title):
    """Places one chiral mesh with every kind of transform, and one-sided lamps of which one is mirrored."""
    gltf = stage(title, 30)
    spring = gltf.mesh("spring", (gltf.shape(*coil(2.25, 0.16, 0.05, 0.15, 72, 10)),
                                  gltf.material("paint", (0.75, 0.3, 0.1), roughness=0.35)))
    upright, tilted = None, rotation_about((1, 1, 0), 70)
    rows = (("plain", upright, (1, 1, 1)), ("turned", tilted, (1, 1, 1)), ("stretched", upright, (0.6, 1.4, 1.1)),
            ("mirrored in x", upright, (-1, 1, 1)), ("mirrored in all axes", upright, (-1, -1, -1)),
            ("turned, stretched and mirrored", tilted, (1.3, -0.7, 0.9)))
    for i, (name, rotation, scale) in enumerate(rows):
        height = 0.65 if scale[1] < 0 else 0.3
        gltf.node(name, (-1.35 + 0.54 * i, height, 0.1), rotation, scale, mesh=spring)
    # A stretched parent and a rotated child make a sheared instance; two mirrored transforms cancel.
    stretched = gltf.node("stretched parent", (-0.8, 1.0, -0.7), scale=(2, 0.7, 1))
    gltf.node("sheared", rotation=rotation_about((0, 0, 1), 40), parent=stretched, mesh=spring)
    mirror = gltf.node("mirrored parent", (0.7, 0.9, -0.7), scale=(-1, 1, 1))
    gltf.node("mirrored twice", rotation=rotation_about((0, 0, 1), -30), scale=(1, 1, -1), parent=mirror, mesh=spring)
    for i in range(11):
        gltf.node(f"small {i + 1}", (-1.5 + 0.3 * i, 0.1, 0.9), rotation_about((0, 1, 0.2), 33 * i),
                  (0.3 * (-1) ** i, 0.3, 0.3), mesh=spring)
    # Both emit on the side that faces the floor, mirrored or not.
    glow = gltf.lambertian("glow", (0.5, 0.5, 0.5), emission=(20, 28, 40))
    corners = ((-0.15, 0, -0.15), (0.15, 0, -0.15), (0.15, 0, 0.15), (-0.15, 0, 0.15))
    plate = gltf.mesh("glowing plate", (gltf.shape(*quads(corners)), glow))
    gltf.node("plain plate", (-1.6, 0.7, 0.3), mesh=plate)
    gltf.node("mirrored plate", (1.6, 0.7, 0.3), scale=(-1, 1, 1), mesh=plate)
    return gltf


def glass_rough(title):
    gltf = stage(title, 60, stripes=True)
    ball = gltf.shape(*sphere(64, 32, radius=0.28))
    for i, roughness in enumerate((0, 0.15, 0.35, 0.6)):
        glass = gltf.material(f"glass of roughness {roughness}", (1, 1, 1), roughness=roughness,
                              extensions={**SOLID_GLASS, "volume": {"thicknessFactor": 0.5}})
        gltf.node(f"glass ball {i + 1}", (-1.05 + 0.7 * i, 0.29, 0.3),
                  mesh=gltf.mesh(f"glass ball {i + 1}", (ball, glass)))
    metals = (("silver", (0.96, 0.95, 0.92), 0.05), ("gold", (1, 0.77, 0.34), 0.2), ("copper", (0.95, 0.64, 0.54), 0.4),
              ("iron", (0.56, 0.57, 0.58), 0.7))
    for i, (name, color, roughness) in enumerate(metals):
        metal = gltf.material(name, color, metallic=1, roughness=roughness)
        gltf.node(f"{name} ball", (-1.05 + 0.7 * i, 1.05, -0.75), mesh=gltf.mesh(f"{name} ball", (ball, metal)))
    amber = gltf.material("amber", (1, 1, 1), roughness=0, extensions={
        **SOLID_GLASS, "volume": {"thicknessFactor": 0.4, "attenuationDistance": 0.2,
                                  "attenuationColor": [0.9, 0.5, 0.1]}})
    block = gltf.shape(*quads(*box_quads((-0.2, -0.2, -0.2), (0.2, 0.2, 0.2))))
    gltf.node("amber block", (0.35, 0.21, 1.0), rotation_about((0, 1, 0), 30), mesh=gltf.mesh("amber block", (block, amber)))
    pane = gltf.shape(*quads(((-0.25, 0.01, 0), (0.25, 0.01, 0), (0.25, 0.5, 0), (-0.25, 0.5, 0))))
    for x, name, roughness in ((-0.85, "thin pane", 0), (-0.25, "thin frosted pane", 0.3)):
        material = gltf.material(name, (0.95, 1, 0.97), roughness=roughness, extensions=THIN_GLASS, double_sided=True)
        gltf.node(name, (x, 0, 1.05), rotation_about((0, 1, 0), 15), mesh=gltf.mesh(name, (pane, material)))
    return gltf


SCENES = {
    "cornell-box": cornell_box,
    "cornell-box-hidden": lambda title: cornell_box(title, hidden=True),
    "cornell-spheres": cornell_spheres,
    "cornell-spheres-hidden": lambda title: cornell_spheres(title, hidden=True),
    "cornell-lambertian-hidden": cornell_lambertian,
    "furnace": furnace,
    "room-point": room_point,
    "room-profiles": room_profiles,
    "room-spot": room_spot,
    "room-sun": room_sun,
    "room-environment": room_environment,
    "shading-normals": shading_normals,
    "instances": instances,
    "glass-rough": glass_rough,
    **HIDDEN_LIGHT_SCENES,
    **FEATURE_SCENES,
    **SPECULAR_SCENES,
    **LAYER_SCENES,
    **MANY_LIGHT_SCENES,
    **MEDIA_SCENES,
    **MOTION_SCENES,
}


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parent
    folder.mkdir(parents=True, exist_ok=True)
    for name, build in SCENES.items():
        (folder / f"{name}.gltf").write_text(build(name).text(), encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
