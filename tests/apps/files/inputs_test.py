#!/usr/bin/env python3
"""Tests that no output overwrites a file that the command reads: inputs_test.py COMMAND SCENE.

Inputs are a scene with a buffer, images and a light profile in separate files; an environment map, rates, parts and
plans. Each is named as the output once, by its name, by another spelling, through a symbolic and a hard link.
"""

import base64
import json
import os
import pathlib
import subprocess
import sys
import tempfile

COMMAND, SCENE = sys.argv[1:3]
HOW = ["--size", "16x12", "--spp", "8", "--integrator", "bdpt", "--max-depth", "3", "--quiet"]


def bdpt(*words, cwd):
    return subprocess.run([COMMAND, *map(str, words)], stdin=subprocess.DEVNULL, capture_output=True, check=False,
                          cwd=cwd, timeout=300)


def make(folder):
    """Writes the input files."""
    scene = json.loads(pathlib.Path(SCENE).read_text())
    for index, buffer in enumerate(scene["buffers"]):
        data = base64.b64decode(buffer["uri"].partition("base64,")[2])
        buffer["uri"] = f"buffer%20{index}.exr"
        (folder / f"buffer {index}.exr").write_bytes(data)
    bdpt("render", SCENE, *HOW, "-o", "map.exr", "-o", "used.png", "--adaptive", "--save-rates", "rates.exr", cwd=folder)
    bdpt("render", SCENE, *HOW, "-o", "unused.png", cwd=folder)
    (folder / "lamp.exr").write_text("a light profile\n")  # no light uses it
    # Only the names matter: no material uses these images.
    scene["images"] = [{"uri": "used.png"}, {"uri": "./unused.png"}]
    scene["extensionsUsed"] = [*scene.get("extensionsUsed", []), "EXT_lights_ies"]
    scene.setdefault("extensions", {})["EXT_lights_ies"] = {"lights": [{"uri": "lamp.exr"}]}
    (folder / "scene.gltf").write_text(json.dumps(scene))
    bdpt("render", "scene.gltf", *HOW, "--part", "a.part.exr", cwd=folder)
    bdpt("plan", "scene.gltf", *HOW, "-o", "planned.exr", "--parts", "2", "--for", "make", "-d", "job", cwd=folder)
    for file in ("scene.gltf", "buffer 0.exr", "used.png", "map.exr"):
        os.link(folder / file, folder / f"hard-{file}.png")
    (folder / "soft.exr").symlink_to("buffer 0.exr")
    (folder / "again").symlink_to(".")
    (folder / "dangling.exr").symlink_to("to.exr")
    # Tests a link, because root could replace /dev/stdout itself.
    (folder / "stdout").symlink_to("/proc/self/fd/1")


READS = ["scene.gltf", *HOW, "--env", "map.exr", "--rates", "rates.exr"]
FILES = ["buffer 0.exr", "used.png", "unused.png", "lamp.exr", "map.exr", "rates.exr", "hard-used.png.png",
         "hard-scene.gltf.png", "hard-buffer 0.exr.png", "soft.exr", "./again/used.png", "again/again/buffer 0.exr"]


def list_commands(file):
    """Yields the commands that would write `file`."""
    yield ["render", *READS, "-o", file]
    yield ["render", *READS, "-o", "new.exr", "--stats", file]
    yield ["render", *READS, "-o", "new.exr", "--save-rates", file]
    yield ["render", *READS, "-o", "new.exr", "-o", "-", "--stats", file]
    yield ["plan", *READS, "-o", file, "--parts", "1", "--for", "make", "-d", "new"]
    if "rates" not in file:
        yield ["inspect", "scene.gltf", "--env", "map.exr", "--pixel", "8,6", "--size", "16x12", "-o", file]
    if file.endswith(".exr"):
        yield ["render", *READS, "-o", "new.png", "--strategies", file]
        yield ["render", *READS, "--part", file, "--restart"]


OTHERS = [
    ["render", "scene.gltf", *HOW, "-o", "new.exr", "--stats", "scene.gltf"],
    ["render", "scene.gltf", *HOW, "-o", "new.exr", "--stats", "again/scene.gltf"],
    ["render", "--plan", "job/plan.json", "--task", "0", "--stats", "job/plan.json"],
    ["merge", "a.part.exr", "-o", "a.part.exr"],
    ["merge", "a.part.exr", "-o", "again/a.part.exr"],
    ["compare", "map.exr", "rates.exr", "--error-image", "hard-map.exr.png"],
    ["compare", "rates.exr", "map.exr", "--error-image", "hard-map.exr.png"],
    # The plan would write its rates over the map.
    ["plan", "scene.gltf", *HOW, "--env", "rates.exr", "--adaptive", "-o", "new.exr", "--parts", "1", "--for", "make",
     "-d", ".", "--restart"],
    # Two outputs name the same file.
    ["render", "scene.gltf", *HOW, "-o", "one.exr", "-o", "again/one.exr"],
    ["render", "scene.gltf", *HOW, "-o", "-", "--stats", "stdout"],
    ["render", "scene.gltf", *HOW, "-o", "to.exr", "-o", "dangling.exr"],
]


def read_contents(folder):
    files = [file for file in folder.rglob("*") if file.is_file() and file.name != "stdout"]
    return {str(file.relative_to(folder)): file.read_bytes() for file in files}


with tempfile.TemporaryDirectory() as name:
    FOLDER = pathlib.Path(name)
    make(FOLDER)
    # Checks that all inputs are readable.
    sound = bdpt("render", *READS, "-o", "sound.exr", "--seed", "2", cwd=FOLDER)
    failed = [] if sound.returncode == 0 else [("the scene", sound.stderr.decode())]
    before = read_contents(FOLDER)
    count = 0
    for words in [words for file in FILES for words in list_commands(file)] + OTHERS:
        done = bdpt(*words, cwd=FOLDER)
        message = done.stderr.decode()
        refused = done.returncode == 2 and message.count("\n") == 1 and any(
            text in message for text in ("both an input and an output", "an input or another output", "named twice"))
        if not refused or read_contents(FOLDER) != before:
            changed = [file for file, data in read_contents(FOLDER).items() if before.get(file) != data]
            failed.append((" ".join(words), f"exit code {done.returncode}, changed {changed}: {message}"))
            for file in changed:
                if file in before:
                    (FOLDER / file).write_bytes(before[file])
                else:
                    (FOLDER / file).unlink()
        count += 1
print("\n".join(f"failed: {what}: {fault}" for what, fault in failed) or f"{count} outputs were refused")
sys.exit(1 if failed else 0)
