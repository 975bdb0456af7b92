#!/usr/bin/env python3
"""Decodes id layers as specified by Cryptomatte 1.2.0, with independent code: cryptomatte_test.py BDPT FOLDER.

FOLDER holds the scenes of the project. This program has its own code for the hash, the files and the mattes."""

import json
import pathlib
import struct
import subprocess
import sys
import tempfile

from exr_file import ExrFile

KINDS = ["CryptoObject", "CryptoMaterial"]
SAMPLES = 16
SIZE = ["--size", "48x27", "--integrator", "pt", "--max-depth", "1"]


def expect(condition, what):
    if not condition:
        sys.exit(f"failed: {what}")
    print(f"ok: {what}")


def murmur3(data):
    """Returns MurmurHash3_x86_32 with seed 0."""
    def rotated(x, bits):
        return (x << bits | x >> (32 - bits)) & 0xffffffff

    def mixed(block):
        return rotated(block * 0xcc9e2d51 & 0xffffffff, 15) * 0x1b873593 & 0xffffffff

    result, whole = 0, len(data) // 4 * 4
    for (block,) in struct.iter_unpack("<I", data[:whole]):
        result = (rotated(result ^ mixed(block), 13) * 5 + 0xe6546b64) & 0xffffffff
    if whole < len(data):
        result ^= mixed(int.from_bytes(data[whole:], "little"))
    result ^= len(data)
    for shift, factor in ((16, 0x85ebca6b), (13, 0xc2b2ae35)):
        result = (result ^ result >> shift) * factor & 0xffffffff
    return result ^ result >> 16


def hash_to_hex(name):
    """Returns the eight hexadecimal digits of the float that pixels hold for a name."""
    value = murmur3(name.encode())
    return f"{value ^ 1 << 23 if value >> 23 & 255 in (0, 255) else value:08x}"


def bits(value):
    return f"{struct.unpack('<I', struct.pack('<f', value))[0]:08x}"


class Cryptomatte:
    """Decodes one kind of ids. `manifest` has hexadecimal ids by name; `levels(x, y)` returns pairs of id and
    coverage."""

    def __init__(self, exr, kind):
        keys = [name.split("/")[1] for name in exr.attributes if name.startswith("cryptomatte/") and name.endswith("/name")
                and exr.text(name) == kind]
        expect(keys == [hash_to_hex(kind)[:7]], f"{kind} has one key, made of its name")
        entry = f"cryptomatte/{keys[0]}/"
        expect(exr.text(entry + "hash") == "MurmurHash3_32" and exr.text(entry + "conversion") == "uint32_to_float32",
               f"{kind} tells its hash and conversion")
        self.manifest = json.loads(exr.text(entry + "manifest"))
        expect(all(hash_to_hex(name) == value for name, value in self.manifest.items()), f"{kind}: ids are hashes of names")
        layers = sorted({name.partition(".")[0] for name in exr.channels if name.startswith(kind)})
        expect(layers == [f"{kind}{i:02}" for i in range(3)], f"{kind} has six levels")
        self.pairs = [tuple(exr.values[f"{layer}.{c}"] for c in pair) for layer in layers for pair in ("rg", "ba")]
        expect(all(exr.channels[f"{layer}.{c}"] == 2 for layer in layers for c in "rgba"), f"{kind} has 32-bit floats")
        self.size = exr.width, exr.height

    def levels(self, x, y):
        return [(ids[y][x], coverage[y][x]) for ids, coverage in self.pairs]

    def matte(self, name):
        wanted, (width, height) = self.manifest[name], self.size
        return [[sum(share for value, share in self.levels(x, y) if bits(value) == wanted) for x in range(width)]
                for y in range(height)]

    def most_ids(self):
        width, height = self.size
        return max(sum(share > 0 for _, share in self.levels(x, y)) for x in range(width) for y in range(height))


def check_levels(exr, crypto, kind):
    """Tests that ids have names, coverage is sorted, and ids cover all of the alpha."""
    known = set(crypto.manifest.values())
    for y in range(exr.height):
        for x in range(exr.width):
            levels = crypto.levels(x, y)
            shares = [share for _, share in levels]
            named = all(bits(value) in known if share > 0 else (value, share) == (0, 0) for value, share in levels)
            whole = sum(shares) == exr.values["A"][y][x] or shares[-1] > 0  # exact, with 16 samples
            if not named or not whole or shares != sorted(shares, reverse=True):
                sys.exit(f"failed: {kind} at {x}, {y}: {levels}, alpha {exr.values['A'][y][x]}")
    expect(True, f"{kind}: ids are named, ranked, and cover what alpha does")


class Folder:
    def __init__(self, bdpt, path):
        self.bdpt, self.path = bdpt, path

    def bdpt_with(self, *words):
        subprocess.run([self.bdpt, *map(str, words), "--quiet"], check=True)

    def render(self, scene, name, *words):
        self.bdpt_with("render", scene, "-o", self.path / name, "--spp", SAMPLES, "--aov", "object,material,alpha", *SIZE, *words)
        return ExrFile(self.path / name)


def crypto_channels(exr):
    return {name: exr.values[name] for name in exr.channels if name.startswith("Crypto")}


def manifests(exr):
    return {name: value for name, value in exr.attributes.items() if name.startswith("cryptomatte/")}


def have_same_ids(a, b):
    return crypto_channels(a) == crypto_channels(b) and manifests(a) == manifests(b)


def check_mattes(folder, scene):
    """Tests that the matte of a front object equals its alpha when rendered alone."""
    exr = folder.render(scene, "all.exr")
    for kind in KINDS:
        check_levels(exr, Cryptomatte(exr, kind), kind)
    document = json.loads(scene.read_text())
    nodes = [node for node in document["nodes"] if "mesh" in node]
    expect(set(Cryptomatte(exr, "CryptoObject").manifest) == {node["name"] for node in nodes}, "objects are nodes with meshes")
    name = "front"
    alone = json.loads(scene.read_text())
    for node in alone["nodes"]:
        if "mesh" in node and node["name"] != name:
            del node["mesh"]
    (folder.path / "alone.gltf").write_text(json.dumps(alone))
    expected = folder.render(folder.path / "alone.gltf", "alone.exr").values["A"]
    matte = Cryptomatte(exr, "CryptoObject").matte(name)
    expect(matte == [list(row) for row in expected], "the matte of an object is the alpha of it alone")
    expect(any(0 < share < 1 for row in matte for share in row) and any(1 in row for row in matte), "with soft edges")


def check_ways(folder, scene, words):
    """Tests that ids do not depend on how a render is split, run and stored."""
    whole = folder.render(scene, "whole.exr", *words)
    for kind in KINDS:
        check_levels(whole, Cryptomatte(whole, kind), kind)
    expect(Cryptomatte(whole, "CryptoObject").most_ids() >= 3, "what moves shares pixels")
    expect(have_same_ids(folder.render(scene, "half.exr", "--half", "--tiled", *words), whole), "--half and --tiled keep ids as they are")
    expect(have_same_ids(folder.render(scene, "one.exr", "--threads", "1", "--integrator", "bdpt", *words), whole),
           "ids depend on neither threads nor integrators")
    for part, samples in (("a", "0:5"), ("b", "5:7"), ("c", "7:16")):
        folder.bdpt_with("render", scene, "--spp", "16", "--samples", samples, "--aov", "alpha,object,material", *SIZE, *words, "--part",
                         folder.path / f"{part}.part.exr")
    folder.bdpt_with("merge", *(folder.path / f"{part}.part.exr" for part in "cab"), "-o", folder.path / "merged.exr")
    expect(have_same_ids(ExrFile(folder.path / "merged.exr"), whole), "parts have the ids of the whole")
    crop = folder.render(scene, "crop.exr", "--crop", "10,4,37,20", *words)
    cut = {name: [row[10:37] for row in rows[4:20]] for name, rows in crypto_channels(whole).items()}
    expect(crypto_channels(crop) == cut, "a crop has the ids of that region")


def check_refusals(folder, scene):
    outcome = subprocess.run([folder.bdpt, "render", scene, "-o", folder.path / "a.png", "--aov", "object"], capture_output=True, text=True)
    expect(outcome.returncode == 2 and ".exr" in outcome.stderr, "ids want an .exr file")
    outcome = subprocess.run([folder.bdpt, "render", scene, "-o", folder.path / "a.exr", "--aov", "objects"], capture_output=True, text=True)
    expect(outcome.returncode == 2 and "object and material" in outcome.stderr, "the names of AOVs are told")
    # Renders of the same scene with other names are not compatible.
    renamed = json.loads(scene.read_text())
    renamed["nodes"][1]["name"] = "renamed"
    (folder.path / "renamed.gltf").write_text(json.dumps(renamed))
    for part, file, samples in (("x", scene, "0:1"), ("y", folder.path / "renamed.gltf", "1:2")):
        folder.bdpt_with("render", file, "--samples", samples, "--aov", "object", *SIZE, "--part", folder.path / f"{part}.part.exr")
    outcome = subprocess.run([folder.bdpt, "merge", folder.path / "x.part.exr", folder.path / "y.part.exr", "-o", folder.path / "xy.exr"],
                             capture_output=True, text=True)
    expect(outcome.returncode == 4 and "names of objects" in outcome.stderr and not (folder.path / "xy.exr").exists(),
           "parts with other names are refused")


def cubes():
    """Returns a scene of three cubes: one in front, two of one mesh that overlap behind it."""
    corners = [[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    triangles = [0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1, 2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3]
    data = struct.pack("<24f", *(v for corner in corners for v in corner)) + struct.pack("<36H", *triangles)
    turn = [0.2, 0.3, 0.1, 0.9273618495495704]
    return data, {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2, 3]}],
        "nodes": [{"name": "camera", "camera": 0, "translation": [0, 0, 9]},
                  {"name": "front", "mesh": 0, "translation": [-0.8, 0.2, 2], "rotation": turn},
                  {"name": "behind \"it\"", "mesh": 0, "translation": [1.5, 0, -2], "rotation": turn, "scale": [1.5, 1.5, 1.5]},
                  {"name": "Würfel", "mesh": 1, "translation": [2.5, 1, -3], "scale": [1.5, 1.5, 1.5]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.6, "znear": 0.1}}],
        "meshes": [{"name": "cube", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]},
                   {"name": "cube", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "materials": [{"name": "paint"}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [-1, -1, -1], "max": [1, 1, 1]},
                      {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 72}],
        "buffers": [{"uri": "cubes.bin", "byteLength": len(data)}]}


def main():
    bdpt, scenes = sys.argv[1], pathlib.Path(sys.argv[2])
    with tempfile.TemporaryDirectory() as scratch:
        folder = Folder(bdpt, pathlib.Path(scratch))
        data, document = cubes()
        (folder.path / "cubes.bin").write_bytes(data)
        scene = folder.path / "cubes.gltf"
        scene.write_text(json.dumps(document))
        check_mattes(folder, scene)
        check_ways(folder, scenes / "motion.gltf", ["--frame-time", "0.6", "--shutter", "0.04"])
        check_refusals(folder, scene)


if __name__ == "__main__":
    main()
