"""Reads OpenEXR files as the command writes them: one part, scan lines, uncompressed or ZIP."""

import struct
import zlib

import numpy as np

MAGIC = 20000630
UNSUPPORTED = 0x1A00  # flags of tiles, deep data and multiple parts
ROWS_OF_CHUNK = {0: 1, 2: 1, 3: 16}  # by compression: none, ZIPS, ZIP
DTYPES = {0: "<u4", 1: "<f2", 2: "<f4"}


class Exr:
    """Holds the channels by name as arrays of (height, width), row 0 on top, and the text attributes by name."""

    def __init__(self, file):
        with open(file, "rb") as stream:
            data = stream.read()
        magic, version = struct.unpack_from("<II", data)
        if magic != MAGIC or version & UNSUPPORTED:
            raise ValueError(f"{file}: not an OpenEXR file of scan lines")
        attributes, start = self._attributes(data, 8)
        self.texts = {name: value.decode() for name, (kind, value) in attributes.items() if kind == "string"}
        x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"][1])
        self.x, self.y, self.width, self.height = x0, y0, x1 - x0 + 1, y1 - y0 + 1
        compression = attributes["compression"][1][0]
        if compression not in ROWS_OF_CHUNK:
            raise ValueError(f"{file}: compression {compression} is not supported")
        self._kinds = dict(self._channel_list(attributes["channels"][1]))
        self.channels = {name: np.empty((self.height, self.width), DTYPES[kind]) for name, kind in self._kinds.items()}
        rows = ROWS_OF_CHUNK[compression]
        for offset in struct.unpack_from(f"<{-(-self.height // rows)}Q", data, start):
            self._read_chunk(data, offset, rows, compression)

    @staticmethod
    def _attributes(data, at):
        """Returns the attributes, name -> (type, bytes), and the offset where the header ends."""
        attributes = {}
        while data[at] != 0:
            name, kind = data[at:data.index(b"\0", at)], None
            at += len(name) + 1
            kind = data[at:data.index(b"\0", at)]
            at += len(kind) + 1
            size, = struct.unpack_from("<i", data, at)
            attributes[name.decode()] = (kind.decode(), data[at + 4:at + 4 + size])
            at += 4 + size
        return attributes, at + 1

    @staticmethod
    def _channel_list(data):
        at = 0
        while data[at] != 0:
            end = data.index(b"\0", at)
            yield data[at:end].decode(), struct.unpack_from("<i", data, end + 1)[0]
            at = end + 17  # skips type, linearity, three unused bytes and two sampling rates

    def _read_chunk(self, data, offset, rows, compression):
        y, size = struct.unpack_from("<ii", data, offset)
        packed = data[offset + 8:offset + 8 + size]
        first = y - self.y
        rows = min(rows, self.height - first)
        length = rows * self.width * sum(np.dtype(DTYPES[kind]).itemsize for kind in self._kinds.values())
        # A chunk that compression would enlarge is stored uncompressed.
        raw = packed if compression == 0 or size == length else undo_zip(packed)
        at = 0
        for row in range(first, first + rows):
            for name, pixels in self.channels.items():
                pixels[row] = np.frombuffer(raw, pixels.dtype, self.width, at)
                at += pixels[row].nbytes

    def pixels(self, names, fill=None):
        """Returns an array of (height, width, channels), float32. Missing channels get `fill`; without one they raise
        an error."""
        image = np.empty((self.height, self.width, len(names)), np.float32)
        for i, name in enumerate(names):
            image[..., i] = self.channels[name] if fill is None else self.channels.get(name, fill)
        return image


def undo_zip(packed):
    """Undoes deflate, differences of bytes, and the split into even and odd bytes [OpenEXR file layout]."""
    differences = np.frombuffer(zlib.decompress(packed), np.uint8).astype(np.int64)
    differences[1:] -= 128
    split = np.cumsum(differences).astype(np.uint8)
    raw = np.empty_like(split)
    half = (len(split) + 1) // 2
    raw[0::2], raw[1::2] = split[:half], split[half:]
    return raw.tobytes()
