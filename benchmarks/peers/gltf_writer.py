"""Writes a Scene as glTF, so that bdpt renders what the others do."""

import math
import pathlib
import sys

from scene import Mesh

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scenes"))
from gltf_builder import Gltf

MOST_VERTICES = 65535  # of one shape


def glass(material):
    return {"transmission": {"transmissionFactor": 1}, "ior": {"ior": material.ior}, "volume": {"thicknessFactor": 1}}


def add_material(gltf, material):
    """Its index."""
    roughness = math.sqrt(material.alpha)
    if material.kind == "diffuse":
        return gltf.lambertian(material.name, material.color, emission=material.emission)
    if material.kind == "metal":
        return gltf.material(material.name, (1, 1, 1), metallic=1, roughness=roughness, emission=material.emission)
    return gltf.material(material.name, (1, 1, 1), roughness=roughness, emission=material.emission,
                         extensions=glass(material))


def pieces(mesh):
    """The mesh in parts that have few enough vertices."""
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
    for mesh in (piece for whole in scene.meshes for piece in pieces(whole)):
        shape = gltf.shape(mesh.positions, mesh.triangles)
        gltf.node(mesh.name, mesh=gltf.mesh(mesh.name, (shape, indices[mesh.material])))
    for point in scene.points:
        candela = max(point.intensity)
        gltf.light(point.name, "point", candela, [i / candela for i in point.intensity], point.position)
    camera = scene.camera
    gltf.camera(camera.position, camera.direction, camera.vertical_fov, camera.aspect_ratio)
    path.write_text(gltf.text(), encoding="utf-8")
