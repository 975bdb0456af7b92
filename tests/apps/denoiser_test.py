#!/usr/bin/env python3
"""Tests bdpt render --denoise with the real Open Image Denoise: denoiser_test.py BDPT SCENES.

Takes the library from the environment variable BDPT_TEST_DENOISER, a file or its folder; exits with 77 if it is not
set. Renders few samples of scenes whose light comes from splats, from camera samples and from both, and compares
errors. Then tests a scene on a shadow catcher: the noise of the shadow must go, and edges must not get worse over
another background.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "ids"))
from exr_file import ExrFile

# Each row has a scene, render options, and the limit of the remaining error. Splats become as clean as the rest.
CASES = [
    ("lamp-box", ["--integrator", "bdpt"], 0.2),
    ("lamp-box", ["--integrator", "lt"], 0.2),
    ("cornell-box", ["--integrator", "mis"], 0.4),
    ("caustic-metal", ["--integrator", "bdpt"], 0.5),
]
SIZE = ["--size", "96x96", "--quiet"]


def channel(exr, name):
    return [value for row in exr.values[name] for value in row]


def mean_square(first, second, chosen):
    return sum((first[i] - second[i]) ** 2 for i in chosen) / len(chosen)


def composite_over_white(exr, color, shadow):
    """Composites a transparent image over white; its shadow is in another layer."""
    alpha = [a - s for a, s in zip(channel(exr, "A"), channel(exr, "shadow.A"))]
    return [r + 1 - a - s for r, a, s in zip(channel(exr, color), alpha, channel(exr, shadow))]


def check_shadow_catcher(bdpt, scenes, library, folder):
    words = [bdpt, "render", os.path.join(scenes, "instances.gltf"), "--env", "default", "--camera", "auto", "--background",
             "transparent", "--ground", "shadow", "--integrator", "mis", *SIZE]
    reference, clean = (pathlib.Path(folder, name) for name in ("long.exr", "short.exr"))
    subprocess.run([*words, "--spp", "256", "--seed", "1", "-o", reference], check=True)
    subprocess.run([*words, "--spp", "16", "--denoise", "--denoiser-library", library, "-o", clean], check=True)
    reference, exr = ExrFile(reference), ExrFile(clean)
    shadow, noisy, true = channel(exr, "shadow.A"), channel(exr, "noisyShadow.A"), channel(reference, "shadow.A")
    coverage = [a - s for a, s in zip(channel(reference, "A"), true)]
    everywhere, edges = range(len(true)), [i for i, share in enumerate(coverage) if 0.01 < share < 0.99]
    white = composite_over_white(reference, "R", "shadow.A")
    figures = {
        "shadow": [mean_square(x, true, everywhere) for x in (noisy, shadow)],
        "edges": [mean_square(x, white, edges)
                  for x in (composite_over_white(exr, "noisy.R", "noisyShadow.A"), composite_over_white(exr, "R", "shadow.A"))],
    }
    for name, (before, after) in figures.items():
        print(f"shadow catcher, {name}: mean square error {before:.4g}, denoised {after:.4g}")
    means = sum(noisy) / len(noisy), sum(shadow) / len(shadow)
    print(f"shadow catcher: mean {means[0]:.5f}, denoised {means[1]:.5f}; {len(edges)} pixels of edges")
    faults = [f"shadow catcher: {name} got worse, or hardly better" for name, most in (("shadow", 0.25), ("edges", 0.5))
              if not figures[name][1] < most * figures[name][0]]
    if not (means[0] > 0.01 and abs(means[1] / means[0] - 1) < 0.02):
        faults.append("shadow catcher: the mean of the shadow is another one")
    alpha, red = channel(exr, "A"), channel(exr, "R")
    if any(red[i] != 0 for i in everywhere if alpha[i] == shadow[i]):
        faults.append("shadow catcher: light where nothing is")
    return faults


def main():
    bdpt, scenes = sys.argv[1:3]
    library = os.environ.get("BDPT_TEST_DENOISER")
    if not library:
        print("skipped: BDPT_TEST_DENOISER is not set")
        return 77
    faults = []
    with tempfile.TemporaryDirectory() as folder:
        def error(image, reference):
            said = subprocess.run([bdpt, "compare", image, reference, "--json", "--metrics", "relmse"], check=True,
                                  capture_output=True, text=True).stdout
            return json.loads(said)["metrics"]["relmse"]["mean"]

        for scene, options, most in CASES:
            scene_file = os.path.join(scenes, scene + ".gltf")
            paths = {name: os.path.join(folder, name + ".exr") for name in ("reference", "noisy", "clean")}
            subprocess.run([bdpt, "render", scene_file, *SIZE, "--integrator", "bdpt", "--seed", "1", "--spp", "256", "-o",
                            paths["reference"]], check=True)
            subprocess.run([bdpt, "render", scene_file, *SIZE, *options, "--spp", "8", "-o", paths["noisy"]], check=True)
            subprocess.run([bdpt, "render", scene_file, *SIZE, *options, "--spp", "8", "-o", paths["clean"], "--denoise",
                            "--denoiser-library", library], check=True)
            noisy, clean = (error(paths[name], paths["reference"]) for name in ("noisy", "clean"))
            print(f"{scene} {' '.join(options)}: relmse {noisy:.4g}, denoised {clean:.4g}")
            if not clean < most * noisy:
                faults.append(f"{scene}: {clean} is not below {most} of {noisy}")
        faults += check_shadow_catcher(bdpt, scenes, library, folder)
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
