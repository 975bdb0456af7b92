"""Makes triangle meshes as (positions, triangles) or (positions, triangles, normals); fronts are counter-clockwise."""

import math

from gltf_builder import cross, normalized


def quads(*corners_of_each):
    """Makes flat quadrilaterals, each from its four corners counter-clockwise as seen from its front."""
    positions, triangles = [], []
    for corners in corners_of_each:
        first = len(positions)
        positions += corners
        triangles += [(first, first + 1, first + 2), (first, first + 2, first + 3)]
    return positions, triangles


def flipped(quad):
    return tuple(reversed(quad))


def box_quads(low, high, sides="-x+x-y+y-z+z"):
    """Returns the chosen sides of an axis-aligned box, which face outwards."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    all_sides = {
        "-x": ((x0, y0, z0), (x0, y0, z1), (x0, y1, z1), (x0, y1, z0)),
        "+x": ((x1, y0, z1), (x1, y0, z0), (x1, y1, z0), (x1, y1, z1)),
        "-y": ((x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)),
        "+y": ((x0, y1, z1), (x1, y1, z1), (x1, y1, z0), (x0, y1, z0)),
        "-z": ((x1, y0, z0), (x0, y0, z0), (x0, y1, z0), (x1, y1, z0)),
        "+z": ((x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)),
    }
    return [all_sides[sides[i:i + 2]] for i in range(0, len(sides), 2)]


def inner_quads(low, high, sides="-x+x-y+y-z+z"):
    """Returns the chosen sides of an axis-aligned box, which face inwards: the walls of a room."""
    return [flipped(quad) for quad in box_quads(low, high, sides)]


def card(width, height):
    """Makes an upright rectangle that stands on the origin and faces +z, with texture coordinates for an image whose
    first row is on top."""
    x = width / 2
    return ([(-x, 0, 0), (x, 0, 0), (x, height, 0), (-x, height, 0)], [(0, 1, 2), (0, 2, 3)], [(0, 0, 1)] * 4,
            [(0, 1), (1, 1), (1, 0), (0, 0)])


def sphere(segments, rings, radius=1.0):
    """Makes a closed sphere around the origin, with the normals of the exact sphere."""
    normals = [(0.0, 1.0, 0.0)]
    for ring in range(1, rings):
        theta = math.pi * ring / rings
        for segment in range(segments):
            phi = 2 * math.pi * segment / segments
            normals.append((math.sin(theta) * math.sin(phi), math.cos(theta), math.sin(theta) * math.cos(phi)))
    normals.append((0.0, -1.0, 0.0))
    last = len(normals) - 1
    triangles = []
    for i in range(segments):
        j = (i + 1) % segments
        triangles.append((0, 1 + i, 1 + j))
        for ring in range(rings - 2):
            upper, lower = 1 + ring * segments, 1 + (ring + 1) * segments
            triangles += [(upper + i, lower + i, lower + j), (upper + i, lower + j, upper + j)]
        bottom = 1 + (rings - 2) * segments
        triangles.append((last, bottom + j, bottom + i))
    return [tuple(radius * c for c in n) for n in normals], triangles, normals


def height_field(size, cells, height, shading_height):
    """Makes a square of `cells` by `cells` around the origin: its positions follow the function `height(x, z)`, its
    normals the function `shading_height(x, z)`."""
    positions, normals, triangles = [], [], []
    step = 1e-4
    for row in range(cells + 1):
        for column in range(cells + 1):
            x, z = size * (column / cells - 0.5), size * (row / cells - 0.5)
            slope_x = (shading_height(x + step, z) - shading_height(x - step, z)) / (2 * step)
            slope_z = (shading_height(x, z + step) - shading_height(x, z - step)) / (2 * step)
            positions.append((x, height(x, z), z))
            normals.append((-slope_x, 1.0, -slope_z))
    for row in range(cells):
        for column in range(cells):
            a = row * (cells + 1) + column
            b = a + cells + 1
            triangles += [(a, b, b + 1), (a, b + 1, a + 1)]
    return positions, triangles, normals


def coil(turns, coil_radius, tube_radius, rise, segments, sides):
    """Makes a tube along a right-handed helix around +y, closed at both ends by a point: a shape that differs from its
    mirror image."""
    positions, normals, triangles, centres, tangents = [], [], [], [], []
    for i in range(segments + 1):
        angle = 2 * math.pi * turns * i / segments
        outwards = (math.sin(angle), 0.0, math.cos(angle))
        centres.append((coil_radius * outwards[0], rise * turns * i / segments, coil_radius * outwards[2]))
        tangents.append(normalized((2 * math.pi * coil_radius * outwards[2], rise,
                                    -2 * math.pi * coil_radius * outwards[0])))
        upwards = cross(tangents[-1], outwards)
        for k in range(sides):
            c, s = math.cos(2 * math.pi * k / sides), math.sin(2 * math.pi * k / sides)
            normals.append(tuple(c * o - s * u for o, u in zip(outwards, upwards)))
            positions.append(tuple(p + tube_radius * n for p, n in zip(centres[-1], normals[-1])))
    for i in range(segments):
        for k in range(sides):
            a, b = i * sides + k, i * sides + (k + 1) % sides
            triangles += [(a, a + sides, b + sides), (a, b + sides, b)]
    for ring, sign in ((0, -1), (segments, 1)):
        tip = len(positions)
        normals.append(tuple(sign * t for t in tangents[ring]))
        positions.append(tuple(p + tube_radius * n for p, n in zip(centres[ring], normals[-1])))
        for k in range(sides):
            edge = (ring * sides + k, ring * sides + (k + 1) % sides)
            triangles.append((tip, *edge[::-sign]))
    return positions, triangles, normals


def filleted(corners, steps=4, closed=False):
    """Makes a smooth outline in the half plane (r, y), as (r, y, normal r, normal y), from `corners` = (r, y, fillet
    radius). Its normals point to the left of its direction; unless it is `closed`, both end corners stay sharp."""
    def unit(a, b):
        return normalized((b[0] - a[0], b[1] - a[1]))

    def turned(v, angle):
        c, s = math.cos(angle), math.sin(angle)
        return c * v[0] - s * v[1], s * v[0] + c * v[1]

    outline = []
    count = len(corners)
    for i, (r, y, radius) in enumerate(corners):
        before = unit(corners[i - 1], corners[i]) if closed or i > 0 else unit(corners[0], corners[1])
        after = unit(corners[i], corners[(i + 1) % count]) if closed or i < count - 1 else before
        left = turned(before, math.pi / 2)
        turn = math.atan2(before[0] * after[1] - before[1] * after[0], before[0] * after[0] + before[1] * after[1])
        if abs(turn) < 1e-6:
            outline.append((r, y, *left))
            continue
        back, side = radius * math.tan(abs(turn) / 2), math.copysign(radius, turn)
        centre = (r - back * before[0] + side * left[0], y - back * before[1] + side * left[1])
        parts = steps if radius > 0 else 1
        for k in range(parts + 1):
            n = turned(left, turn * k / parts)
            outline.append((centre[0] - side * n[0], centre[1] - side * n[1], *n))
    return outline


def lathe(outline, segments, closed=False):
    """Rotates an outline of (r, y, normal r, normal y) around +y; r = 0 closes it at an end."""
    positions, normals, triangles = [], [], []
    for i in range(segments):
        s, c = math.sin(2 * math.pi * i / segments), math.cos(2 * math.pi * i / segments)
        positions += [(r * s, y, r * c) for r, y, _, _ in outline]
        normals += [(nr * s, ny, nr * c) for _, _, nr, ny in outline]
    count = len(outline)
    for i in range(segments):
        here, there = i * count, (i + 1) % segments * count
        for k in range(count if closed else count - 1):
            m = (k + 1) % count
            if outline[k][:2] == outline[m][:2]:
                continue  # the two normals of a sharp edge
            if outline[m][0] > 0:
                triangles.append((here + k, here + m, there + m))
            if outline[k][0] > 0:
                triangles.append((here + k, there + m, there + k))
    return positions, triangles, normals


def ring(inner, outer, height, fillet, segments):
    """Makes a ring that lies on the plane y = 0."""
    corners = [(r, y, fillet) for r, y in ((inner, 0), (inner, height), (outer, height), (outer, 0))]
    return lathe(filleted(corners, closed=True), segments, closed=True)
