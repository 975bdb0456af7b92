"""Processes images with oiiotool: mean values, maxima, and sheets of cells with captions."""

import functools
import glob
import math
import re
import subprocess
import tempfile

CELL = 208  # minimum width of a cell on a sheet [px]
LINE = 16  # height of a line of caption [px]


def oiiotool(*arguments):
    """Runs oiiotool; returns its output. Raises CalledProcessError."""
    done = subprocess.run(["oiiotool", "--nosoftwareattrib", *map(str, arguments)], check=True, capture_output=True, text=True)
    return done.stdout


def mean(image, channels="R,G,B"):
    """Returns the means of red, green and blue [nit], or of other channels."""
    line = re.search(r"Stats Avg: (.*) \(float\)", oiiotool(image, "--ch", channels, "--printstats"))
    return [float(word) for word in line[1].split()]


def mean_of_maxima(pairs, output):
    """Writes the mean of the pixelwise maxima of pairs of images."""
    arguments = []
    for number, (first, second) in enumerate(pairs):
        arguments += [first, second, "--max"] + (["--add"] if number else [])
    oiiotool(*arguments, "--divc", len(pairs), "-d", "float", "-o", output)


@functools.lru_cache(maxsize=None)
def font():
    """Returns the first font that oiiotool can use; None if there is none."""
    files = glob.glob("/usr/share/fonts/**/*.ttf", recursive=True) + glob.glob("/Library/Fonts/*.ttf")
    favourites = ("DejaVuSans.ttf", "LiberationSans-Regular.ttf", "NotoSans-Regular.ttf", "Arial.ttf")
    files.sort(key=lambda file: (not file.endswith(favourites), file))
    for file in files[:8]:
        try:
            with tempfile.NamedTemporaryFile(suffix=".png") as probe:
                oiiotool("--create", "32x16", 3, f"--text:font={file}:size=8:x=1:y=12", "a", "-o", probe.name)
            return file
        except subprocess.CalledProcessError:
            continue
    return None


def developed(exposure):
    """Returns the oiiotool arguments that convert radiance, times 2^exposure, to sRGB."""
    return ["--ch", "R,G,B", "--mulc", 2 ** exposure, "--clamp:min=0:max=1", "--colorconvert", "linear", "sRGB"]


def false_colours(channel, greatest):
    """Returns the oiiotool arguments that map a channel from 0 to `greatest` to colours from black to yellow."""
    return ["--ch", channel, "--mulc", 1 / greatest, "--clamp:min=0:max=1", "--colormap", "inferno"]


def shown(image, size, look, lines, output, least=CELL):
    """Writes a cell, at least `least` pixels wide: the image, converted by `look`, and lines of text below it if there
    is a font."""
    width, height = size
    factor = math.ceil(least / width)
    width, height = width * factor, height * factor
    caption = 4 + LINE * len(lines) if font() else 0
    text = []
    for number, line in enumerate(lines if font() else ()):
        text += [f"--text:font={font()}:size=12:x=4:y={height + 15 + LINE * number}:color=1,1,1", line]
    oiiotool(image, *look, "--resample:interp=0", f"{width}x{height}", "--create", f"{width}x{height + caption}", 3,
             "--paste", "+0+0", *text, "-d", "uint8", "-o", output)


def mosaic(cells, columns, output):
    """Arranges all cells row by row; leaves the rest of the last row black."""
    rows = math.ceil(len(cells) / columns)
    oiiotool(*cells, *[argument for _ in range(rows * columns - len(cells)) for argument in ("--create", "1x1", 3)],
             "--mosaic:pad=4", f"{columns}x{rows}", "-d", "uint8", "-o", output)
