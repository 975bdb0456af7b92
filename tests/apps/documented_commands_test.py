"""Runs the commands in README and docs: documented_commands_test.py BDPT ROOT FAKE_DENOISER OPENVDB.

Runs each line of a code block that begins with `bdpt`, page by page, in a folder with small files of the names that the
pages use. Reduces options that determine the render time, and replaces files that only users have (libktx, Open Image
Denoise, a grid). A command that fails is an error of the page. OPENVDB is 0 if volumes cannot be read.
"""

import json
import os
import pathlib
import re
import shlex
import shutil
import signal
import struct
import subprocess
import sys
import tempfile

SKY = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x80\x80\x81"
PLACEHOLDERS = {"SCENE...": "scene.gltf", "SCENE": "scene.gltf", "IMAGE": "out.exr", "REFERENCE": "reference.exr",
                "FOLDER": "seeds/", "DIR": "out/bench", "[any option of bdpt render]": ""}
SMALL_IMAGE = ["--size", "16x12"]
# These exit codes are legitimate negative answers: images that differ, parts that are missing.
ALLOWED = {"compare": {0, 1}, "merge": {0, 12}, "verify": {0, 11}}
NEEDS_OTHERS = {"--display"}  # needs a viewer


def find_commands(page):
    """Returns the lines of `bdpt` and `mkdir` of a page as (line number, section, text), without comments."""
    section, lines = 0, page.read_text(encoding="utf-8").splitlines()
    for number, line in enumerate(lines, 1):
        section += line.startswith("#")
        if not line.startswith(("    bdpt ", "    mkdir ")):
            continue
        text = line.strip()
        while text.endswith("\\"):
            text = text[:-1] + lines[number].strip()
            number += 1
        yield number, section, re.sub(r"\s+# .*", "", text)


def write_glb(path, document):
    """Writes a scene as one binary file [glTF 2.0, 4.4]."""
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    path.write_bytes(b"glTF" + struct.pack("<IIII", 2, 20 + len(text), len(text), 0x4E4F534A) + text)


def write_files(folder, root, bdpt):
    """Writes all files that the pages name but that no command of theirs writes."""
    (folder / "scenes").symlink_to(root / "scenes")
    box = json.loads((root / "scenes/cornell-box.gltf").read_text())
    moving = json.loads((root / "scenes/motion.gltf").read_text())
    cameras = json.loads((root / "scenes/cornell-box.gltf").read_text())
    seen_by = next(node for node in cameras["nodes"] if "camera" in node)
    cameras["cameras"].append({**cameras["cameras"][0], "name": "second"})
    cameras["nodes"].append({**seen_by, "name": "second", "camera": 1})
    cameras["scenes"][0]["nodes"].append(len(cameras["nodes"]) - 1)
    for name in ("model", "shoe", "room", "scene", "part", "chair", "car", "hall", "balloon"):
        write_glb(folder / f"{name}.glb", box)
    (folder / "scene.gltf").write_text(json.dumps(box))
    write_glb(folder / "walk.glb", moving)
    write_glb(folder / "house.glb", cameras)
    for name in ("sky.hdr", "vestibule.hdr"):
        (folder / name).write_bytes(SKY)
    shutil.copy(root / "scenes/smoke.vdb", folder / "fire.vdb")
    (folder / "models").mkdir()
    for name in ("chair", "table"):
        write_glb(folder / "models" / f"{name}.glb", box)
    (folder / "seeds").mkdir()
    (folder / "out").mkdir()  # ./bootstrap demo makes it
    for words in (["scene.gltf", "-o", "reference.exr", "-o", "vestibule.jpg", "-o", "out.exr"],
                  ["scene.gltf", "-o", "seeds/0.exr"], ["scene.gltf", "-o", "seeds/1.exr", "--seed", "1"],
                  ["scenes/furnace.gltf", "-o", "sky.exr", "-o", "studio.exr", "-o", "courtyard.exr"],
                  ["chair.glb", "-o", "chair.exr", "--background", "transparent", "--env", "sky.hdr"]):
        subprocess.run([bdpt, "render", *words, *SMALL_IMAGE, "--spp", "2", "--quiet"], cwd=folder, check=True)


def replace_option(words, option, value):
    """Returns `words` with another value of `option`, if they have it."""
    result = list(words)
    for i in range(len(words) - 1):
        if words[i] == option:
            result[i + 1] = value
    return result


def shorten_command(words, denoiser):
    """Returns the command line with a small image and few samples."""
    command = words[1]
    for option, value in (("--time", "1s"), ("--orbit", "3"), ("--noise", "50%"), ("--volume-grid", "density"),
                          ("--ktx-library", str(denoiser.parent))):
        words = replace_option(words, option, value)
    if command in ("render", "view"):
        words = replace_option(replace_option(words, "--spp", "2"), "--frames", "1:2")
    if command in ("render", "plan", "view") and "--plan" not in words and "--pixel" not in words:
        words = replace_option(words, "--size", "16x12")
        words += [] if "--size" in words else SMALL_IMAGE
    if command == "render" and not {"--spp", "--samples", "--plan"} & set(words) and "room.json" not in words:
        words += ["--spp", "2"]
    if command == "dataset":
        words = replace_option(words, "--views", "2") + [*SMALL_IMAGE, "--spp", "2"]
    if command == "bench":
        words += ["--time", "0.05s", "--seeds", "2", *SMALL_IMAGE]
    if command == "verify":
        words = replace_option(words, "--time", "2s")
        words += [] if "--time" in words else ["--time", "2s"]
    if any(word.startswith("--denoise") for word in words) and command != "view":
        words += ["--denoiser-library", str(denoiser)]
    return words


def run(words, folder):
    """Returns the exit code and the output. Interrupts `bdpt view` after it has printed its address."""
    if words[1] != "view":
        done = subprocess.run(words, cwd=folder, capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=300,
                              check=False)
        return done.returncode, done.stdout + done.stderr
    with subprocess.Popen(words, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as view:
        text = view.stdout.readline()
        view.send_signal(signal.SIGINT)
        text += view.communicate(timeout=60)[0]
    return (0 if "http://" in text else 1), text


def expand_wildcards(words, folder):
    """Expands `*` as a shell does, but not in names that bdpt expands."""
    result = []
    for word in words:
        found = sorted(str(file.relative_to(folder)) for file in folder.glob(word)) if "*" in word else []
        result += found or [word]
    return result


def main():
    bdpt, root, denoiser = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    pages = [root / "README.md", *sorted((root / "docs").glob("*.md"))]
    if sys.argv[4] == "0":
        NEEDS_OTHERS.add("--volume")
    failed, count = [], 0
    with tempfile.TemporaryDirectory() as name:
        original = pathlib.Path(name) / "files"
        original.mkdir()
        write_files(original, root, bdpt)
        for page in pages:
            folder = pathlib.Path(name) / page.stem
            last_section = None
            for number, section, text in find_commands(page):
                if section != last_section and (folder / "job").exists():
                    shutil.rmtree(folder / "job")
                last_section = section
                if not folder.exists():
                    shutil.copytree(original, folder, symlinks=True)
                for placeholder, word in PLACEHOLDERS.items():
                    text = re.sub(rf"(?<!\S){re.escape(placeholder)}(?!\S)", word, text)
                words = [bdpt, *shlex.split(text)[1:]]
                if text.startswith("mkdir "):
                    subprocess.run(shlex.split(text), cwd=folder, check=True)
                    continue
                if set(words) & NEEDS_OTHERS:
                    continue
                if words[1] == "plan":
                    shutil.rmtree(folder / "job", ignore_errors=True)
                if words[1] == "merge" and "--plan" in words:
                    run([bdpt, "render", "--plan", "job/plan.json", "--task", "0", "--quiet"], folder)
                count += 1
                code, said = run(expand_wildcards(shorten_command(words, denoiser), folder), folder)
                if code not in ALLOWED.get(words[1], {0}):
                    failed.append(f"{page.relative_to(root)}:{number}: {text}\n"
                                  f"  exit code {code}: {said.strip()[-400:]}")
    print("\n".join(failed) or f"{count} commands run")
    if count < 60:
        print(f"only {count} commands were found")
    sys.exit(bool(failed) or count < 60)


if __name__ == "__main__":
    os.environ.pop("BDPT_TEST_ASSETS", None)
    main()
