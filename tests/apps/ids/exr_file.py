"""Reads OpenEXR files of scan lines or tiles with ZIP compression, independently of our code, by the format
description."""

import array
import struct
import sys
import zlib

LINES = 16  # lines of a ZIP block
SIZES = {0: 4, 1: 2, 2: 4}  # bytes of uint, half and float


def read_text(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def undo_zip(block, size):
    """Undoes ZIP: even and odd bytes are split, and each is the difference to the one before."""
    if len(block) == size:
        return block
    raw = bytearray(zlib.decompress(block))
    for i in range(1, len(raw)):
        raw[i] = (raw[i - 1] + raw[i] - 128) & 255
    result = bytearray(size)
    half = (size + 1) // 2
    result[0::2], result[1::2] = raw[:half], raw[half:]
    return bytes(result)


class ExrFile:
    """Holds `attributes` (bytes by name), `text(name)`, `channels` (name to type), and `values[name]`, a list of
    rows."""

    def __init__(self, path):
        data = path.read_bytes()
        magic, version = struct.unpack_from("<ii", data)
        assert magic == 20000630 and version & 0xff == 2
        self.tiled = bool(version & 0x200)
        assert version & ~0x7ff == 0, "one part of flat pixels"
        self.attributes, at = {}, 8
        while data[at]:
            name, at = read_text(data, at)
            _, at = read_text(data, at)
            size = struct.unpack_from("<i", data, at)[0]
            self.attributes[name] = data[at + 4:at + 4 + size]
            at += 4 + size
        assert self.attributes["compression"][0] == 3, "ZIP"
        self._read_channels()
        x0, y0, x1, y1 = struct.unpack("<4i", self.attributes["dataWindow"])
        self.origin, self.width, self.height = (x0, y0), x1 - x0 + 1, y1 - y0 + 1
        self.values = {name: [None] * self.height for name in self.channels}
        if self.tiled:
            self.values = {name: [array.array("f", bytes(4 * self.width)) for _ in range(self.height)] for name in self.channels}
        self._read_blocks(data, at + 1)

    def text(self, name):
        return self.attributes[name].decode()

    def _read_channels(self):
        data, at, self.channels = self.attributes["channels"], 0, {}
        while data[at]:
            name, at = read_text(data, at)
            self.channels[name] = struct.unpack_from("<i", data, at)[0]
            at += 16

    def _read_blocks(self, data, at):
        if self.tiled:
            wide, high = struct.unpack_from("<ii", self.attributes["tiles"])
            count = -(-self.width // wide) * -(-self.height // high)
        else:
            count = -(-self.height // LINES)
        for place in struct.unpack_from(f"<{count}Q", data, at):
            if self.tiled:
                column, row, _, _, size = struct.unpack_from("<5i", data, place)
                x, y, place = column * wide, row * high, place + 20
                columns, lines = min(wide, self.width - x), min(high, self.height - y)
            else:
                line, size = struct.unpack_from("<ii", data, place)
                x, y, place = 0, line - self.origin[1], place + 8
                columns, lines = self.width, min(LINES, self.height - y)
            self._read_block(data[place:place + size], x, y, columns, lines)

    def _read_block(self, block, x, y, columns, lines):
        raw, at = undo_zip(block, lines * columns * sum(SIZES[kind] for kind in self.channels.values())), 0
        for row in range(y, y + lines):
            for name, kind in self.channels.items():  # channels are sorted by name
                size = columns * SIZES[kind]
                values = array.array("f", raw[at:at + size]) if kind == 2 else \
                    array.array("f", struct.unpack(f"<{columns}e", raw[at:at + size]))
                if sys.byteorder == "big" and kind == 2:
                    values.byteswap()
                if self.tiled:
                    self.values[name][row][x:x + columns] = values
                else:
                    self.values[name][row] = values
                at += size
