"""Triangle shapes as (positions, triangles) or (positions, triangles, normals); fronts are counter-clockwise."""

import math

from gltf_builder import cross, normalized


def quads(*corners_of_each):
    """Flat quadrilaterals, each given by its four corners counter-clockwise as seen from its front."""
    positions, triangles = [], []
    for corners in corners_of_each:
        first = len(positions)
        positions += corners
        triangles += [(first, first + 1, first + 2), (first, first + 2, first + 3)]
    return positions, triangles


def flipped(quad):
    return tuple(reversed(quad))


def box_quads(low, high, sides="-x+x-y+y-z+z"):
    """The chosen sides of an axis-aligned box, fronts outwards."""
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


def sphere(segments, rings, radius=1.0):
    """About the origin, closed, with the normals of the true sphere."""
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
    """A square of `cells` by `cells` about the origin: its positions follow the function `height(x, z)`, its normals
    the function `shading_height(x, z)`."""
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
    """A tube along a right-handed helix about +y, closed at both ends by a point: a shape that its mirror image
    differs from."""
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
