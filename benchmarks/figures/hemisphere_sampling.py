#!/usr/bin/env python3
"""Prints the noise of four ways to sample direct light: hemisphere_sampling.py [--samples 1000000] [--seed 0].

A white Lambertian floor lies under a square lamp at a height of 1; points are below its centre and beside it. The ways
are: uniform hemisphere sampling, cosine-weighted sampling, uniform points on the lamp, and MIS of the last two with the
power heuristic. The table has the variance of one sample over the square of the closed form [Lambert 1760]; MIS takes
two samples, so its variance is doubled and all lines are at equal samples. Uses no code of bdpt, which has no uniform
hemisphere sampling. Needs NumPy.
"""

import argparse
import math
import sys

import numpy as np

HEIGHT = 1.0
CASES = [("small lamp, below it", 0.2, 0.0), ("small lamp, beside it", 0.2, 2.0), ("lamp as wide as high, below it", 1.0, 0.0),
         ("lamp ten times as wide, below it", 10.0, 0.0)]


def irradiance(width, aside):
    """Returns the irradiance at the origin by a lamp of radiance 1: half the sum, over its edges, of the angle times
    the upward component of the normal of the plane through origin and edge."""
    half = width / 2
    corners = np.array([[aside - half, -half, HEIGHT], [aside - half, half, HEIGHT], [aside + half, half, HEIGHT],
                        [aside + half, -half, HEIGHT]])
    total = 0.0
    for a, b in zip(corners, np.roll(corners, -1, axis=0)):
        cross = np.cross(a, b)
        angle = math.atan2(np.linalg.norm(cross), a @ b)
        total += angle * cross[2] / np.linalg.norm(cross)
    return abs(total) / 2


def on_lamp(direction, width, aside):
    with np.errstate(divide="ignore", invalid="ignore"):
        x, y = (direction[:, i] * HEIGHT / direction[:, 2] for i in (0, 1))
        return (np.abs(x - aside) <= width / 2) & (np.abs(y) <= width / 2)


def directions(random, count, cosine):
    """Samples directions; returns them and their pdf per solid angle."""
    u, phi = random.random(count), 2 * np.pi * random.random(count)
    z = np.sqrt(u) if cosine else u
    r = np.sqrt(1 - z * z)
    return np.stack([r * np.cos(phi), r * np.sin(phi), z], 1), (z / np.pi if cosine else np.full(count, 1 / (2 * np.pi)))


def lamp_directions(random, count, width, aside):
    point = np.stack([aside + width * (random.random(count) - 0.5), width * (random.random(count) - 0.5),
                      np.full(count, HEIGHT)], 1)
    distance = np.linalg.norm(point, axis=1)
    direction = point / distance[:, None]
    return direction, lamp_density(direction, width)


def lamp_density(direction, width):
    """Returns the pdf per solid angle of a direction that hits the lamp: distance^2 / (cosine area)."""
    return HEIGHT ** 2 / direction[:, 2] ** 3 / width ** 2


def estimates(random, count, width, aside):
    """Returns samples of the irradiance, by the name of the way."""
    result, samples = {}, {}
    for name, cosine in (("uniform", False), ("cosine", True)):
        d, pdf = directions(random, count, cosine)
        samples[name] = d, pdf
        result[name] = np.where(on_lamp(d, width, aside), d[:, 2] / pdf, 0.0)
    d, pdf = lamp_directions(random, count, width, aside)
    result["light"] = d[:, 2] / pdf
    other = d[:, 2] / np.pi
    pair = result["light"] * pdf ** 2 / (pdf ** 2 + other ** 2)
    d, pdf = samples["cosine"]
    other = lamp_density(d, width)
    with np.errstate(over="ignore", invalid="ignore"):
        pair = pair + np.where(result["cosine"] > 0, result["cosine"] * pdf ** 2 / (pdf ** 2 + other ** 2), 0.0)
    result["both (MIS)"] = pair
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--samples", type=int, default=1_000_000)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    random = np.random.default_rng(arguments.seed)
    print("| variance at equal samples | uniform | cosine | light | both (MIS) |\n|---|---|---|---|---|")
    for label, width, aside in CASES:
        truth, cells = irradiance(width, aside), []
        for name, values in estimates(random, arguments.samples, width, aside).items():
            error = values.std() / math.sqrt(len(values))
            if abs(values.mean() - truth) > 5 * error + 1e-9:
                sys.exit(f"{label}, {name}: mean {values.mean():.6g}, but {truth:.6g} is true")
            variance = values.var() / truth ** 2 * (2 if name.startswith("both") else 1)
            cells.append(f"{variance:.2g}" if variance < 100 else f"{variance:,.0f}")
        print(f"| {label} | {' | '.join(cells)} |")


if __name__ == "__main__":
    main()
