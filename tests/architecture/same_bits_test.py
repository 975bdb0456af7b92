#!/usr/bin/env python3
"""Tests that same_bits finds each changed bit in the output of two renders, and ignores differences of clocks."""

import contextlib
import io
import json
import pathlib
import struct
import sys
import tempfile
import unittest
import zlib

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "benchmarks" / "same_bits"))
import cases
import differences
import exr_bits
import same_bits

WIDTH, HEIGHT = 3, 18  # needs more than one chunk
STATS = {"file": "a.gltf", "seconds": {"render": 1.0}, "paths": {"camera": 7}, "rays": {"camera": 9, "per_second": 3.0}}


def zipped(data):
    """Compresses like OpenEXR: splits odd and even bytes, takes differences of neighbours, then deflates."""
    mixed = data[0::2] + data[1::2]
    packed = zlib.compress(bytes([mixed[0]]) + bytes((b - a + 128) & 255 for a, b in zip(mixed, mixed[1:])))
    return packed if len(packed) < len(data) else data


def exr(channels, compression, created="2026:01:01 00:00:00", **more):
    """Returns a file with those channels of floats; each has a value for each pixel."""
    attributes = {"channels": b"".join(name.encode() + struct.pack("<xi4x2i", 2, 1, 1) for name in channels) + b"\0",
                  "compression": bytes([compression]), "dataWindow": struct.pack("<4i", 0, 0, WIDTH - 1, HEIGHT - 1),
                  "capDate": created.encode(), **{name: value.encode() for name, value in more.items()}}
    header = struct.pack("<ii", exr_bits.MAGIC, 2)
    for name, value in attributes.items():
        header += name.encode() + b"\0type\0" + struct.pack("<i", len(value)) + value
    chunks, lines = [], exr_bits.LINES[compression]
    for first in range(0, HEIGHT, lines):
        rows = b"".join(struct.pack(f"<{WIDTH}f", *values[y * WIDTH:(y + 1) * WIDTH])
                        for y in range(first, min(first + lines, HEIGHT)) for values in channels.values())
        packed = zipped(rows) if compression else rows
        chunks.append(struct.pack("<ii", first, len(packed)) + packed)
    return header + b"\0" + bytes(8 * len(chunks)) + b"".join(chunks)


def pixels(changed=()):
    """Returns the values of a channel; those at `changed` are one bit greater."""
    values = [0.5 + 0.01 * i for i in range(WIDTH * HEIGHT)]
    bits = [struct.unpack("<I", struct.pack("<f", value))[0] + (i in changed) for i, value in enumerate(values)]
    return [struct.unpack("<f", struct.pack("<I", bit))[0] for bit in bits]


def png(data, text):
    chunks = [(b"IHDR", bytes(13)), (b"tEXt", text), (b"IDAT", data), (b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(struct.pack(">I", len(body)) + name + body + bytes(4) for name, body in chunks)


class Differences(unittest.TestCase):
    def test_values_are_read(self):
        for compression in exr_bits.LINES:
            read = exr_bits.read_exr(exr({"B": pixels(), "R": pixels({7})}, compression))
            self.assertEqual([read.channels["B"].number(i) for i in range(WIDTH * HEIGHT)], pixels())
            self.assertEqual([read.channels["R"].number(i) for i in range(WIDTH * HEIGHT)], pixels({7}))

    def test_a_bit(self):
        for compression in exr_bits.LINES:
            for at in (0, 7, WIDTH * HEIGHT - 1):
                found = differences.of_exr(exr({"B": pixels(), "R": pixels()}, compression),
                                           exr({"B": pixels(), "R": pixels({at})}, compression))
                self.assertEqual(len(found), 1)
                self.assertIn(f"channel R: 1 of {WIDTH * HEIGHT} values, the first at pixel ({at % WIDTH}, {at // WIDTH})",
                              found[0])

    def test_signs_of_zero(self):
        self.assertTrue(differences.of_exr(exr({"R": [0.0] * 54}, 0), exr({"R": [-0.0] * 54}, 0)))

    def test_channels_and_metadata(self):
        before = exr({"R": pixels()}, 3, seed="1")
        self.assertIn("only after", differences.of_exr(before, exr({"R": pixels(), "S": pixels()}, 3, seed="1"))[-1])
        self.assertIn("only before", differences.of_exr(before, exr({"Q": pixels()}, 3, seed="1"))[-2])
        self.assertIn("attribute seed", differences.of_exr(before, exr({"R": pixels()}, 3, seed="2"))[0])

    def test_clocks(self):
        self.assertEqual(differences.of_exr(exr({"R": pixels()}, 3),
                                            exr({"R": pixels()}, 3, "2026:01:01 00:00:09")), [])
        later = {**STATS, "seconds": {"render": 2.0}, "rays": {"camera": 9, "per_second": 4.0}}
        self.assertEqual(differences.of_stats(json.dumps(STATS), json.dumps(later)), [])
        self.assertEqual(differences.of_png(png(b"abc", b"now"), png(b"abc", b"then")), [])

    def test_counts(self):
        more = {**STATS, "rays": {"camera": 10, "per_second": 3.0}}
        self.assertEqual(differences.of_stats(json.dumps(STATS), json.dumps(more)), ["rays.camera: 9 became 10"])

    def test_previews(self):
        self.assertTrue(differences.of_png(png(b"abc", b"now"), png(b"abd", b"now")))


PROGRAM = """#!{python}
import json, pathlib, sys
words = sys.argv[1:]
pathlib.Path(words[words.index("-o") + 1]).write_bytes(bytes.fromhex("{exr}"))
pathlib.Path(words[words.index("--stats") + 1]).write_text(json.dumps({stats}))
print(json.dumps({{"event": "warning", "message": "{warning}"}}))
sys.exit({code})
"""


class Command(unittest.TestCase):
    """Tests the command with programs that render nothing."""

    def run_with(self, more=(), **changes):
        """Returns exit code and last line, for a correct program and one with those changes."""
        sound = {"python": sys.executable, "exr": exr({"R": pixels()}, 3).hex(), "stats": STATS, "warning": "dark", "code": 0}
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "box.gltf").touch()
            for program, fields in (("before", sound), ("after", {**sound, **changes})):
                (folder / program).write_text(PROGRAM.format(**fields), encoding="utf-8")
                (folder / program).chmod(0o755)
            arguments = [str(folder / "before"), str(folder / "after"), "--scenes", name, "--only", "(bdpt|mis), as it is$"]
            output, sys.argv = io.StringIO(), ["same_bits", *arguments, *more]
            with contextlib.redirect_stdout(output), self.assertRaises(SystemExit) as ended:
                same_bits.main()
            return ended.exception.code, output.getvalue().splitlines()[-1]

    def test_equal(self):
        self.assertEqual(self.run_with(), (0, "2 compared, 0 different"))

    def test_each_change_is_found(self):
        for change in ({"exr": exr({"R": pixels({3})}, 3).hex()}, {"stats": {**STATS, "paths": {"camera": 8}}},
                       {"warning": "bright"}, {"code": 3}):
            self.assertEqual(self.run_with(**change), (1, "2 compared, 2 different"), change)

    def test_nothing_to_compare(self):
        self.assertEqual(self.run_with(("--only", "no such case")), (2, "0 compared, 0 different"))


class Cases(unittest.TestCase):
    def test_quick_ones_have_every_option(self):
        scenes = sorted((pathlib.Path(__file__).resolve().parents[2] / "scenes").glob("*.gltf"))
        everything = cases.all_cases(scenes)
        quick = cases.quick_cases(everything)
        self.assertEqual({(case.options.name, case.integrator) for case in quick},
                         {(case.options.name, case.integrator) for case in everything})
        self.assertEqual({options.name for options in cases.OPTIONS}, {case.options.name for case in quick})
        self.assertLess(len(quick), len(everything) / 4)


if __name__ == "__main__":
    unittest.main()
