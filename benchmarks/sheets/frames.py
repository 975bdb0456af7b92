#!/usr/bin/env python3
"""Arranges images on a sheet, row by row, for example the frames of a turntable.

    frames.py SHEET IMAGE... [--columns N] [--tile WxH] [--labels]

SHEET is a .png or .jpg file. Transparent images are shown over grey. Needs Pillow.
"""

import argparse
import pathlib

from PIL import Image, ImageDraw, ImageFont

LINE = 15  # height of a line of text [px]
GAP = 4  # space between tiles [px]


def font():
    try:
        return ImageFont.truetype("DejaVuSans.ttf", 11)
    except OSError:
        return ImageFont.load_default()


def opened(file, size, page=(40, 40, 40)):
    """Returns the image, over `page` where it is transparent, fitted into `size` and centred; a dark red one if there
    is none."""
    tile = Image.new("RGB", size, page)
    if file is None or not file.exists():
        return Image.new("RGB", size, (60, 10, 10))
    image = Image.open(file).convert("RGBA")
    image.thumbnail(size, Image.Resampling.LANCZOS)
    place = ((size[0] - image.width) // 2, (size[1] - image.height) // 2)
    tile.paste(image, place, image)
    return tile


def labelled(image, lines):
    """Returns the image with lines of text below it, which are cut if they are too long."""
    tile = Image.new("RGB", (image.width, image.height + LINE * len(lines)), (0, 0, 0))
    tile.paste(image, (0, 0))
    draw = ImageDraw.Draw(tile)
    for number, line in enumerate(lines):
        while line and draw.textlength(line, font=font()) > image.width - 4:
            line = line[:-1]
        draw.text((2, image.height + LINE * number), line, fill=(255, 255, 255), font=font())
    return tile


def grid(tiles, columns):
    """Arranges all tiles row by row."""
    columns = min(columns, len(tiles))
    width = max(tile.width for tile in tiles) + GAP
    rows = [tiles[first:first + columns] for first in range(0, len(tiles), columns)]
    heights = [max(tile.height for tile in row) + GAP for row in rows]
    sheet = Image.new("RGB", (width * columns - GAP, sum(heights) - GAP), (0, 0, 0))
    top = 0
    for row, height in zip(rows, heights):
        for column, tile in enumerate(row):
            sheet.paste(tile, (column * width, top))
        top += height
    return sheet


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sheet", type=pathlib.Path)
    parser.add_argument("images", type=pathlib.Path, nargs="+")
    parser.add_argument("--columns", type=int, default=6)
    parser.add_argument("--tile", default="160x90", help="size of an image on the sheet [px]")
    parser.add_argument("--labels", action="store_true", help="names of files below the images")
    options = parser.parse_args()
    size = tuple(map(int, options.tile.split("x")))
    shown = [labelled(opened(image, size), [image.stem] if options.labels else [])
             for image in options.images]
    grid(shown, options.columns).save(options.sheet, quality=88)


if __name__ == "__main__":
    main()
