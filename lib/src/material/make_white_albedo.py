#!/usr/bin/env python3
"""Writes white_albedo.cpp: integrates the albedo of white microfacets. Takes about a minute."""
import math
import pathlib

COSINES = 64
ROUGHNESSES = 32
AVERAGES = 125  # between tables of roughness, the average is not linear
HEIGHTS = 128
AZIMUTHS = 48
# Nowhere between the nodes is the interpolated albedo less than the integral by more than 0.0005 - MARGIN, so that
# metals do not make light.
MARGIN = 0.0002
SMOOTHEST = 1e-3  # stands for roughness 0: the table has a limit

SINES = [math.sin(math.pi * (j + 0.5) / AZIMUTHS) for j in range(AZIMUTHS)]
COSES = [math.cos(math.pi * (j + 0.5) / AZIMUTHS) for j in range(AZIMUTHS)]


def integrate(cosine, roughness):
    """Returns the mean of G2 / G1 over visible normals [Heitz 2018]."""
    alpha = roughness * roughness
    sine = math.sqrt(max(0.0, 1.0 - cosine * cosine))
    stretch = math.hypot(cosine, alpha * sine)
    top, tilt = cosine / stretch, alpha * sine / stretch
    total = 0.0
    for i in range(HEIGHTS):
        left = 1.0 - (i + 0.5) / HEIGHTS
        depth = (1.0 - left ** 3) * (1.0 + top)
        radius = math.sqrt(max(0.0, depth * (2.0 - depth)))
        z = 1.0 - depth + top
        around = 0.0
        for j in range(AZIMUTHS):
            x, y = alpha * (radius * COSES[j] + tilt), alpha * radius * SINES[j]
            square = x * x + y * y + z * z
            along = 2.0 * (sine * x + cosine * z) / square
            up = along * z - cosine
            if up > 0.0:
                far = math.sqrt(up * up + alpha * alpha * max(0.0, 1.0 - up * up))
                around += up * (cosine + stretch) / (up * stretch + cosine * far)
        total += 3.0 * left * left * around
    return total / (HEIGHTS * AZIMUTHS)


def row(roughness):
    used = max(roughness, SMOOTHEST)
    albedos = []
    for column in range(COSINES):
        t = column / (COSINES - 1)
        root = used * t / (1.0 + used - t)  # inverts t = root (1 + roughness) / (root + roughness)
        albedos.append(round(min(1.0, integrate(min(1.0, root * root), used) + MARGIN), 4))
    return albedos


def average(rows, roughness):
    """Returns the cosine-weighted average of the interpolated albedo."""
    scaled = roughness * (ROUGHNESSES - 1)
    lower = min(int(scaled), ROUGHNESSES - 2)
    steps = 4000
    total = 0.0
    for i in range(steps):
        x = (i + 0.5) / steps
        place = x * (1.0 + roughness) / (x + roughness) * (COSINES - 1)
        column = min(int(place), COSINES - 2)
        across = [r[column] + (place - column) * (r[column + 1] - r[column]) for r in rows[lower:lower + 2]]
        total += 4.0 * x ** 3 * (across[0] + (scaled - lower) * (across[1] - across[0]))
    return total / steps


def lines(values, digits):
    words = [f"{value:.{digits}f}f," for value in values]
    return "\n".join("    " + " ".join(words[i:i + 12]) for i in range(0, len(words), 12))


def main():
    rows = [row(i / (ROUGHNESSES - 1)) for i in range(ROUGHNESSES)]
    averages = [average(rows, i / (AVERAGES - 1)) for i in range(AVERAGES)]
    text = f"""// Written by make_white_albedo.py.
#include "material/specular_albedo.h"

namespace bdpt {{

// clang-format off
const std::array<float, WhiteAlbedo::roughness_nodes * WhiteAlbedo::cosine_nodes> WhiteAlbedo::nodes{{
{lines([value for r in rows for value in r], 4)}
}};

const std::array<float, WhiteAlbedo::average_nodes> WhiteAlbedo::averages{{
{lines(averages, 7)}
}};
// clang-format on

}}  // namespace bdpt
"""
    (pathlib.Path(__file__).parent / "white_albedo.cpp").write_text(text, encoding="ascii")


if __name__ == "__main__":
    main()
