"""Reads the OpenEXR files that bdpt writes, bit by bit: one part, scanlines, no compression or ZIP.

Python's standard library has no OpenEXR module, and a module that converts pixels could hide differences.
"""

import dataclasses
import struct
import zlib

MAGIC = 20000630
TILED = 0x200
LINES = {0: 1, 2: 1, 3: 16}  # compression (none, ZIPS, ZIP) -> lines of a chunk
BYTES = {0: 4, 1: 2, 2: 4}  # pixel type (uint, half, float) -> bytes of a value


class Unreadable(Exception):
    """Raised for a file that is broken or of another kind."""


@dataclasses.dataclass
class Channel:
    length: int  # bytes of a value
    bits: list  # its values as integers, row by row

    def number(self, i):
        """Returns a value as a number (32-bit integers are read as floats)."""
        bits, kind = ("<I", "<f") if self.length == 4 else ("<H", "<e")
        return struct.unpack(kind, struct.pack(bits, self.bits[i]))[0]


@dataclasses.dataclass
class Exr:
    attributes: dict  # name -> bytes
    width: int
    height: int
    channels: dict  # name -> Channel


def read_text(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode("utf-8", "replace"), end + 1


def read_header(data):
    """Returns the attributes and the offset where they end."""
    attributes, at = {}, 8
    while data[at]:
        name, at = read_text(data, at)
        _, at = read_text(data, at)  # skips the type
        (size,) = struct.unpack_from("<i", data, at)
        attributes[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return attributes, at + 1


def read_channels(data):
    """Returns (name, bytes of a value) in the order of the file."""
    result, at = [], 0
    while data[at]:
        name, at = read_text(data, at)
        (kind,) = struct.unpack_from("<i", data, at)
        result.append((name, BYTES[kind]))
        at += 16
    return result


def unzip(data, size):
    """Undoes deflate, differences of neighbours, and the split into odd and even bytes."""
    if len(data) == size:
        return data  # stored uncompressed, because ZIP would have made it longer
    mixed = bytearray(zlib.decompress(data))
    for i in range(1, len(mixed)):
        mixed[i] = (mixed[i - 1] + mixed[i] - 128) & 255
    result, middle = bytearray(size), (size + 1) // 2
    result[0::2], result[1::2] = mixed[:middle], mixed[middle:]
    return bytes(result)


def read_exr(data):
    """Reads a file's bytes. Raises `Unreadable`."""
    try:
        return read(data)
    except (IndexError, KeyError, ValueError, struct.error, zlib.error) as error:
        raise Unreadable(f"not an EXR file of the kind that is read here: {error!r}") from error


def read(data):
    magic, version = struct.unpack_from("<ii", data)
    if magic != MAGIC or version & TILED:
        raise ValueError("magic number or tiles")
    attributes, at = read_header(data)
    compression = attributes["compression"][0]
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    named = read_channels(attributes["channels"])
    channels = {name: Channel(length, []) for name, length in named}
    lines_of_chunk = LINES[compression]
    at += 8 * -(-height // lines_of_chunk)  # skips the offsets of chunks, which come in order
    for first in range(0, height, lines_of_chunk):
        lines = min(lines_of_chunk, height - first)
        y, size = struct.unpack_from("<ii", data, at)
        if y != top + first:
            raise ValueError(f"line {y} in place of {top + first}")
        chunk, at = data[at + 8:at + 8 + size], at + 8 + size
        whole = lines * width * sum(length for _, length in named)
        chunk = chunk if compression == 0 else unzip(chunk, whole)
        if len(chunk) != whole:
            raise ValueError(f"{len(chunk)} bytes in place of {whole}")
        place = 0
        for _ in range(lines):
            for name, length in named:
                channels[name].bits += struct.unpack_from(f"<{width}{'I' if length == 4 else 'H'}", chunk, place)
                place += width * length
    if at != len(data):
        raise ValueError(f"{len(data) - at} bytes after the last line")
    return Exr(attributes, width, height, channels)
