"""Builds an animated scene that tests motion blur."""

import math

from gltf_builder import Gltf, rotation_about
from shapes import box_quads, quads, sphere


def turns(axis, degrees_per_second, seconds, start=0):
    """Returns keys of a uniform rotation, at most a quarter turn apart."""
    count = math.ceil(abs(degrees_per_second) * seconds / 90)
    return [(seconds * i / count, rotation_about(axis, start + degrees_per_second * seconds * i / count))
            for i in range(count + 1)]


def striped(gltf, segments=32, rings=16, radius=0.25):
    """Returns a sphere of two shapes, like a beach ball, whose sectors make its rotation visible."""
    positions, triangles, normals = sphere(segments, rings, radius)
    parts = ([], [])
    for triangle in triangles:
        x, _, z = (sum(positions[i][axis] for i in triangle) for axis in range(3))
        parts[int((math.atan2(x, z) / (2 * math.pi) + 0.5) * 6) % 2].append(triangle)
    return [gltf.shape(positions, part, normals) for part in parts]


def motion(title):
    """Builds an animation of one second: a pinwheel, a rolling sphere, a sphere that bounces and is squashed, a bending
    reed, a glowing bead on a string, a moving lamp, and a second camera that follows the rolling sphere."""
    gltf = Gltf(title)
    grey = gltf.lambertian("grey", (0.55, 0.55, 0.55))
    dark = gltf.lambertian("dark tiles", (0.2, 0.22, 0.26))
    tiles = [[], []]
    for row in range(8):
        for column in range(12):
            x, z = -3 + 0.5 * column, -1.6 + 0.5 * row
            tiles[(row + column) % 2].append(((x, 0, z + 0.5), (x + 0.5, 0, z + 0.5), (x + 0.5, 0, z), (x, 0, z)))
    wall = ((-3, 0, -1.6), (3, 0, -1.6), (3, 3, -1.6), (-3, 3, -1.6))
    gltf.node("floor and wall", mesh=gltf.mesh("floor and wall", (gltf.shape(*quads(*tiles[0], wall)), grey),
                                               (gltf.shape(*quads(*tiles[1])), dark)))
    colors = [gltf.lambertian(name, color, double_sided=True) for name, color in (
        ("red", (0.65, 0.1, 0.08)), ("yellow", (0.75, 0.6, 0.1)), ("blue", (0.1, 0.2, 0.6)),
        ("white", (0.75, 0.75, 0.75)))]

    blade = ((0, 0, 0.02), (0.12, 0.02, 0.05), (0.1, 0.42, 0.05), (0, 0.45, 0.02))
    pinwheel = gltf.node("pinwheel", (-1.05, 1.35, -0.6))
    for i, color in enumerate(colors):
        mesh = gltf.mesh(f"blade {i + 1}", (gltf.shape(*quads(blade)), color))
        gltf.node(f"blade {i + 1}", rotation=rotation_about((0, 0, 1), 90 * i), parent=pinwheel, mesh=mesh)
    gltf.animate(pinwheel, "rotation", turns((0, 0, 1), -720, 1))
    post = quads(*box_quads((-1.07, 0, -0.66), (-1.03, 1.35, -0.62)))
    gltf.node("post", mesh=gltf.mesh("post", (gltf.shape(*post), colors[3])))

    halves = striped(gltf)
    beach = gltf.mesh("beach ball", *zip(halves, (colors[0], colors[3])))
    gltf.node("ball at rest", (1.35, 0.26, -0.9), rotation_about((0.3, 0, 1), 40), mesh=beach)
    rolling = gltf.node("rolling ball", (-1.5, 0.26, 0.9), mesh=beach)
    gltf.animate(rolling, "translation", [(0, (-1.5, 0.26, 0.9)), (1, (1.5, 0.26, 0.9))])
    gltf.animate(rolling, "rotation", turns((0, 0, 1), -math.degrees(3 / 0.25), 1))
    mirrored = gltf.node("mirrored ball", (0.95, 1.15, -1.0), scale=(-0.6, 0.6, 0.6), mesh=beach)
    gltf.animate(mirrored, "rotation", turns((0, 1, 0), 300, 1))

    positions, triangles, normals = sphere(32, 16, 0.2)
    squash = [(0.35 * x, -0.5 * y, 0.35 * z) for x, y, z in positions]
    ball = gltf.mesh("rubber", (gltf.shape(positions, triangles, normals, targets=[squash]),
                                gltf.material("rubber", (0.1, 0.45, 0.2), roughness=0.4)))
    bouncing = gltf.node("bouncing ball", (-0.15, 1.2, 0.2), mesh=ball)
    # The sphere falls, is squashed on the floor at half time and rises again; tangents are velocities.
    gltf.animate(bouncing, "translation", [
        (0, (0, 0, 0), (-0.15, 1.2, 0.2), (0, 0, 0)), (0.45, (0, -4.4, 0), (-0.15, 0.21, 0.2), (0, -2, 0)),
        (0.55, (0, 2, 0), (-0.15, 0.21, 0.2), (0, 4.4, 0)), (1, (0, 0, 0), (-0.15, 1.2, 0.2), (0, 0, 0))],
        "CUBICSPLINE")
    gltf.animate(bouncing, "weights", [(0, 0), (0.45, 0), (0.5, 1), (0.55, 0), (1, 0)])

    reed, heights = [], 13
    for i in range(heights):
        y = 1.1 * i / (heights - 1)
        reed += [(-0.04, y, 0), (0.04, y, 0)]
    bend = [(max(0, 1 - p[1] / 0.6), min(1, p[1] / 0.6)) for p in reed]
    strip = [t for i in range(heights - 1) for t in ((2 * i, 2 * i + 1, 2 * i + 3), (2 * i, 2 * i + 3, 2 * i + 2))]
    root = gltf.node("reed root", (0.55, 0, -0.3))
    tip = gltf.node("reed tip", parent=root)
    shape = gltf.shape(reed, strip, joints=bend)
    gltf.node("reed", mesh=gltf.mesh("reed", (shape, colors[1])), skin=gltf.skin("reed", (root, tip)))
    gltf.animate(tip, "rotation", [(0, rotation_about((0, 0, 1), 35)), (0.25, rotation_about((0, 0, 1), -20)),
                                   (0.5, rotation_about((0, 0, 1), 15)), (0.75, rotation_about((0, 0, 1), -40)),
                                   (1, rotation_about((0, 0, 1), 35))])

    bead = gltf.mesh("bead", (gltf.shape(*sphere(16, 8, 0.035)), gltf.lambertian("bead", (0.5, 0.5, 0.5),
                                                                              emission=(900, 420, 120))))
    string = gltf.node("string", (0.75, 2.3, 0.3), rotation_about((0, 0, 1), 50))
    gltf.node("bead", (0, -0.9, 0), parent=string, mesh=bead)
    gltf.animate(string, "rotation", turns((0, 0, 1), -100, 1, start=50))
    lamp = gltf.sphere_light("lamp", 45, 0.08, (-1.2, 2.6, 1.2), (0.9, 0.95, 1))
    gltf.animate(lamp, "translation", [(0, (-1.2, 2.6, 1.2)), (1, (0.4, 2.6, 1.2))])

    gltf.camera((0, 1.3, 4.6), (0, -0.1, -1), math.radians(36), 16 / 9)
    panning = gltf.camera((-0.5, 0.8, 3.4), (-0.2, -0.2, -1), math.radians(36), 16 / 9, name="panning camera")
    gltf.animate(panning, "translation", [(0, (-1.5, 0.8, 3.4)), (1, (1.5, 0.8, 3.4))])
    return gltf


MOTION_SCENES = {
    "motion": motion,
}
