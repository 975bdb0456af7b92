#!/usr/bin/env python3
"""Tests that renders take the memory that bdpt estimates, neither more nor much less, and that bdpt refuses a scene
that does not fit, with numbers: memory_test.py COMMAND SMOKE.vdb."""

import array
import json
import os
import pathlib
import random
import resource
import subprocess
import sys
import tempfile
import zlib

sys.dont_write_bytecode = True
SCENES = pathlib.Path(__file__).resolve().parents[3] / "scenes"
sys.path.insert(0, str(SCENES))
from png import png_file

COMMAND, SMOKE = sys.argv[1:3]


class Run:
    """Runs a render; records its peak memory [bytes] and its estimate."""

    def __init__(self, folder, *words, address_space=None):
        stats = folder / "stats.json"
        limit = (lambda: resource.setrlimit(resource.RLIMIT_AS, (address_space,) * 2)) if address_space else None
        process = subprocess.Popen(
            [COMMAND, "render", *map(str, words), "--spp", "1", "--quiet", "-o", folder / "out.exr", "--stats", stats],
            stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, preexec_fn=limit)
        self.error = process.stderr.read()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = self.code = os.waitstatus_to_exitcode(status)
        self.peak = usage.ru_maxrss * 1024  # of the process, or of one that it started
        self.seconds = usage.ru_utime + usage.ru_stime
        self.estimate = json.loads(stats.read_text())["memory"]["estimated_bytes"] if self.code == 0 else 0
        stats.unlink(missing_ok=True)


def run_in_child_process(function):
    """Runs a function in a separate process: the peak memory of this one would count for its children, too."""

    def run(folder, *arguments, **more):
        pid = os.fork()
        if pid == 0:
            function(folder, *arguments, **more)
            os._exit(0)
        if os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]) != 0:
            sys.exit(f"{function.__name__} failed")
        return folder / arguments[0]

    return run


def png(side):
    return png_file(side, side, 6, zlib.compress(b"".join(b"\0" + random.randbytes(4 * side) for _ in range(side)), 1))


@run_in_child_process
def write_scene(folder, name, instances=1, texture_sides=(), lamps=1, triangles=1):
    """Writes a scene of a square of about that many triangles and its instances."""
    side = max(2, round((triangles / 2) ** 0.5) + 1)  # vertices along an edge of the square
    places = [(x / side, y / side) for y in range(side) for x in range(side)]
    corners = array.array("f", [value for x, y in places for value in (x, y, x * y)]).tobytes()
    uvs = array.array("f", [value for place in places for value in place]).tobytes()
    indices = array.array("I", [corner for y in range(side - 1) for x in range(side - 1) for first in [y * side + x]
                                for corner in (first, first + 1, first + side, first + 1, first + side + 1,
                                               first + side)]).tobytes()
    data = corners + uvs + indices
    attributes = {"POSITION": 0, "TEXCOORD_0": 1}
    scene = {
        "asset": {"version": "2.0"}, "scene": 0, "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 10}]}},
        "buffers": [{"byteLength": len(data), "uri": f"{name}.bin"}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": len(corners)},
                        {"buffer": 0, "byteOffset": len(corners), "byteLength": len(uvs)},
                        {"buffer": 0, "byteOffset": len(corners) + len(uvs), "byteLength": len(indices)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(places), "type": "VEC3", "min": [0, 0, 0],
                       "max": [1, 1, 1]},
                      {"bufferView": 1, "componentType": 5126, "count": len(places), "type": "VEC2"},
                      {"bufferView": 2, "componentType": 5125, "count": len(indices) // 4, "type": "SCALAR"}],
        "meshes": [{"primitives": [{"attributes": attributes, "indices": 2}]}],
        "nodes": [{"mesh": 0, "translation": [2 * (i % 250), 2 * (i // 250), 0]} for i in range(instances)]}
    scene["nodes"] += [{"extensions": {"KHR_lights_punctual": {"light": 0}}, "translation": [i, 0, 3]}
                       for i in range(lamps)]
    scene["scenes"] = [{"nodes": list(range(len(scene["nodes"])))}]
    for i, side in enumerate(texture_sides):
        (folder / f"{name}{i}.png").write_bytes(png(side))
        scene.setdefault("images", []).append({"uri": f"{name}{i}.png"})
        scene.setdefault("textures", []).append({"source": i})
        scene.setdefault("materials", []).append({"pbrMetallicRoughness": {"baseColorTexture": {"index": i}}})
        scene["meshes"].append({"primitives": [{"attributes": attributes, "material": i}]})
        scene["nodes"].append({"mesh": i + 1})
        scene["scenes"][0]["nodes"].append(len(scene["nodes"]) - 1)
    (folder / f"{name}.bin").write_bytes(data)
    (folder / name).write_text(json.dumps(scene))


@run_in_child_process
def write_sky(folder, name, width, height, head=""):
    """Writes a Radiance HDR image of one colour."""
    line = bytes([2, 2, width >> 8, width & 255])
    for value in (120, 110, 100, 128):
        for begin in range(0, width, 127):
            line += bytes([128 + min(127, width - begin), value])
    head = f"#?RADIANCE\n{head}FORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n"
    (folder / name).write_bytes(head.encode() + line * height)


def check_estimates(folder):
    """Tests estimates, less the memory of a process with a minimal scene."""
    small = ["--size", "32x32", "--integrator", "pt"]
    least = write_scene(folder, "least.gltf")
    base = Run(folder, least, *small)
    sky = write_sky(folder, "sky.hdr", 4096, 2048)
    floats = write_sky(folder, "floats.hdr", 4096, 2048, "EXPOSURE=3\n")
    cases = {
        "instances": [write_scene(folder, "instances.gltf", instances=50_000), *small],
        "textures": [write_scene(folder, "textures.gltf", texture_sides=[1024] * 12), *small],
        "triangles": [write_scene(folder, "triangles.gltf", triangles=400_000), *small],
        "an environment": [least, "--env", sky, *small],
        "an environment of floats": [least, "--env", floats, *small],
        "a film": [least, "--size", "1024x1024", "--integrator", "pt"],
        "a film with splats": [least, "--size", "768x768", "--integrator", "bdpt"],
        "layers": [least, "--size", "768x768", "--integrator", "pt", "--aov", "albedo,normal,depth,position"],
        "shared light paths": [SCENES / "cornell-box.gltf", "--size", "1024x1024", "--integrator", "bdpt", "--light-paths",
                               "0.25", "--connections", "8", "--connection-rays", "4"],
    }
    for name, words in cases.items():
        done = Run(folder, *words)
        taken, estimate = done.peak - base.peak, done.estimate - base.estimate
        print(f"{name}: {taken / 1e6:.1f} MB of memory, estimated as {estimate / 1e6:.1f} MB {done.error}")
        # Pages and allocators add a little that no estimate covers.
        yield f"{name}: more than estimated", done.code == 0 and taken < 1.05 * estimate + 3e6
        yield f"{name}: much less than estimated", estimate < 1.3 * taken + 3e6


def check_refusals(folder):
    least = write_scene(folder, "least.gltf")
    sky = write_sky(folder, "sky.hdr", 4096, 2048)
    small = ["--size", "32x32"]

    def refused(words, code, *parts, **more):
        done = Run(folder, *words, **more)
        print(done.code, done.error.strip())
        return (done.code == code and all(part in done.error for part in parts) and
                not (folder / "out.exr").exists() and done.peak < 150e6)

    (folder / "out.exr").unlink(missing_ok=True)
    yield "a sky beyond --max-memory", refused([least, "--env", sky, *small, "--max-memory", "60M"], 4, "sky.hdr: ",
                                               "the environment needs 67.1 MB", "of 62.9 MB are left (--max-memory)")
    # Divided by the exposure, values are floats.
    floats = write_sky(folder, "floats.hdr", 4096, 2048, "EXPOSURE=3\n")
    yield "a sky of floats", refused([least, "--env", floats, *small, "--max-memory", "60M"], 4, "floats.hdr: ",
                                     "4096 x 2048", "101 MB", "of 62.9 MB are left (--max-memory)")
    yield "its tables", refused([least, "--env", floats, *small, "--max-memory", "150M"], 4, "floats.hdr: ",
                                "the environment needs 185 MB", "of 157 MB are left (--max-memory)")
    yield "a film beyond the machine", refused([least, "--size", "65535x65535"], 7, "the film of 65535x65535 pixels",
                                               "needs 464 GB of memory, but the limit is")
    yield "a film beyond ulimit -v", refused([least, "--size", "6000x6000"], 7, "the film of 6000x6000 pixels",
                                             "ulimit -v", address_space=2_000_000_000)
    many = write_scene(folder, "many.gltf", instances=20_000)
    yield "instances beyond --max-memory", refused([many, *small, "--max-memory", "15M"], 4, "many.gltf: ",
                                                   "(--max-memory)")


def check_broken_volumes(folder):
    """Tests lengths in the header of an OpenVDB file that demand 2 GB."""
    least = write_scene(folder, "least.gltf")
    whole = pathlib.Path(SMOKE).read_bytes()
    broken = folder / "broken.vdb"
    for place in (116, 136, 148, 172, 276):
        broken.write_bytes(whole[:place] + b"\xff\xff\xff\x7f" + whole[place + 4:])
        done = Run(folder, least, "--volume", broken, "--size", "16x16")
        print(f"{place}: {done.peak / 1e6:.0f} MB, {done.seconds:.1f} s, {done.error.strip()}")
        if done.code == 5:
            return  # built without OpenVDB
        yield f"a length at {place}", done.code in (0, 4) and done.peak < 320e6 and done.seconds < 10


with tempfile.TemporaryDirectory() as name:
    FOLDER = pathlib.Path(name)
    RESULTS = [result for check in (check_estimates, check_refusals, check_broken_volumes) for result in check(FOLDER)]
FAILED = [what for what, passed in RESULTS if not passed]
print("\n".join(f"failed: {what}" for what in FAILED) or f"{len(RESULTS)} checks passed")
sys.exit(1 if FAILED else 0)
