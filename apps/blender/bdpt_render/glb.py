"""Reads and writes GLB files: the document as a dictionary, and its binary buffer. Both can be extended."""

import json
import pathlib
import struct

import numpy as np

JSON_CHUNK, BIN_CHUNK = 0x4E4F534A, 0x004E4942
FLOAT, UNSIGNED_INT = 5126, 5125


class Glb:
    def __init__(self, file):
        data = pathlib.Path(file).read_bytes()
        length, = struct.unpack_from("<I", data, 12)
        self.document = json.loads(data[20:20 + length])
        self.binary = bytearray(data[28 + length:])

    @classmethod
    def empty(cls):
        glb = cls.__new__(cls)
        glb.document, glb.binary = {"asset": {"version": "2.0"}}, bytearray()
        return glb

    def add(self, kind, item):
        """Appends an item to the list `kind` of the document and returns its index."""
        items = self.document.setdefault(kind, [])
        items.append(item)
        return len(items) - 1

    def use(self, extension):
        used = self.document.setdefault("extensionsUsed", [])
        if extension not in used:
            used.append(extension)

    def add_accessor(self, values):
        """Adds floats or unsigned integers of the shape (n) or (n, components)."""
        values = np.ascontiguousarray(values)
        self.binary += bytes(-len(self.binary) % 4)
        view = self.add("bufferViews", {"buffer": 0, "byteOffset": len(self.binary), "byteLength": values.nbytes})
        self.binary += values.tobytes()
        rows = values.reshape(len(values), -1)
        return self.add("accessors", {
            "bufferView": view, "componentType": FLOAT if values.dtype == np.float32 else UNSIGNED_INT,
            "count": len(rows), "type": {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}[rows.shape[1]],
            "min": rows.min(axis=0).tolist(), "max": rows.max(axis=0).tolist()})

    def write(self, file):
        if self.binary:
            self.binary += bytes(-len(self.binary) % 4)
            self.document["buffers"] = [{"byteLength": len(self.binary)}]
        text = json.dumps(self.document, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<II", len(text), JSON_CHUNK) + text
        if self.binary:
            chunks += struct.pack("<II", len(self.binary), BIN_CHUNK) + self.binary
        pathlib.Path(file).write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)
