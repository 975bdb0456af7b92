"""Builds scenes in which sky, sun and lamps light different places, which challenges light selection. `real_scenes.py`
writes them for its measurements."""

import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scenes"))
from gltf_builder import Gltf, rotation_about, sub
from materials import glass, mirror
from shapes import box_quads, inner_quads, quads, sphere

SUN = (-0.5, -1, -0.6)
ROOM = (4.0, 3.0)  # width and height of a room [m]


def add_box(gltf, name, material, low, high, position=(0, 0, 0), degrees=0):
    shape = gltf.shape(*quads(*box_quads(low, high)))
    gltf.node(name, position, rotation_about((0, 1, 0), degrees), mesh=gltf.mesh(name, (shape, material)))


def add_lamp(gltf, name, corner, size, radiance):
    """Adds a lamp that emits downwards from the rectangle that begins at `corner`."""
    lamp = gltf.lambertian(name, (0.7, 0.7, 0.7), emission=(radiance,) * 3)
    x, y, z = corner
    corners = ((x, y, z), (x + size[0], y, z), (x + size[0], y, z + size[1]), (x, y, z + size[1]))
    gltf.node(name, mesh=gltf.mesh(name, (gltf.shape(*quads(corners)), lamp)))


def add_wall(gltf, name, materials, corner, along_x, hinge_degrees):
    """Adds one side of a room, with a door in its middle that is open by `hinge_degrees`."""
    (white, wood), (size, height), (x, z) = materials, ROOM, corner
    door, t = 0.9, 0.05
    a, b = (size - door) / 2, (size + door) / 2
    for part, u0, u1, y0 in (("left", 0, a, 0), ("right", b, size, 0), ("top", a, b, 2.1)):
        low, high = ((x + u0, y0, z - t), (x + u1, height, z + t)) if along_x else \
            ((x - t, y0, z + u0), (x + t, height, z + u1))
        add_box(gltf, f"{name}, {part}", white, low, high)
    place = (x + a, 0, z) if along_x else (x, 0, z + b)
    add_box(gltf, f"{name}, door", wood, (0, 0.01, -0.02), (door - 0.02, 2.09, 0.02), place,
            hinge_degrees + (0 if along_x else 90))


def add_uplight(gltf, name, material, corner, side, radiance):
    """Adds a square lamp that emits upwards from a box, open at the top, that begins at `corner`."""
    (x, y, z), t = corner, 0.02
    for i, (low, high) in enumerate((((-t, -t, -t), (side + t, -t / 2, side + t)), ((-t, 0, -t), (side + t, 0.15, 0)),
                                     ((-t, 0, side), (side + t, 0.15, side + t)), ((-t, 0, 0), (0, 0.15, side)),
                                     ((side, 0, 0), (side + t, 0.15, side)))):
        add_box(gltf, f"{name}, side {i}", material, low, high, corner)
    lamp = gltf.lambertian(name, (0.7, 0.7, 0.7), emission=(radiance,) * 3)
    corners = ((x, y, z + side), (x + side, y, z + side), (x + side, y, z), (x, y, z))
    gltf.node(name, mesh=gltf.mesh(name, (gltf.shape(*quads(corners)), lamp)))


def floor(side):
    """Builds a floor with three blocks, under a sun and a lamp of 0.3 x 0.3 m next to the camera."""
    gltf = Gltf(f"a floor of {side} m")
    half = side / 2
    grey = gltf.lambertian("grey", (0.5, 0.5, 0.5))
    gltf.node("floor", mesh=gltf.mesh("floor", (gltf.shape(*quads(
        ((-half, 0, half), (half, 0, half), (half, 0, -half), (-half, 0, -half)))), grey)))
    white = gltf.lambertian("white", (0.8, 0.8, 0.8))
    for i, x in enumerate((-0.9, 0.1, 0.9)):
        add_box(gltf, f"block {i}", white, (-0.2, 0, -0.2), (0.2, 0.3 + 0.2 * i, 0.2), (x, 0, -0.4 * i), 20 * i)
    add_lamp(gltf, "lamp", (-0.15, 1.6, -0.15), (0.3, 0.3), 40)
    gltf.light("sun", "directional", 1.0, direction=SUN)
    gltf.camera((0, 1.2, 2.6), (0, -0.3, -1), math.radians(50), 16 / 9)
    return gltf


def six_rooms(title="six rooms"):
    """Builds rooms of 4 x 3 x 4 m in two rows, with half-open doors between neighbours. One has a lamp, another has,
    behind a corner, a window that admits sun and sky; the camera looks through two doors."""
    gltf = Gltf(title)
    white, wood = gltf.lambertian("white", (0.8, 0.78, 0.75)), gltf.lambertian("wood", (0.4, 0.28, 0.16))
    size, height, t = *ROOM, 0.05
    floor_and_ceiling = inner_quads((0, 0, 0), (3 * size, height, 2 * size), "-y+y")
    gltf.node("floor and ceiling", mesh=gltf.mesh("floor and ceiling", (gltf.shape(*quads(*floor_and_ceiling)), white)))
    for name, low, high in (("front", (0, 0, 2 * size), (3 * size, height, 2 * size + t)),
                            ("left", (-t, 0, 0), (0, height, 2 * size)),
                            ("right", (3 * size, 0, 0), (3 * size + t, height, 2 * size)),
                            ("back 1", (0, 0, -t), (2 * size + 1, height, 0)),
                            ("back 2", (2 * size + 3, 0, -t), (3 * size, height, 0)),
                            ("below the window", (2 * size + 1, 0, -t), (2 * size + 3, 0.9, 0)),
                            ("roof 1", (0, height, 0), (3 * size, height + t, 2 * size))):
        add_box(gltf, name, white, low, high)

    def wall(name, corner, along_x, hinge_degrees):
        add_wall(gltf, name, (white, wood), corner, along_x, hinge_degrees)

    for i in range(3):
        wall(f"between rows {i}", (size * i, size), True, 40 + 15 * i)
        if i > 0:
            wall(f"back row {i}", (size * i, 0), False, 35)
            wall(f"front row {i}", (size * i, size), False, -65)
    add_lamp(gltf, "lamp", (1.5, 2.8, 1.5), (0.6, 0.6), 30)
    add_box(gltf, "table", wood, (-0.6, 0.7, -0.4), (0.6, 0.75, 0.4), (5.6, 0, 6.3), 30)
    gltf.node("ball", (7.2, 0.4, 5.2), mesh=gltf.mesh("ball", (gltf.shape(*sphere(48, 24, 0.4)), white)))
    gltf.light("sun", "directional", 5.0, direction=(-0.35, -0.7, 1))
    eye, target = (7.6, 1.6, 7.6), (5.2, 1.0, 4.0)
    gltf.camera(eye, sub(target, eye), math.radians(65), 16 / 9)
    return gltf


def offices(columns=6, rows=2):
    """Builds rooms of 4 x 3 x 4 m in rows, with doors ajar between neighbours and in each a lamp turned to the ceiling.
    The camera is in one of them."""
    gltf = Gltf("offices")
    white, wood = gltf.lambertian("white", (0.8, 0.78, 0.75)), gltf.lambertian("wood", (0.4, 0.28, 0.16))
    size, height = ROOM
    shell = inner_quads((0, 0, 0), (columns * size, height, rows * size), "-x+x-y+y-z+z")
    gltf.node("shell", mesh=gltf.mesh("shell", (gltf.shape(*quads(*shell)), white)))
    for i in range(columns):
        for k in range(rows):
            corner = (size * i, size * k)
            if k > 0:
                add_wall(gltf, f"between rows {i} {k}", (white, wood), corner, True, 15 + 10 * (i % 3))
            if i > 0:
                add_wall(gltf, f"in a row {i} {k}", (white, wood), corner, False, -20 - 8 * (k % 3))
            add_uplight(gltf, f"lamp {i} {k}", wood, (corner[0] + 0.6, 1.6, corner[1] + 0.6), 0.3, 60)
    add_box(gltf, "table", wood, (-0.6, 0.7, -0.4), (0.6, 0.75, 0.4), (2 * size + 1.8, 0, 1.8), 30)
    gltf.node("ball", (2 * size + 2.6, 0.4, 1.2), mesh=gltf.mesh("ball", (gltf.shape(*sphere(48, 24, 0.4)), white)))
    eye, target = (2 * size + 3.6, 1.6, 3.6), (2 * size + 1.2, 1.0, 0.5)
    gltf.camera(eye, sub(target, eye), math.radians(65), 16 / 9)
    return gltf


def shop(title="a shop"):
    """Builds a shop of 6 x 3 x 8 m, with shelves of glass, silver and brass under eight small lamps, and a front that
    is open to sun and sky."""
    gltf = Gltf(title)
    white, dark = gltf.lambertian("white", (0.75, 0.75, 0.75)), gltf.lambertian("dark wood", (0.25, 0.16, 0.1))
    walls = inner_quads((-3, 0, -8), (3, 3, 0), "-x+x-y+y-z")
    gltf.node("walls", mesh=gltf.mesh("walls", (gltf.shape(*quads(*walls)), white)))
    add_box(gltf, "roof", white, (-3.1, 3.01, -8.1), (3.1, 3.1, 0))
    ball = gltf.shape(*sphere(48, 24, 0.16))
    goods = [glass(gltf, "glass"), mirror(gltf, "silver", (0.96, 0.95, 0.92)),
             gltf.material("brass", (0.9, 0.7, 0.35), metallic=1, roughness=0.25),
             gltf.material("glaze", (0.2, 0.35, 0.6), roughness=0.15)]
    meshes = [gltf.mesh(f"ball {i}", (ball, material)) for i, material in enumerate(goods)]
    for i in range(4):
        add_box(gltf, f"shelf {i}", dark, (-0.9, 0, -0.25), (0.9, 0.9, 0.25), (-1.9 + 3.8 * (i % 2), 0, -6 + 2.4 * (i // 2)))
        for k in range(4):
            gltf.node(f"good {i} {k}", (-2.5 + 3.8 * (i % 2) + 0.4 * k, 1.065, -6 + 2.4 * (i // 2)), mesh=meshes[(i + k) % 4])
    for i in range(8):
        gltf.sphere_light(f"lamp {i}", 0.7, 0.02, (-1.8 + 1.2 * (i % 4), 2.6, -6.6 + 2.4 * (i // 4)))
    gltf.light("sun", "directional", 3.0, direction=(-0.4, -0.7, -1))
    gltf.camera((0.4, 1.5, -0.4), (-0.05, -0.12, -1), math.radians(60), 16 / 9)
    return gltf


def lamp_room(title="a room with a lamp and a window", glazed=False):
    """Builds a room of 4 x 3 x 5 m with a lamp, and a window beside the camera that admits sun and sky, through a pane
    of clear glass if it is `glazed`."""
    gltf = Gltf(title)
    white, blue = gltf.lambertian("white", (0.8, 0.8, 0.8)), gltf.lambertian("blue", (0.2, 0.3, 0.6))
    walls = inner_quads((-2, 0, 0), (2, 3, 5), "-y+y-z+z") + inner_quads((-2, 0, 0), (2, 3, 5), "-x")
    side = [q for low, high in (((2, 0, 0), (2.1, 3, 2.6)), ((2, 0, 4.2), (2.1, 3, 5)), ((2, 0, 2.6), (2.1, 1, 4.2)),
                                ((2, 2.4, 2.6), (2.1, 3, 4.2))) for q in box_quads(low, high)]
    gltf.node("walls", mesh=gltf.mesh("walls", (gltf.shape(*quads(*walls)), white), (gltf.shape(*quads(*side)), white)))
    for name, low, high in (("roof", (-2.1, 3.01, -0.1), (2.1, 3.1, 5.1)), ("back", (-2.1, 0, -0.1), (2.1, 3, -0.01)),
                            ("front", (-2.1, 0, 5.01), (2.1, 3, 5.1)), ("left", (-2.1, 0, 0), (-2.01, 3, 5))):
        add_box(gltf, name, white, low, high)
    add_box(gltf, "block", blue, (-0.5, 0, -0.4), (0.5, 1.1, 0.4), (-0.7, 0, 1.6), 25)
    gltf.node("ball", (0.8, 0.52, 2.1), mesh=gltf.mesh("ball", (gltf.shape(*sphere(48, 24, 0.5)), white)))
    if glazed:
        pane = gltf.material("pane", (1, 1, 1), roughness=0, extensions={"transmission": {"transmissionFactor": 1}})
        corners = ((2.05, 1, 2.6), (2.05, 2.4, 2.6), (2.05, 2.4, 4.2), (2.05, 1, 4.2))
        gltf.node("pane", mesh=gltf.mesh("pane", (gltf.shape(*quads(corners)), pane)))
    add_lamp(gltf, "lamp", (-0.2, 2.7, 1.5), (0.4, 0.4), 20)
    gltf.light("sun", "directional", 4.0, direction=(-1, -0.8, -0.1))
    gltf.camera((0, 1.5, 4.9), (0, -0.12, -1), math.radians(60), 16 / 9)
    return gltf


MIXED_LIGHT_SCENES = {"floor-6": lambda: floor(6), "floor-60": lambda: floor(60), "floor-200": lambda: floor(200),
                      "six-rooms": six_rooms, "shop": shop, "lamp-room": lamp_room, "offices": offices,
                      "glazed-room": lambda: lamp_room("a room with a lamp and a glazed window", glazed=True)}


def write(folder):
    for name, make in MIXED_LIGHT_SCENES.items():
        (pathlib.Path(folder) / f"{name}.gltf").write_text(make().text(), encoding="utf-8")


if __name__ == "__main__":
    write(sys.argv[1])
