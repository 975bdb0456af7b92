"""Estimates errors of renders from the spread between seeds, so that no noise of a reference counts."""

import math
import pathlib
import statistics
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "same_bits"))
import exr_bits

SCALES = (1, 2, 4, 8, 16)  # [pixels], like those of relmse_scales
SMOOTHING = 8  # [pixels] in each direction
EPSILON = 0.01  # relative to the square of the mean, as in `bdpt compare --relative`
DOTS = 10  # number of pixels of largest error that can be left out: rare bright paths dominate them


def pixels(file):
    """Reads an image as height x width x 3, R G B."""
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
    """Averages images over squares of `side` pixels; cuts off the remainder at the right and below."""
    n, height, width, channels = images.shape
    rows, columns = height // side, width // side
    cut = images[:, :rows * side, :columns * side]
    return cut.reshape(n, rows, side, columns, side, channels).mean(axis=(2, 4))


def smooth(image, reach):
    """Averages over squares of 2 reach + 1 pixels. The divisor of a relative error must not share the noise of the
    error: where light is rare, a bright dot would be divided by itself."""
    padded = np.pad(image, ((reach + 1, reach), (reach + 1, reach), (0, 0)), mode="edge")
    sums = padded.cumsum(axis=0).cumsum(axis=1)
    side = 2 * reach + 1
    return (sums[side:, side:] - sums[:-side, side:] - sums[side:, :-side] + sums[:-side, :-side]) / side ** 2


def compute_relative_error(squares, mean, side, without=0):
    """Returns the mean relative error over pixels, without the `without` largest."""
    brightness = smooth(mean, SMOOTHING // side)
    of_pixels = np.sort((squares / (brightness ** 2 + EPSILON * mean.mean() ** 2)).mean(axis=-1), axis=None)
    return float(of_pixels[:of_pixels.size - without].mean())


class SeedErrors:
    """Estimates relMSE of one image from several seeds, each array seeds x height x width x 3. `sound` are images by
    integrators that miss no light; their smoothed mean is the brightness that errors are relative to."""

    def __init__(self, sound):
        self.sound = sound

    def variance(self, images, side, without=0):
        """Returns the relative variance of averages over squares of `side` pixels."""
        own = averages(images, side)
        return compute_relative_error(own.var(axis=0, ddof=1), self.mean(side), side, without)

    def bias(self, images, side):
        """Returns the relative squared bias of averages over squares of `side` pixels, less the noise of both means."""
        own = averages(images, side)
        others = [averages(sound, side) for sound in self.sound]
        noise = (sum(each.var(axis=0, ddof=1) / len(each) for each in others) / len(others) ** 2
                 + own.var(axis=0, ddof=1) / len(own))
        mean = self.mean(side)
        return max(0.0, compute_relative_error((own.mean(axis=0) - mean) ** 2 - noise, mean, side))

    def mean(self, side):
        return np.mean([averages(sound, side).mean(axis=0) for sound in self.sound], axis=0)

    def errors(self, images):
        """Returns relMSE, its mean over scales, and relMSE without dots, of an integrator that misses no light."""
        over_scales = [self.variance(images, side) for side in SCALES]
        return np.array([over_scales[0], np.mean(over_scales), self.variance(images, 1, DOTS)])

    def biases(self, images):
        """Returns what missing light adds to `errors`."""
        over_scales = [self.bias(images, side) for side in SCALES]
        return np.array([over_scales[0], np.mean(over_scales), over_scales[0]])


def noise(seeds, ratio):
    """Returns one standard error of a ratio as a factor >= 1, by the jackknife. `ratio` computes the ratio from a list
    of seeds."""
    logs = [math.log(ratio([seed for seed in range(seeds) if seed != left_out])) for left_out in range(seeds)]
    return math.exp(math.sqrt((seeds - 1) * statistics.pvariance(logs)))
