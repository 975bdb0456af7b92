"""Writes glTF 2.0 files: a list of meshes, materials, lights and nodes, with all data in one embedded buffer.

The output is a pure function of the calls: every number is rounded before it is written, so that the last bits of sines
do not depend on the machine.
"""

import base64
import json
import math
import struct

DIGITS = 7  # number of decimals: resolves 0.1 micrometre


def rounded(value):
    """Rounds a float, or a nested sequence of them, to DIGITS decimals without negative zeros."""
    if isinstance(value, (list, tuple)):
        return [rounded(item) for item in value]
    result = round(float(value), DIGITS) + 0.0
    return int(result) if result == int(result) else result


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def normalized(a):
    length = math.sqrt(sum(x * x for x in a))
    return tuple(x / length for x in a)


def rotation_about(axis, degrees):
    """Returns a unit quaternion (x, y, z, w)."""
    half = math.radians(degrees) / 2
    x, y, z = normalized(axis)
    return (x * math.sin(half), y * math.sin(half), z * math.sin(half), math.cos(half))


def rotation_towards(direction, up=(0, 1, 0)):
    """Returns the quaternion that turns -z, along which cameras and lights look, to `direction` and keeps +y on the
    side of `up`."""
    z = normalized(tuple(-x for x in direction))
    x = normalized(cross(up, z))
    y = cross(z, x)
    m = [[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]]
    # Divides by the component with the largest square, so nothing cancels.
    squares = (1 + m[0][0] - m[1][1] - m[2][2], 1 - m[0][0] + m[1][1] - m[2][2],
               1 - m[0][0] - m[1][1] + m[2][2], 1 + m[0][0] + m[1][1] + m[2][2])
    best = max(range(4), key=lambda i: squares[i])
    s = math.sqrt(squares[best]) * 2
    sums = {(0, 1): m[0][1] + m[1][0], (0, 2): m[0][2] + m[2][0], (1, 2): m[1][2] + m[2][1],
            (0, 3): m[2][1] - m[1][2], (1, 3): m[0][2] - m[2][0], (2, 3): m[1][0] - m[0][1]}
    return tuple(s / 4 if i == best else sums[min(i, best), max(i, best)] / s for i in range(4))


class Gltf:
    def __init__(self, title):
        self.buffer = bytearray()
        self.lights = []
        self.profiles = []
        self.extensions = set()
        self.json = {
            "asset": {"version": "2.0", "generator": "bdpt scenes/make_scenes.py"},
            "scene": 0,
            "scenes": [{"name": title, "nodes": []}],
            "nodes": [], "cameras": [], "materials": [], "meshes": [], "textures": [], "images": [], "samplers": [],
            "accessors": [], "bufferViews": [], "skins": [], "animations": [],
        }

    def _append(self, key, item):
        self.json[key].append(item)
        return len(self.json[key]) - 1

    def _view(self, data, **properties):
        self.buffer += bytes(-len(self.buffer) % 4)
        view = self._append("bufferViews", {"buffer": 0, "byteOffset": len(self.buffer), "byteLength": len(data),
                                            **properties})
        self.buffer += data
        return view

    def _accessor(self, data, target, description):
        view = self._view(data, target=target)
        return self._append("accessors", {"bufferView": view, **description})

    def _vectors(self, values, bounds=False):
        packed = b"".join(struct.pack(f"<{len(v)}f", *rounded(v)) for v in values)
        description = {"componentType": 5126, "count": len(values), "type": f"VEC{len(values[0])}"}
        if bounds:
            floats = list(struct.iter_unpack("<3f", packed))
            description["min"] = [min(f[i] for f in floats) for i in range(3)]
            description["max"] = [max(f[i] for f in floats) for i in range(3)]
        return self._accessor(packed, 34962, description)

    def shape(self, positions, triangles, normals=None, uvs=None, targets=(), joints=None):
        """Stores geometry; the result may serve several meshes. Without normals the faces are flat. `targets` has the
        displacements of all positions, one list for each morph target. `joints` has the weights of up to four joints of
        a skin, for each vertex."""
        assert len(positions) <= 65535
        attributes = {"POSITION": self._vectors(positions, bounds=True)}
        if normals:
            attributes["NORMAL"] = self._vectors([normalized(n) for n in normals])
        if uvs:
            attributes["TEXCOORD_0"] = self._vectors(uvs)
        if joints:
            numbers = bytes(i for weights in joints for i in (*range(len(weights)), 0, 0, 0, 0)[:4])
            attributes["JOINTS_0"] = self._accessor(numbers, 34962, {"componentType": 5121, "count": len(joints),
                                                                     "type": "VEC4"})
            attributes["WEIGHTS_0"] = self._vectors([(*weights, 0, 0, 0, 0)[:4] for weights in joints])
        indices = b"".join(struct.pack("<3H", *t) for t in triangles)
        morph = {"targets": [{"POSITION": self._vectors(target, bounds=True)} for target in targets]} if targets else {}
        return {"attributes": attributes, **morph,
                "indices": self._accessor(indices, 34963, {"componentType": 5123, "count": 3 * len(triangles),
                                                           "type": "SCALAR"})}

    def mesh(self, name, *parts):
        """Adds a mesh of (shape, material) pairs."""
        return self._append("meshes", {"name": name, "primitives": [{**shape, "material": material}
                                                                    for shape, material in parts]})

    def texture(self, name, png):
        """Adds an embedded PNG file, clamped at its edges."""
        image = self._append("images", {"name": name, "mimeType": "image/png", "bufferView": self._view(png)})
        clamped = self._append("samplers", {"magFilter": 9729, "minFilter": 9729, "wrapS": 33071, "wrapT": 33071})
        return self._append("textures", {"name": name, "source": image, "sampler": clamped})

    def material(self, name, color, metallic=0.0, roughness=1.0, emission=None, extensions=None, double_sided=False,
                 texture=None, emission_texture=None, alpha=1.0, **more):
        """Adds a material. `emission` is a radiance in nit; the textures multiply `color` with `alpha` and `emission`.
        `extensions` maps the names of KHR_materials_* to their properties; `more` are properties of the glTF
        material."""
        extensions = dict(extensions or {})
        material = {"name": name, "pbrMetallicRoughness": {"baseColorFactor": rounded((*color, alpha)),
                                                           "metallicFactor": rounded(metallic),
                                                           "roughnessFactor": rounded(roughness)}, **more}
        if texture is not None:
            material["pbrMetallicRoughness"]["baseColorTexture"] = {"index": texture}
        if emission_texture is not None:
            material["emissiveTexture"] = {"index": emission_texture}
        if emission:
            strength = max(emission)
            material["emissiveFactor"] = rounded([e / strength for e in emission])
            extensions["emissive_strength"] = {"emissiveStrength": rounded(strength)}
        if extensions:
            material["extensions"] = {"KHR_materials_" + name: value for name, value in extensions.items()}
            self.extensions.update(material["extensions"])
        if double_sided:
            material["doubleSided"] = True
        return self._append("materials", material)

    def lambertian(self, name, color, **more):
        """Adds a diffuse material without the dielectric coat of glTF materials: specularFactor 0."""
        return self.material(name, color, extensions={"specular": {"specularFactor": 0}}, **more)

    def node(self, name, translation=None, rotation=None, scale=None, parent=None, **content):
        node = {"name": name}
        for key, value in (("translation", translation), ("rotation", rotation), ("scale", scale)):
            if value is not None:
                node[key] = rounded(value)
        node.update(content)
        index = self._append("nodes", node)
        if parent is None:
            self.json["scenes"][0]["nodes"].append(index)
        else:
            self.json["nodes"][parent].setdefault("children", []).append(index)
        return index

    def skin(self, name, joints):
        """Adds a skin. Joints are nodes; the skin is at rest while they and the mesh keep their initial transforms. The
        mesh is then in the space of the joints, whose transforms are the identity."""
        return self._append("skins", {"name": name, "joints": list(joints)})

    def animate(self, node, path, keys, interpolation="LINEAR"):
        """Adds a channel to the only animation. `keys` are (second, value) pairs; with CUBICSPLINE (second, in-tangent,
        value, out-tangent). `path` is translation, rotation, scale, or weights of one morph target."""
        if not self.json["animations"]:
            self.json["animations"].append({"name": "action", "channels": [], "samplers": []})
        animation = self.json["animations"][0]
        times = [key[0] for key in keys]
        values = [value for key in keys for value in key[1:]]
        width = len(values[0]) if path != "weights" else 1
        floats = [number for value in values for number in (value if path != "weights" else (value,))]
        packed = [b"".join(struct.pack("<f", number) for number in rounded(numbers)) for numbers in (times, floats)]
        bounds = [struct.unpack("<f", struct.pack("<f", rounded(t)))[0] for t in (min(times), max(times))]
        accessors = (self._append("accessors", {"bufferView": self._view(packed[0]), "componentType": 5126,
                                                "count": len(times), "type": "SCALAR", "min": bounds[:1],
                                                "max": bounds[1:]}),
                     self._append("accessors", {"bufferView": self._view(packed[1]), "componentType": 5126,
                                                "count": len(values), "type": "SCALAR" if width == 1 else f"VEC{width}"}))
        animation["samplers"].append({"input": accessors[0], "output": accessors[1], "interpolation": interpolation})
        animation["channels"].append({"sampler": len(animation["samplers"]) - 1,
                                      "target": {"node": node, "path": path}})

    def camera(self, position, direction, vertical_fov, aspect_ratio, name="camera", lens=None):
        """Adds a camera. `vertical_fov` is in radians. `lens` is (radius, focus distance) of a thin lens [m]; without
        it the camera is a pinhole."""
        extras = {"extras": {"lensRadius": rounded(lens[0]), "focusDistance": rounded(lens[1])}} if lens else {}
        camera = self._append("cameras", {"name": name, "type": "perspective", "perspective": {
            "yfov": rounded(vertical_fov), "aspectRatio": rounded(aspect_ratio), "znear": 0.001}, **extras})
        return self.node(name, position, rotation_towards(direction), camera=camera)

    def orthographic_camera(self, position, direction, width, height, name="camera"):
        """Adds a camera with parallel projection of a rectangle of `width` times `height` [m]."""
        camera = self._append("cameras", {"name": name, "type": "orthographic", "orthographic": {
            "xmag": rounded(width / 2), "ymag": rounded(height / 2), "znear": 0.001, "zfar": 1000}})
        return self.node(name, position, rotation_towards(direction), camera=camera)

    def light(self, name, kind, intensity, color=(1, 1, 1), position=None, direction=None, **properties):
        """Adds a light of KHR_lights_punctual; `intensity` is in candela (point, spot) or lux (directional)."""
        self.lights.append({"name": name, "type": kind, "color": rounded(color), "intensity": rounded(intensity),
                            **properties})
        self.extensions.add("KHR_lights_punctual")
        rotation = rotation_towards(direction, up=(0, 0, -1)) if direction else None
        return self.node(name, position, rotation,
                         extensions={"KHR_lights_punctual": {"light": len(self.lights) - 1}})

    def profile_lights(self, name, text, color, places):
        """Adds one light for each (position, direction, up), with the text of one IES file [EXT_lights_ies]."""
        data = base64.b64encode(text.encode("ascii")).decode("ascii")
        self.profiles.append({"name": name, "uri": "data:application/x-ies-lm-63;base64," + data})
        self.extensions.add("EXT_lights_ies")
        for position, direction, up in places:
            self.node(name, position, rotation_towards(direction, up), extensions={"EXT_lights_ies": {
                "light": len(self.profiles) - 1, "color": rounded(color)}})

    def sphere_light(self, name, intensity, radius, position, color=(1, 1, 1)):
        """Adds a sphere of radiance intensity / (pi radius^2); `intensity` is in candela."""
        return self.light(name, "point", intensity, color, position, extras={"radius": rounded(radius)})

    def text(self):
        """Returns the file's text."""
        result = {key: value for key, value in self.json.items() if value != []}
        if self.extensions:
            result["extensionsUsed"] = sorted(self.extensions)
        for name, lights in (("KHR_lights_punctual", self.lights), ("EXT_lights_ies", self.profiles)):
            if lights:
                result.setdefault("extensions", {})[name] = {"lights": lights}
        data = base64.b64encode(bytes(self.buffer)).decode("ascii")
        result["buffers"] = [{"byteLength": len(self.buffer), "uri": "data:application/octet-stream;base64," + data}]
        return json.dumps(result, indent=1) + "\n"
