"""Reads the glTF files of scenes/ as a Scene: one file with embedded data, float positions, 16 or 32 bit indices.

Where renderers define things differently, the scene is changed for all of them, and `Scene.changes` lists what."""

import base64
import json
import math
import pathlib
import struct
import sys

from scene import Camera, Material, Medium, Mesh, NotShared, PointLight, Scene

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scenes"))
from shapes import sphere

SMOOTH_ALPHA = 0.001  # smoother surfaces are perfectly specular, as in docs/gltf.md
SPHERE_SEGMENTS, SPHERE_RINGS = 32, 16  # resolution of sphere lights
IDENTITY = ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))


def multiplied(a, b):
    return tuple(tuple(sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)) for i in range(4))


def local_transform(node):
    """Returns the rows of the node's matrix."""
    if "matrix" in node:
        return tuple(tuple(node["matrix"][4 * j + i] for j in range(4)) for i in range(4))
    t, s = node.get("translation", (0, 0, 0)), node.get("scale", (1, 1, 1))
    x, y, z, w = node.get("rotation", (0, 0, 0, 1))
    rotation = ((1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
                (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
                (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)))
    return tuple(tuple(rotation[i][j] * s[j] for j in range(3)) + (t[i],) for i in range(3)) + (IDENTITY[3],)


def point_through(m, p):
    return tuple(m[i][0] * p[0] + m[i][1] * p[1] + m[i][2] * p[2] + m[i][3] for i in range(3))


def axis(m, j):
    """Returns the unit vector of column j."""
    length = math.hypot(*(m[i][j] for i in range(3)))
    return tuple(m[i][j] / length for i in range(3))


def determinant(m):
    (a, b, c, _), (d, e, f, _), (g, h, i, _) = m[:3]
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)


def medium(volume, scatter):
    """Converts KHR_materials_volume_scatter to a Medium, by the fit of Kulla and Conty (2017)."""
    distance = volume.get("attenuationDistance", math.inf)
    root = [4.09712 + 4.20863 * c - math.sqrt(9.59217 + 41.6808 * c + 17.7126 * c * c)
            for c in scatter.get("multiscatterColor", (0, 0, 0))]
    return Medium(tuple(-math.log(c) / distance for c in volume.get("attenuationColor", (1, 1, 1))),
                  tuple(min(max(1 - s * s, 0.0), 1.0) for s in root), scatter.get("scatterAnisotropy", 0.0))


class Reader:
    """Converts one file."""

    def __init__(self, text, name):
        self.json, self.name = json.loads(text), name
        self.materials, self.meshes, self.points, self.changes = [], [], [], []
        self.camera = None
        uri = self.json["buffers"][0].get("uri", "")
        if not uri.startswith("data:"):
            raise NotShared(f"{name}: its data is not embedded")
        self.buffer = base64.b64decode(uri.partition(",")[2])

    def changed(self, sentence):
        if sentence not in self.changes:
            self.changes.append(sentence)

    def accessor(self, index):
        accessor = self.json["accessors"][index]
        view = self.json["bufferViews"][accessor["bufferView"]]
        code = {5123: "H", 5125: "I", 5126: "f"}.get(accessor["componentType"])
        if code is None or "sparse" in accessor:
            raise NotShared(f"{self.name}: accessor {index} is of a kind that is not read")
        width = {"SCALAR": 1, "VEC3": 3}[accessor["type"]]
        layout = struct.Struct(f"<{width}{code}")
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        stride = view.get("byteStride", layout.size)
        rows = [layout.unpack_from(self.buffer, start + stride * i) for i in range(accessor["count"])]
        return [row[0] for row in rows] if width == 1 else rows

    def material(self, item):
        """Returns the Material; None if there is no equivalent."""
        name, pbr = item.get("name", "unnamed"), item.get("pbrMetallicRoughness", {})
        extensions = {key[14:]: value for key, value in item.get("extensions", {}).items()}
        color, alpha = tuple(pbr.get("baseColorFactor", (1, 1, 1, 1))[:3]), pbr.get("roughnessFactor", 1) ** 2
        alpha = alpha if alpha >= SMOOTH_ALPHA else 0.0
        metallic = pbr.get("metallicFactor", 1)
        transmission = extensions.get("transmission", {}).get("transmissionFactor", 0)
        strength = extensions.get("emissive_strength", {}).get("emissiveStrength", 1)
        emission = tuple(strength * e for e in item.get("emissiveFactor", (0, 0, 0)))
        emission = emission if any(emission) else None
        if any(key.endswith("Texture") for key in (*item, *pbr)) or item.get("alphaMode", "OPAQUE") != "OPAQUE" \
                or {"unlit", "diffuse_transmission"} & extensions.keys() or (emission and item.get("doubleSided")):
            return None
        if metallic == 1:
            if color != (1, 1, 1):
                self.changed(f"{name} reflects all light: only so are Schlick's metals those of the others")
            return Material(name, "metal", alpha=alpha, emission=emission)
        if metallic == 0 and transmission == 1 and extensions.get("volume", {}).get("thicknessFactor", 0) > 0:
            inside = medium(extensions["volume"], extensions["volume_scatter"]) if "volume_scatter" in extensions else None
            if color != (1, 1, 1) or ("attenuationDistance" in extensions["volume"] and not inside):
                self.changed(f"{name} is clear")
            return Material(name, "glass", alpha=alpha, ior=extensions.get("ior", {}).get("ior", 1.5),
                            emission=emission, inside=inside)
        if metallic or transmission:
            return None
        if extensions.get("specular", {}).get("specularFactor", 1) != 0:
            self.changed(f"{name} has no coat")
        return Material(name, "diffuse", color, emission=emission)

    def add_mesh(self, index, name, transform):
        for primitive in self.json["meshes"][index]["primitives"]:
            material = primitive.get("material")
            if material is None or self.materials[material] is None or primitive.get("mode", 4) != 4:
                what = name if material is None else self.json["materials"][material].get("name", name)
                self.changed(f"{what} is left out: not all renderers have it")
                continue
            positions = self.accessor(primitive["attributes"]["POSITION"])
            order = self.accessor(primitive["indices"]) if "indices" in primitive else range(len(positions))
            triangles = tuple(zip(*[iter(order)] * 3))
            if determinant(transform) < 0:  # keeps the front of mirrored meshes
                triangles = tuple((a, c, b) for a, b, c in triangles)
            if "NORMAL" in primitive["attributes"]:
                self.changed("all faces are flat: renderers differ about shading normals")
            self.meshes.append(Mesh(name, material,
                                    tuple(point_through(transform, p) for p in positions), triangles))

    def add_light(self, light, transform):
        position = point_through(transform, (0, 0, 0))
        intensity = tuple(light["intensity"] * c for c in light.get("color", (1, 1, 1)))
        name, radius = light.get("name", "light"), light.get("extras", {}).get("radius", 0)
        if light["type"] != "point":
            raise NotShared(f"{self.name}: {name} is a {light['type']} light")
        if not radius:
            self.points.append(PointLight(name, position, intensity))
            return
        radius *= abs(determinant(transform)) ** (1 / 3)
        emission = tuple(i / (math.pi * radius * radius) for i in intensity)
        self.changed(f"{name} is a sphere of triangles")
        self.materials.append(Material(name, "diffuse", (0.0, 0.0, 0.0), emission=emission))
        points, triangles, _ = sphere(SPHERE_SEGMENTS, SPHERE_RINGS, radius)
        positions = tuple(tuple(c + p for c, p in zip(position, point)) for point in points)
        self.meshes.append(Mesh(name, len(self.materials) - 1, positions, tuple(triangles)))

    def add_camera(self, camera, transform):
        if self.camera is not None:
            return
        if camera["type"] != "perspective":
            raise NotShared(f"{self.name}: its camera is not a perspective one")
        if camera.get("extras", {}).keys() & {"lensRadius", "fStop"}:
            self.changed("the camera is a pinhole")
        view = camera["perspective"]
        self.camera = Camera(point_through(transform, (0, 0, 0)), tuple(-c for c in axis(transform, 2)),
                             axis(transform, 1), view["yfov"], view.get("aspectRatio", 1.0))

    def visit(self, index, parent):
        node = self.json["nodes"][index]
        transform = multiplied(parent, local_transform(node))
        if "mesh" in node:
            self.add_mesh(node["mesh"], node.get("name", f"node {index}"), transform)
        if "camera" in node:
            self.add_camera(self.json["cameras"][node["camera"]], transform)
        light = node.get("extensions", {}).get("KHR_lights_punctual")
        if light:
            lights = self.json["extensions"]["KHR_lights_punctual"]["lights"]
            self.add_light(lights[light["light"]], transform)
        for child in node.get("children", ()):
            self.visit(child, transform)

    def read(self):
        self.materials = [self.material(item) for item in self.json.get("materials", ())]
        scene = self.json["scenes"][self.json.get("scene", 0)]
        for root in scene["nodes"]:
            self.visit(root, IDENTITY)
        used = {mesh.material: self.materials[mesh.material] for mesh in self.meshes}
        if self.camera is None:
            raise NotShared(f"{self.name}: it has no camera")
        if not self.points and not any(material.emission for material in used.values()):
            raise NotShared(f"{self.name}: it has no light that all renderers have")
        order = {old: new for new, old in enumerate(sorted(used))}
        meshes = tuple(Mesh(m.name, order[m.material], m.positions, m.triangles) for m in self.meshes)
        return Scene(scene.get("name", self.name), tuple(used[old] for old in sorted(used)), meshes,
                     tuple(self.points), self.camera, tuple(self.changes))


def read(path):
    """Returns the Scene of a file. Raises NotShared, with the reason, if not all renderers can show it."""
    try:
        return Reader(path.read_text(encoding="utf-8"), path.name).read()
    except (ValueError, LookupError, TypeError, struct.error) as error:
        raise NotShared(f"{path.name}: it cannot be read: {error!r}") from error
