#!/usr/bin/env python3
"""Arranges images on a sheet, row by row, for example the frames of a turntable.

    frames.py SHEET IMAGE... [--columns N] [--tile WxH] [--labels]

SHEET is a .png or .jpg file. Transparent images are shown over grey. Needs Pillow and NumPy.
"""

import argparse
import pathlib

import tiles


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sheet", type=pathlib.Path)
    parser.add_argument("images", type=pathlib.Path, nargs="+")
    parser.add_argument("--columns", type=int, default=6)
    parser.add_argument("--tile", default="160x90", help="size of an image on the sheet [px]")
    parser.add_argument("--labels", action="store_true", help="names of files below the images")
    options = parser.parse_args()
    size = tuple(map(int, options.tile.split("x")))
    shown = [tiles.labelled(tiles.opened(image, size), [image.stem] if options.labels else [])
             for image in options.images]
    tiles.grid(shown, options.columns).save(options.sheet, quality=88)


if __name__ == "__main__":
    main()
