#!/usr/bin/env python3
"""Renders each model of a folder as a newcomer would, `bdpt render model.glb`, and puts the pictures on a sheet.

    first_pictures.py BDPT SHEET.png [FOLDER] [--options "--size 320x180 --spp 16"] [--keep FOLDER]
                      [--only TEXT] [--skip NAME,...] [--columns N] [--tile WxH]

FOLDER (default: that of BDPT_TEST_ASSETS) has a folder for each model; the first .glb or .gltf file in it is taken.
There is no option beside the file and the output unless --options gives some, to be quicker. For each model a line is
printed: exit code, seconds, mean luminance of the picture, its shares of black and of burnt-out pixels, and the
rectangle around the object, by the alpha of a second, small render with --background transparent: width and height,
and how far its middle is from that of the picture, in percent of the picture. Words at the end of a line say what
deserves a look:

    black     more than half of the picture is black, or its mean is below 0.02
    burnt     more than 2 % of the picture is white in all channels
    small     the object takes less than 70 % of the width and of the height
    aside     its middle is more than 3 % away from that of the picture
    cut       it reaches the edges of the picture: a room, or a camera of the file

What bdpt says (errors, warnings, notes) follows in lines of their own. Models without a picture are dark red. Needs
Pillow and NumPy.
"""

import argparse
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile
import time

import tiles


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", type=pathlib.Path)
    parser.add_argument("sheet", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path, nargs="?", default=os.environ.get("BDPT_TEST_ASSETS"))
    parser.add_argument("--options", type=shlex.split, default=[], help="more options of bdpt render")
    parser.add_argument("--keep", type=pathlib.Path, help="keep the pictures in this folder")
    parser.add_argument("--only", default="", help="models whose name has this text")
    parser.add_argument("--skip", default="hostile,hdr,fidelity", help="folders to leave out, with commas between them")
    parser.add_argument("--columns", type=int, default=8)
    parser.add_argument("--tile", default="240x135", help="size of a picture on the sheet [px]")
    options = parser.parse_args(words)
    if options.folder is None:
        parser.error("no FOLDER, and BDPT_TEST_ASSETS is not set")
    return options


def find_models(options):
    """Returns name and file of each model."""
    models = []
    for folder in sorted(path for path in options.folder.iterdir() if path.is_dir()):
        files = sorted(folder.glob("*.glb")) + sorted(folder.glob("*.gltf"))
        if files and folder.name not in options.skip.split(",") and options.only in folder.name:
            models.append((folder.name, files[0]))
    return models


def run(*words):
    return subprocess.run([str(word) for word in words], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          timeout=3600, check=False)


def find_problems(code, look, bounds):
    """Returns the words of the help that apply to a picture."""
    if code != 0:
        return []
    words = []
    if look["black"] > 0.5 or look["luminance"] < 0.02:
        words.append("black")
    if look["burnt"] > 0.02:
        words.append("burnt")
    if bounds is None:
        return words + ["nothing"]
    largest = max(bounds["width"], bounds["height"])
    if largest < 0.7:
        words.append("small")
    if largest > 0.99:
        words.append("cut")
    if max(bounds["aside"], bounds["above"]) > 0.03:
        words.append("aside")
    return words


def format_row(name, code, seconds, look, bounds, words):
    """Formats a line of the table."""
    cells = [f"{name:40}", f"{code:3}", f"{seconds:6.1f}"]
    cells.append(f"{look['luminance']:6.3f} {100 * look['black']:5.1f} {100 * look['burnt']:5.1f}" if look else " " * 18)
    cells.append(f"{100 * bounds['width']:4.0f} {100 * bounds['height']:4.0f} {100 * bounds['aside']:4.0f} "
                 f"{100 * bounds['above']:4.0f}" if bounds else " " * 19)
    return " ".join(cells + words)


def render(options, name, model, folder):
    """Renders a model and prints its lines; returns its tile."""
    picture, outline = folder / f"{name}.png", folder / f"{name}.outline.png"
    picture.unlink(missing_ok=True)
    start = time.monotonic()
    done = run(options.command, "render", model, "-o", picture, *options.options)
    seconds = time.monotonic() - start
    look = tiles.brightness(picture) if picture.exists() else None
    run(options.command, "render", model, "-o", outline, *options.options, "--size", "320x180", "--spp", "4",
        "--integrator", "mis", "--max-depth", "1", "--background", "transparent", "--exposure", "0", "--quiet")
    bounds = tiles.extent(outline) if outline.exists() else None
    outline.unlink(missing_ok=True)
    words = find_problems(done.returncode, look, bounds)
    print(format_row(name, done.returncode, seconds, look, bounds, words), flush=True)
    lines = [line.replace(f"{model}: ", "").replace(f"{picture}: ", "") for line in done.stderr.splitlines()]
    print(*["    " + line for line in lines], sep="\n", flush=True)
    label = [name, f"{seconds:.0f} s" if look else f"exit code {done.returncode}"]
    if words:
        label[1] += ": " + ", ".join(words)
    width, height = map(int, options.tile.split("x"))
    return tiles.labelled(tiles.opened(picture, (width, height)), label)


def main():
    options = parse(sys.argv[1:])
    models = find_models(options)
    if not models:
        sys.exit(f"{options.folder}: no models")
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.keep or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        print(f"{'model':40} code sec    lum  black burnt  wide high aside above")
        sheet = tiles.grid([render(options, name, model, folder) for name, model in models], options.columns)
        sheet.save(options.sheet)


if __name__ == "__main__":
    main()
