"""Writes a Scene as glTF, so that bdpt renders the same scene as the others."""

import math
import pathlib
import sys

from scene import Mesh

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scenes"))
from gltf_builder import Gltf

MOST_VERTICES = 65535  # limit of one shape


def multiscatter(albedo):
    """Returns the colour for which the fit of Kulla and Conty (2017) gives that albedo: s = 4.09712 + 4.20863 c -
    root(c), with 1 - s^2 = albedo, solved for c."""
    known = 4.09712 - math.sqrt(1 - albedo)
    # (known + 4.20863 c)^2 = 9.59217 + 41.6808 c + 17.7126 c^2, whose quadratic term nearly vanishes
    a, b, c = 4.20863 ** 2 - 17.7126, 2 * 4.20863 * known - 41.6808, known * known - 9.59217
    return min(max(2 * c / (math.sqrt(b * b - 4 * a * c) - b), 0.0), 1.0)


def glass(material):
    """Returns the glTF extensions of a glass material."""
    volume, scatter = {"thicknessFactor": 1}, {}
    if material.inside:
        distance = 1 / max(*material.inside.extinction, 1e-9)  # so that no colour is too dark
        volume.update({"attenuationDistance": distance,
                       "attenuationColor": [math.exp(-e * distance) for e in material.inside.extinction]})
        scatter = {"volume_scatter": {"multiscatterColor": [multiscatter(a) for a in material.inside.albedo],
                                      "scatterAnisotropy": material.inside.anisotropy}}
    return {"transmission": {"transmissionFactor": 1}, "ior": {"ior": material.ior}, "volume": volume, **scatter}


def add_material(gltf, material):
    """Adds a material; returns its index."""
    roughness = math.sqrt(material.alpha)
    if material.kind == "diffuse":
        return gltf.lambertian(material.name, material.color, emission=material.emission)
    if material.kind == "metal":
        return gltf.material(material.name, (1, 1, 1), metallic=1, roughness=roughness, emission=material.emission)
    return gltf.material(material.name, (1, 1, 1), roughness=roughness, emission=material.emission,
                         extensions=glass(material))


def split_mesh(mesh):
    """Splits the mesh into parts of at most MOST_VERTICES vertices."""
    if len(mesh.positions) <= MOST_VERTICES:
        return [mesh]
    result, step = [], MOST_VERTICES // 3
    for start in range(0, len(mesh.triangles), step):
        corners = [mesh.positions[i] for triangle in mesh.triangles[start:start + step] for i in triangle]
        result.append(Mesh(mesh.name, mesh.material, corners, tuple(zip(*[iter(range(len(corners)))] * 3))))
    return result


def write(scene, path):
    gltf = Gltf(scene.title)
    indices = [add_material(gltf, material) for material in scene.materials]
    for mesh in (piece for whole in scene.meshes for piece in split_mesh(whole)):
        shape = gltf.shape(mesh.positions, mesh.triangles)
        gltf.node(mesh.name, mesh=gltf.mesh(mesh.name, (shape, indices[mesh.material])))
    for point in scene.points:
        candela = max(point.intensity)
        gltf.light(point.name, "point", candela, [i / candela for i in point.intensity], point.position)
    camera = scene.camera
    gltf.camera(camera.position, camera.direction, camera.vertical_fov, camera.aspect_ratio)
    path.write_text(gltf.text(), encoding="utf-8")
