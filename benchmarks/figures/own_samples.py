#!/usr/bin/env python3
"""Computes the bias of adaptive sampling that keeps its pilot samples: own_samples.py [--spp N] [--probability P]
[--plot FILE]

The samples of a pixel are bright with probability P, else black; the true mean is 1. A pilot of n samples gives the
pixel four times the samples if it has found light, and a quarter if it has not. Prints the exact expectation of the
pixel, with the pilot's samples kept and with separate ones, for several pilot sizes. --plot needs matplotlib."""

import argparse
import math


def binomial(n, k, p):
    return math.comb(n, k) * p**k * (1.0 - p) ** (n - k)


def choose_samples(found, spp):
    return 4 * spp if found > 0 else spp // 4


def compute_expectation_with_own_samples(pilot, spp, p):
    """Returns the expected mean over all samples, the pilot's included, whose result also decides their number."""
    total = 0.0
    for found in range(pilot + 1):
        samples = max(choose_samples(found, spp), pilot)
        total += binomial(pilot, found, p) * (found / p + samples - pilot) / samples
    return total


def compute_expectation_with_fresh_samples(pilot, spp, p):
    """Returns the expected mean over samples that are independent of the pilot: 1, whatever the pilot found."""
    total = 0.0
    for found in range(pilot + 1):
        samples = choose_samples(found, spp)
        total += binomial(pilot, found, p) * sum(binomial(samples, k, p) * k / p / samples for k in range(samples + 1))
    return total


def plot(rows, file):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(figsize=(6.4, 3.6))
    pilots, own, fresh = zip(*rows)
    axes.axhline(1.0, color="grey", linewidth=0.8)
    axes.semilogx(pilots, own, "o-", base=2, label="BIASED: the samples that decide are kept")
    axes.semilogx(pilots, fresh, "s-", base=2, label="a pilot of its own")
    axes.set_xticks(pilots, pilots)
    axes.set_xlabel("samples of the pilot")
    axes.set_ylabel("mean of the pixel; the truth is 1")
    axes.set_ylim(0.0, 1.1)
    axes.legend(loc="lower left")
    figure.tight_layout()
    figure.savefig(file, dpi=100)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spp", type=int, default=256, help="samples per pixel in the mean, a multiple of 4 (256)")
    parser.add_argument("--probability", type=float, default=0.02, help="of a bright sample (0.02)")
    parser.add_argument("--plot", metavar="FILE", help="draw the numbers, too")
    arguments = parser.parse_args()
    rows = []
    print(f"{'pilot':>6} {'own samples':>12} {'samples of its own':>19}")
    for pilot in (2, 4, 8, 16, 32, 64):
        own, fresh = (f(pilot, arguments.spp, arguments.probability)
                      for f in (compute_expectation_with_own_samples, compute_expectation_with_fresh_samples))
        rows.append((pilot, own, fresh))
        print(f"{pilot:6} {own:12.3f} {fresh:19.3f}")
    if arguments.plot:
        plot(rows, arguments.plot)


if __name__ == "__main__":
    main()
