"""Writes PNG files."""

import struct
import zlib


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def stored(data):
    """Returns a zlib stream with one uncompressed block."""
    assert len(data) <= 65535
    return b"\x78\x01\x01" + struct.pack("<HH", len(data), len(data) ^ 0xFFFF) + data + struct.pack(
        ">I", zlib.adler32(data))


def png_file(width, height, color_type, rows):
    """Returns a PNG file of 8 bits a channel, of the zlib stream of its rows."""
    header = struct.pack(">2I5B", width, height, 8, color_type, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", rows) + chunk(b"IEND", b"")


def png(width, height, pixel):
    """Returns an uncompressed PNG file, whose bytes do not depend on the version of a compressor. `pixel(x, y)` returns red, green, blue and optionally alpha in [0, 1],
    sRGB-encoded, with (0, 0) at the centre of the image, x to the right, y up and both in units of half its height."""
    rows, channels = [], 0
    for row in range(height):
        values = []
        for column in range(width):
            color = pixel((2 * column + 1 - width) / height, (height - 2 * row - 1) / height)
            channels = len(color)
            values += [min(255, max(0, int(255 * c + 0.5))) for c in color]
        rows.append(b"\0" + bytes(values))
    return png_file(width, height, {3: 2, 4: 6}[channels], stored(b"".join(rows)))
