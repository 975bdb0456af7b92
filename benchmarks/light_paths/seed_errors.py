"""Errors of renders from the spread between seeds, without a reference whose own noise would count."""

import math
import pathlib
import statistics
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "same_bits"))
import exr_bits

SCALES = (1, 2, 4, 8, 16)  # [pixels], as those of relmse_scales
SMOOTHING = 8  # [pixels] on every side
EPSILON = 0.01  # relative to the square of the mean, as `bdpt compare --relative` has it
DOTS = 10  # pixels that can be left out: those of largest error, where rare bright paths landed


def pixels(file):
    """Height x width x 3, R G B."""
    image = exr_bits.read_exr(pathlib.Path(file).read_bytes())
    kinds = {2: (np.uint16, np.float16), 4: (np.uint32, np.float32)}
    planes = []
    for name in "RGB":
        channel = image.channels[name]
        bits, floats = kinds[channel.length]
        plane = np.array(channel.bits, bits).view(floats).astype(np.float64)
        planes.append(plane.reshape(image.height, image.width))
    return np.stack(planes, axis=-1)


def averages(images, side):
    """Of squares of `side` pixels; what is left over at the right and below is cut off."""
    n, height, width, channels = images.shape
    rows, columns = height // side, width // side
    cut = images[:, :rows * side, :columns * side]
    return cut.reshape(n, rows, side, columns, side, channels).mean(axis=(2, 4))


def smoothed(image, reach):
    """Means over squares of 2 reach + 1 pixels. A divisor must not have the noise that it divides: where light is rare,
    a bright dot would be compared with itself."""
    padded = np.pad(image, ((reach + 1, reach), (reach + 1, reach), (0, 0)), mode="edge")
    sums = padded.cumsum(axis=0).cumsum(axis=1)
    side = 2 * reach + 1
    return (sums[side:, side:] - sums[:-side, side:] - sums[side:, :-side] + sums[:-side, :-side]) / side ** 2


def relative(squares, mean, side, without=0):
    """Mean over pixels, `without` so many of the largest."""
    brightness = smoothed(mean, SMOOTHING // side)
    of_pixels = np.sort((squares / (brightness ** 2 + EPSILON * mean.mean() ** 2)).mean(axis=-1), axis=None)
    return float(of_pixels[:of_pixels.size - without].mean())


class SeedErrors:
    """relMSE of one image, from those of several seeds, each seeds x height x width x 3. `sound` are of integrators that
    miss no light: their mean, smoothed, stands for the brightness that errors are relative to."""

    def __init__(self, sound):
        self.sound = sound

    def error(self, images, biased, side, without=0):
        """Over squares of `side` pixels. What a `biased` integrator misses counts, less the noise of both means."""
        own = averages(images, side)
        others = [averages(sound, side) for sound in self.sound]
        mean = np.mean([each.mean(axis=0) for each in others], axis=0)
        variance = own.var(axis=0, ddof=1)
        error = relative(variance, mean, side, without)
        if biased:
            noise = sum(each.var(axis=0, ddof=1) / len(each) for each in others) / len(others) ** 2 + variance / len(own)
            error += max(0.0, relative((own.mean(axis=0) - mean) ** 2 - noise, mean, side))
        return error

    def errors(self, images, biased=False):
        """relMSE, its mean over scales, and relMSE without dots."""
        over_scales = [self.error(images, biased, side) for side in SCALES]
        return np.array([over_scales[0], np.mean(over_scales), self.error(images, biased, 1, DOTS)])


def noise(seeds, ratio):
    """One standard error of a ratio, as a factor >= 1: the jackknife's. `ratio` makes it from some of so many seeds."""
    logs = [math.log(ratio([seed for seed in range(seeds) if seed != left_out])) for left_out in range(seeds)]
    return math.exp(math.sqrt((seeds - 1) * statistics.pvariance(logs)))
