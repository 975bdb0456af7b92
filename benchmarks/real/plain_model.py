"""Reads glTF models with numpy: decodes EXT_meshopt_compression, for programs that cannot, and lists world-space
triangles with their materials. Needs meshoptimizer for compressed models."""

import base64
import dataclasses
import io
import json
import pathlib
import struct
import urllib.parse

import numpy as np

COMPONENTS = {5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
MESHOPT = "EXT_meshopt_compression"
GLB_MAGIC, JSON_CHUNK, BINARY_CHUNK = 0x46546C67, 0x4E4F534A, 0x004E4942


@dataclasses.dataclass
class Piece:
    """One primitive of one node, in world space."""

    positions: np.ndarray
    normals: np.ndarray | None
    uvs: np.ndarray | None
    triangles: np.ndarray
    material: int | None


def decode_meshopt(block, data):
    """Returns the bytes of one compressed buffer view. Filters are unsupported: no model here uses them."""
    import meshoptimizer
    if block.get("filter", "NONE") != "NONE":
        raise ValueError(f"filter {block['filter']} of {MESHOPT} is unsupported")
    count, stride = block["count"], block["byteStride"]
    if block["mode"] == "ATTRIBUTES":
        return meshoptimizer.decode_vertex_buffer(count, stride, data).tobytes()
    decode = {"TRIANGLES": meshoptimizer.decode_index_buffer, "INDICES": meshoptimizer.decode_index_sequence}
    return decode[block["mode"]](count, stride, data).tobytes()[:count * stride]  # packed, even in an array of uint32


class Model:
    """A glTF file with all buffer views as bytes."""

    def __init__(self, path):
        self.path = pathlib.Path(path)
        data = self.path.read_bytes()
        binary = b""
        if data[:4] == b"glTF":
            length = struct.unpack_from("<I", data, 12)[0]
            self.document, binary = json.loads(data[20:20 + length]), data[28 + length:]
        else:
            self.document = json.loads(data)
        buffers = [self._read_uri(b["uri"]) if "uri" in b else binary if i == 0 else b""
                   for i, b in enumerate(self.document.get("buffers", []))]
        self.views = [self._read_view(view, buffers) for view in self.document.get("bufferViews", [])]

    def _read_uri(self, uri):
        if uri.startswith("data:"):
            return base64.b64decode(uri.partition(",")[2])
        return (self.path.parent / urllib.parse.unquote(uri)).read_bytes()

    @staticmethod
    def _read_view(view, buffers):
        block = view.get("extensions", {}).get(MESHOPT)
        source = block or view
        start = source.get("byteOffset", 0)
        data = buffers[source["buffer"]][start:start + source["byteLength"]]
        return decode_meshopt(block, data) if block else data

    @property
    def is_compressed(self):
        return MESHOPT in self.document.get("extensionsUsed", [])

    def write_plain(self, path):
        """Writes a .glb without compression. Images must be in buffer views."""
        document = json.loads(json.dumps(self.document))
        binary = bytearray()
        for view, data in zip(document["bufferViews"], self.views):
            view.pop("extensions", None)
            view.update(buffer=0, byteOffset=len(binary), byteLength=len(data))
            binary += data + bytes(-len(data) % 4)
        document["buffers"] = [{"byteLength": len(binary)}]
        for key in ("extensionsUsed", "extensionsRequired"):
            document[key] = [name for name in document.get(key, []) if name != MESHOPT]
            if not document[key]:
                del document[key]
        text = json.dumps(document).encode()
        text += b" " * (-len(text) % 4)
        with open(path, "wb") as file:
            file.write(struct.pack("<5I", GLB_MAGIC, 2, 28 + len(text) + len(binary), len(text), JSON_CHUNK))
            file.write(text + struct.pack("<2I", len(binary), BINARY_CHUNK) + binary)

    def accessor(self, index):
        """Returns the values of an accessor, one row for each element. Sparse accessors are unsupported."""
        described = self.document["accessors"][index]
        kind, width = np.dtype(COMPONENTS[described["componentType"]]), WIDTHS[described["type"]]
        view = self.document["bufferViews"][described["bufferView"]]
        stride = view.get("byteStride", 0) or kind.itemsize * width
        values = np.ndarray((described["count"], width), kind, self.views[described["bufferView"]],
                            described.get("byteOffset", 0), (stride, kind.itemsize))
        if described.get("normalized"):
            return np.maximum(values.astype(np.float32) / np.iinfo(kind).max, -1)
        return values.copy()

    def image(self, texture):
        """Returns the 8-bit R G B A pixels of a texture."""
        from PIL import Image
        described = self.document["images"][self.document["textures"][texture]["source"]]
        data = self._read_uri(described["uri"]) if "uri" in described else self.views[described["bufferView"]]
        return np.asarray(Image.open(io.BytesIO(data)).convert("RGBA"))

    def material(self, index):
        return {} if index is None else self.document["materials"][index]

    def pieces(self):
        """Yields all triangles of the scene, those of each primitive together."""
        document = self.document
        for root in document["scenes"][document.get("scene", 0)]["nodes"]:
            yield from self._pieces_below(root, np.eye(4))

    def _pieces_below(self, index, parent):
        node = self.document["nodes"][index]
        world = parent @ local_transform(node)
        for primitive in self.document["meshes"][node["mesh"]]["primitives"] if "mesh" in node else ():
            if primitive.get("mode", 4) == 4:
                yield self._piece(primitive, world)
        for child in node.get("children", ()):
            yield from self._pieces_below(child, world)

    def _piece(self, primitive, world):
        attributes = primitive["attributes"]
        positions = self.accessor(attributes["POSITION"]) @ world[:3, :3].T + world[:3, 3]
        normals = uvs = None
        if "NORMAL" in attributes:
            normals = self.accessor(attributes["NORMAL"]) @ np.linalg.inv(world[:3, :3])
            normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-20)
        material = primitive.get("material")
        uv_set = self.material(material).get("pbrMetallicRoughness", {}).get("baseColorTexture", {}).get("texCoord", 0)
        if f"TEXCOORD_{uv_set}" in attributes:
            uvs = self.accessor(attributes[f"TEXCOORD_{uv_set}"])
        indices = self.accessor(primitive["indices"])[:, 0] if "indices" in primitive else np.arange(len(positions))
        triangles = indices.astype(np.int32).reshape(-1, 3)
        if np.linalg.det(world[:3, :3]) < 0:
            triangles = triangles[:, ::-1]
        a, b, c = (positions[triangles[:, k]] for k in range(3))
        has_area = np.linalg.norm(np.cross(b - a, c - a), axis=1) > 0
        return Piece(positions, normals, uvs, triangles[has_area], material)


def local_transform(node):
    if "matrix" in node:
        return np.array(node["matrix"], float).reshape(4, 4).T
    result = np.eye(4)
    x, y, z, w = node.get("rotation", (0, 0, 0, 1))
    result[:3, :3] = np.array(((1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
                               (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
                               (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y))))
    result[:3, :3] *= node.get("scale", (1, 1, 1))
    result[:3, 3] = node.get("translation", (0, 0, 0))
    return result
