#!/usr/bin/env python3
"""Renders every model of a folder small, and puts the images on one sheet for the eye.

    contact_sheet.py COMMAND FOLDER SHEET.png [--size WxH] [--spp N] [--columns N] [--only TEXT]
                     [--skip NAME,...]

A model is a .gltf or .glb file below FOLDER; a few words of what bdpt said about it go to the standard output, and its
name stands below its image. What is refused is a dark tile. Needs oiiotool.
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "figures"))
import sheet


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("sheet", type=pathlib.Path)
    parser.add_argument("--size", default="192x144")
    parser.add_argument("--spp", type=int, default=16)
    parser.add_argument("--columns", type=int, default=8)
    parser.add_argument("--only", default="", help="models whose path has this text")
    parser.add_argument("--skip", default="hostile", help="folders to leave out, with commas between them")
    return parser.parse_args(words)


def find_models(folder, only, skip):
    files = [file for file in folder.rglob("*") if file.suffix in (".gltf", ".glb")]
    return sorted(file for file in files
                  if only in file.relative_to(folder).as_posix() and not set(file.parts) & set(skip.split(",")))


def render(command, model, image, size, spp):
    """The lines that the command says, without the name of the file."""
    words = [command, "render", model, "-o", image, "--size", size, "--spp", str(spp)]
    done = subprocess.run(words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                          text=True, timeout=600, check=False)
    lines = [line.removeprefix("bdpt: ").replace(f"{model}: ", "") for line in done.stderr.splitlines()]
    return done.returncode, [line for line in lines if line.startswith(("warning", "error"))]


def make_tile(image, tile, text, size):
    """The image, or a dark one where there is none, with its name below."""
    shape = tuple(map(int, size.split("x")))
    if not image.exists():
        sheet.oiiotool("--pattern", "constant:color=0.1,0,0", size, 3, "-d", "uint8", "-o", image)
    sheet.shown(image, shape, ["--ch", "R,G,B"], [text], tile, least=shape[0])


def main():
    options = parse(sys.argv[1:])
    models = find_models(options.folder, options.only, options.skip)
    if not models:
        sys.exit(f"{options.folder}: no models")
    with tempfile.TemporaryDirectory() as name:
        tiles = []
        for index, model in enumerate(models):
            image, tile = (pathlib.Path(name) / f"{index}-{part}.png" for part in ("picture", "tile"))
            code, lines = render(options.command, model, image, options.size, options.spp)
            label = model.relative_to(options.folder).parts[0]
            print(f"{label}: exit code {code}", *lines, sep="\n    ", flush=True)
            make_tile(image, tile, label[:30], options.size)
            tiles.append(tile)
        sheet.mosaic(tiles, options.columns, options.sheet)


if __name__ == "__main__":
    main()
