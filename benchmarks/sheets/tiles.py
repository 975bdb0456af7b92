"""Makes sheets of labelled images with Pillow, and measures images."""

import numpy
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


def brightness(file):
    """Returns the mean luminance (linear), and the shares of pixels that are black (no channel above 8 of 255) and
    burnt out (no channel below 250)."""
    codes = numpy.asarray(Image.open(file).convert("RGB"), dtype=float)
    unit = codes / 255
    linear = numpy.where(unit <= 0.04045, unit / 12.92, ((unit + 0.055) / 1.055) ** 2.4)
    luminance = linear @ numpy.array([0.2126, 0.7152, 0.0722])
    return {"luminance": luminance.mean(), "black": (codes.max(axis=2) <= 8).mean(),
            "burnt": (codes.min(axis=2) >= 250).mean()}


def extent(file):
    """Returns width and height of the opaque part, and the distance of its centre from the image's, as shares of the
    image; None if all is transparent."""
    alpha = numpy.asarray(Image.open(file).convert("RGBA"))[:, :, 3] > 12
    if not alpha.any():
        return None
    columns, rows = numpy.flatnonzero(alpha.any(axis=0)), numpy.flatnonzero(alpha.any(axis=1))
    height, width = alpha.shape
    return {"width": (columns[-1] - columns[0] + 1) / width, "height": (rows[-1] - rows[0] + 1) / height,
            "aside": abs(columns[0] + columns[-1] + 1 - width) / 2 / width,
            "above": abs(rows[0] + rows[-1] + 1 - height) / 2 / height}
