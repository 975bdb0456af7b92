#!/usr/bin/env python3
"""Tests that no output overwrites a file that the command reads: inputs_test.py COMMAND SCENE.

Crosses all files that a command writes with all that it reads. Each output is named as a hard link to the input, so that
the name has any extension; some also as the input itself, by another spelling, or as a symbolic link.
"""

import base64
import json
import os
import pathlib
import subprocess
import sys
import tempfile

COMMAND, SCENE = (str(pathlib.Path(word).resolve()) for word in sys.argv[1:3])
HOW = ["--size", "16x12", "--spp", "8", "--integrator", "bdpt", "--max-depth", "3", "--quiet"]


def bdpt(*words, cwd):
    return subprocess.run([COMMAND, *map(str, words)], stdin=subprocess.DEVNULL, capture_output=True, check=False,
                          cwd=cwd, timeout=300)


def write_scene(folder, name, prefix):
    """Writes a scene with a buffer, two images and a light profile in separate files."""
    scene = json.loads(pathlib.Path(SCENE).read_text())
    for index, buffer in enumerate(scene["buffers"]):
        data = base64.b64decode(buffer["uri"].partition("base64,")[2])
        buffer["uri"] = f"{prefix}buffer%20{index}.exr"
        (folder / f"{prefix}buffer {index}.exr").write_bytes(data)
    for image in ("used.png", "unused.png"):
        (folder / f"{prefix}{image}").write_bytes((folder / "picture.png").read_bytes())
    (folder / f"{prefix}lamp.exr").write_text("a light profile\n")  # no light uses it
    # Only the names matter: no material uses these images.
    scene["images"] = [{"uri": f"{prefix}used.png"}, {"uri": f"./{prefix}unused.png"}]
    scene["extensionsUsed"] = [*scene.get("extensionsUsed", []), "EXT_lights_ies"]
    scene.setdefault("extensions", {})["EXT_lights_ies"] = {"lights": [{"uri": f"{prefix}lamp.exr"}]}
    (folder / name).write_text(json.dumps(scene))


def make(folder):
    """Writes the input files."""
    bdpt("render", SCENE, *HOW, "-o", "map.exr", "-o", "picture.png", "--adaptive", "--save-rates", "rates.exr", cwd=folder)
    write_scene(folder, "scene.gltf", "")
    write_scene(folder, "other.gltf", "other ")
    for name in ("photo.png", "own.png"):
        (folder / name).write_bytes((folder / "picture.png").read_bytes())
    for name in ("smoke.vdb", "code.so"):
        (folder / name).write_text(f"{name} is not read\n")
    (folder / "job.json").write_text(json.dumps({"bdpt_job": 1, "file": "scene.gltf", "size": "16x12", "spp": 8,
                                                 "integrator": "bdpt", "output": ["by-job.exr"]}))
    bdpt("render", "scene.gltf", *HOW, "--strategy-depth", "2", "--part", "a.part.exr", cwd=folder)
    bdpt("render", "scene.gltf", *HOW, "--background", "own.png", "-o", "before.exr", "--part", "before.part.exr", cwd=folder)
    bdpt("plan", "scene.gltf", *HOW, "-o", "planned.exr", "--parts", "2", "--for", "make", "-d", "job", cwd=folder)
    (folder / "soft.exr").symlink_to("buffer 0.exr")
    (folder / "again").symlink_to(".")
    (folder / "dangling.exr").symlink_to("to.exr")
    # Tests a link, because root could replace /dev/stdout itself.
    (folder / "stdout").symlink_to("/proc/self/fd/1")


# Inputs: a file, and the words by which the command reads it.
OF_SCENE = {"scene.gltf": [], "buffer 0.exr": [], "used.png": [], "unused.png": [], "lamp.exr": []}
OF_VIEW = {**OF_SCENE, "map.exr": ["--env", "map.exr"], "smoke.vdb": ["--volume", "smoke.vdb"],
           "code.so": ["--ktx-library", "code.so"]}
OF_RENDER = {**OF_VIEW, "photo.png": ["--background", "photo.png"], "rates.exr": ["--rates", "rates.exr"]}
CODE = {"code.so": ["--denoise", "--denoiser-library", "code.so"]}

# Outputs: their extension, and the words by which the command writes a file of that name. The sheet of --strategies is
# the picture beside its file.
IMAGE = (".png", lambda file: ["-o", file])
STRATEGIES = [(".exr", lambda file: ["-o", "new.exr", "--strategies", file]),
              (".png", lambda file: ["-o", "new.exr", "--strategies", file.removesuffix(".png") + ".exr"])]
OF_PROCESS = [(".json", lambda file: ["-o", "new.exr", "--stats", file]),
              (".exr", lambda file: ["-o", "new.exr", "--save-rates", file]),
              (".png", lambda file: ["-o", "new.exr", "--save-rates", file]),
              (".exr", lambda file: ["-o", "new.exr", "--part", file, "--restart"]),
              (".json", lambda file: ["--save-job", file])]


def folder_with(file, name):
    """Makes a folder in which the file has that name."""
    folder = pathlib.Path(file).with_suffix("")
    folder.mkdir()
    os.link(file, folder / name)
    return folder


def without(names, inputs):
    return {file: words for file, words in inputs.items() if file not in names}


PLAN = ["--parts", "1", "--for", "make"]
BENCH = ["--quick", "--size", "8x6", "--time", "0.1s", "--seeds", "1", "--integrators", "pt"]
# Commands: their first words, their inputs and their outputs.
TABLE = [
    (["render", "scene.gltf", *HOW], OF_RENDER, [IMAGE, *STRATEGIES]),
    (["render", "scene.gltf", *HOW, "--adaptive"], without(["rates.exr"], OF_RENDER), OF_PROCESS),
    (["render", "scene.gltf", *HOW, "--adaptive"], CODE, [IMAGE, *STRATEGIES, *OF_PROCESS]),
    (["render", "scene.gltf", *HOW], {"rates.exr": ["--rates", "rates.exr"]}, OF_PROCESS),
    (["render", "scene.gltf", *HOW], {"a.part.exr": ["--part", "a.part.exr"]}, [IMAGE, *STRATEGIES, OF_PROCESS[0]]),
    (["render", "job.json"], {"job.json": [], **OF_SCENE}, [IMAGE, *STRATEGIES]),
    (["render", "job.json", "--adaptive"], {"job.json": [], **OF_SCENE}, OF_PROCESS),
    (["render", "--task", "0"], {"job/plan.json": ["--plan", "job/plan.json"]}, [(".json", lambda file: ["--stats", file])]),
    (["render", "other.gltf", "scene.gltf", *HOW], OF_RENDER,
     [(".txt", lambda file: ["-o", f"{folder_with(file, 'other.png')}/{{name}}.png"])]),
    (["plan", "scene.gltf", *HOW, *PLAN, "-d", "new"], without(["photo.png"], OF_RENDER), [IMAGE, *STRATEGIES]),
    (["plan", "scene.gltf", *HOW, *PLAN], without(["photo.png", "smoke.vdb"], OF_RENDER),
     [(".txt", lambda file: ["-o", "new.exr", "-d", str(folder_with(file, "Makefile")), "--restart"])]),
    (["merge"], {"a.part.exr": ["a.part.exr"], "job/plan.json": ["--plan", "job/plan.json"],
                 "own.png": ["before.part.exr"], "photo.png": ["before.part.exr", "--background", "photo.png"]}, [IMAGE]),
    (["merge"], {"a.part.exr": ["a.part.exr"], "job/plan.json": ["--plan", "job/plan.json"]}, STRATEGIES),
    (["merge", "a.part.exr"], CODE, [IMAGE]),
    (["develop"], {"map.exr": ["map.exr"], "own.png": ["before.exr"],
                   "photo.png": ["before.exr", "--background", "photo.png"],
                   "code.so": ["map.exr", *CODE["code.so"]]}, [IMAGE]),
    (["compare"], {"map.exr": ["map.exr", "rates.exr"], "rates.exr": ["map.exr", "rates.exr"]},
     [(".png", lambda file: ["--error-image", file])]),
    (["inspect", "scene.gltf", "--pixel", "8,6", "--size", "16x12"], OF_VIEW, [IMAGE]),
    (["bench", "other.gltf", "scene.gltf", *BENCH], without(["code.so"], OF_VIEW),
     [(".txt", lambda file: ["-o", str(folder_with(file, "bench.json"))])]),
    (["bench", "scene.gltf", *BENCH], {"rates.exr": ["--reference", "rates.exr"]},
     [(".txt", lambda file: ["-o", str(folder_with(file, "bench.json"))])]),
]


def list_crossed():
    """Yields each command that would write one of its inputs: the file, the extension of its hard link, the words."""
    for first, inputs, outputs in TABLE:
        for file, words in inputs.items():
            for extension, name in outputs:
                yield file, extension, lambda link, first=first, words=words, name=name: [*first, *words, *name(link)]


READS = ["scene.gltf", *HOW, "--env", "map.exr", "--rates", "rates.exr"]
SPELLINGS = ["buffer 0.exr", "used.png", "lamp.exr", "map.exr", "rates.exr", "soft.exr", "./again/used.png",
             "again/again/buffer 0.exr"]
OTHERS = [
    *(["render", *READS, "-o", file] for file in SPELLINGS),
    *(["render", *READS, "-o", "new.exr", "-o", "-", "--stats", file] for file in SPELLINGS),
    ["render", "scene.gltf", *HOW, "-o", "new.exr", "--stats", "scene.gltf"],
    ["render", "scene.gltf", *HOW, "-o", "new.exr", "--stats", "again/scene.gltf"],
    ["render", "job.json", "--stats", "job.json"],
    ["render", "job.json", "--save-job", "again/job.json"],
    ["merge", "a.part.exr", "-o", "a.part.exr"],
    ["merge", "a.part.exr", "-o", "again/a.part.exr"],
    # The plan would write its rates over the map.
    ["plan", "scene.gltf", *HOW, "--env", "rates.exr", "--adaptive", "-o", "new.exr", *PLAN, "-d", ".", "--restart"],
    # Two outputs name the same file.
    ["render", "scene.gltf", *HOW, "-o", "one.exr", "-o", "again/one.exr"],
    ["render", "scene.gltf", *HOW, "-o", "-", "--stats", "stdout"],
    ["render", "scene.gltf", *HOW, "-o", "to.exr", "-o", "dangling.exr"],
]


def read_contents(folder):
    files = [file for file in folder.rglob("*") if file.is_file() and file.name != "stdout"]
    return {str(file.relative_to(folder)): file.read_bytes() for file in files}


def find_fault(words, folder):
    """Runs a command that must be refused; returns what is wrong with that, and restores the files."""
    before = read_contents(folder)
    done = bdpt(*words, cwd=folder)
    message = done.stderr.decode()
    refused = done.returncode == 2 and message.count("\n") == 1 and any(
        text in message for text in ("both an input and an output", "an input or another output", "named twice"))
    after = read_contents(folder)
    changed = [file for file in {**before, **after} if before.get(file) != after.get(file)]
    for file in changed:
        if file in before:
            (folder / file).write_bytes(before[file])
        else:
            (folder / file).unlink()
    return "" if refused and not changed else f"exit code {done.returncode}, changed {changed}: {message}"


with tempfile.TemporaryDirectory() as name:
    FOLDER = pathlib.Path(name)
    make(FOLDER)
    os.chdir(FOLDER)
    # Checks that all inputs are readable.
    failed = []
    for WORDS in (["render", *READS, "--background", "photo.png", "-o", "sound.exr"], ["merge", "a.part.exr", "-o", "sound.exr"],
                  ["render", "job.json", "-o", "sound.exr"], ["develop", "before.exr", "-o", "sound.png"]):
        DONE = bdpt(*WORDS, cwd=FOLDER)
        failed += [(" ".join(WORDS), DONE.stderr.decode())] if DONE.returncode != 0 else []
    count = 0
    for file, extension, words in list_crossed():
        count += 1
        link = f"link {count}{extension}"
        os.link(file, link)
        made = words(link)  # may link it again, in a folder
        fault = find_fault(made, FOLDER)
        failed += [(f"{file}: {' '.join(made)}", fault)] if fault else []
        pathlib.Path(link).unlink()
    for words in OTHERS:
        count += 1
        fault = find_fault(words, FOLDER)
        failed += [(" ".join(words), fault)] if fault else []
print("\n".join(f"failed: {what}: {fault}" for what, fault in failed) or f"{count} outputs were refused")
sys.exit(1 if failed else 0)
