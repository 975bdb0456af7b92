#!/usr/bin/env python3
"""Compares the choice of --integrator auto with the best choice by hand: hand_table.py BDPT [SCENE...]

Renders each scene with mis and with all numbers of light paths and connections that auto chooses from. Prints the
choice of auto, the product of its least time and relMSE over the least product of all, and the same with relMSE without
the ten pixels of largest error. The noise column is one standard error of the first ratio, as a factor, by the
jackknife over seeds; the least of 23 noisy products is biased low. Times are those of rendering, without the
pilot. Errors are those of auto_table.py. Needs numpy."""

import argparse
import json
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import numpy as np
import seed_errors

ROOT = pathlib.Path(__file__).resolve().parents[2]
HEADER = ROOT / "lib/src/pilot/candidates.h"


def read_candidates():
    """Returns (light paths, connections, connection rays) of each candidate; the first, without light paths, is mis."""
    text = HEADER.read_text()
    found = re.findall(r"Candidate\{([\d., ]+)\}", text)
    if len(found) != text.count("Candidate{") or not found:
        sys.exit(f"{HEADER}: its candidates have another form than this script reads")
    return [tuple(float(number) for number in (*each.split(","), "0")[:3]) for each in found]


def render(scene, arguments, image, *options):
    """Renders a scene, a file and options for it; returns the content of `--stats`."""
    told = subprocess.run([arguments.bdpt, "render", *scene, "--size", arguments.size, "-o", image, "--quiet",
                           "--threads", "1", "--stats", "-", *options], check=True, capture_output=True, text=True)
    return json.loads(told.stdout)


def bdpt_options(n, c, rays):
    return ("--integrator", "bdpt", "--light-paths", f"{n:g}", "--connections", f"{c:g}", "--connection-rays", f"{rays:g}")


def convert_settings(settings):
    """Returns the options of a render with these settings."""
    if settings["integrator"] == "mis":
        return ("--integrator", "mis")
    n = settings["light_paths"]
    return bdpt_options(n, settings.get("connections", n), settings.get("connection_rays", 0))


def list_candidates():
    """Returns the options of all choices."""
    return [("--integrator", "mis"), *(bdpt_options(*numbers) for numbers in read_candidates()[1:])]


def format_options(options):
    return "mis" if len(options) == 2 else f"n {options[3]} c {options[5]}" + ("" if options[7] == "0" else f" K {options[7]}")


def compute_products(seconds, images, seeds, without):
    """Returns least time times error for each choice, from the given seeds."""
    judge = seed_errors.SeedErrors([each[seeds] for each in images])
    return np.array([min(time[seed] for seed in seeds) * judge.variance(each[seeds], 1, without)
                     for time, each in zip(seconds, images)])


def estimate_noise(seconds, images, chosen, best):
    def ratio(seeds):
        some = compute_products(seconds, images, seeds, 0)
        return some[chosen] / some[best]
    return seed_errors.noise(len(seconds[0]), ratio)


def compare_choices(name, scene, arguments):
    """Renders a scene with all choices and prints its row; returns the product of the choice of auto over the least."""
    all_choices = list_candidates()
    seconds, images = ([[] for _ in all_choices] for _ in range(2))
    with tempfile.TemporaryDirectory() as folder:
        image = pathlib.Path(folder) / "image.exr"
        told = render(scene, arguments, image, "--integrator", "auto", "--spp", "1")
        chosen = all_choices.index(convert_settings(told["settings"]))
        for seed in range(1, arguments.seeds + 1):
            for i, options in enumerate(all_choices):
                told = render(scene, arguments, image, "--spp", str(arguments.spp), "--seed", str(seed), *options)
                seconds[i].append(told["seconds"]["render"])
                images[i].append(seed_errors.pixels(image))
    images = [np.stack(each) for each in images]
    every = list(range(arguments.seeds))
    found = compute_products(seconds, images, every, 0)
    dotless = compute_products(seconds, images, every, seed_errors.DOTS)
    best = int(np.argmin(found))
    noise = f"{estimate_noise(seconds, images, chosen, best):6.2f}" if arguments.seeds > 2 else f"{'':6}"
    if arguments.all:
        for options, product, without in zip(all_choices, found, dotless):
            print(f"  {format_options(options):41} {product / found[best]:8.2f} {without / dotless.min():8.2f}")
    print(f"{name:26} {format_options(all_choices[chosen]):16} {format_options(all_choices[best]):16} "
          f"{found[chosen] / found[best]:8.2f} {dotless[chosen] / dotless.min():8.2f} "
          f"{noise}", flush=True)
    return found[chosen] / found[best]


def compare_scenes(scenes, arguments):
    """Prints a table of named scenes."""
    print(f"{'scene':26} {'auto chose':16} {'best by hand':16} {'over it':>8} {'no dots':>8} {'noise':>6}", flush=True)
    ratios = [compare_choices(name, scene, arguments) for name, scene in scenes]
    print(f"{'geometric mean':26} {'':16} {'':16} {statistics.geometric_mean(ratios):8.2f}")


def make_parser(description, size, spp):
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bdpt", type=pathlib.Path)
    parser.add_argument("--size", default=size, help=f"of the image ({size})")
    parser.add_argument("--spp", type=int, default=spp, help=f"samples per pixel ({spp})")
    parser.add_argument("--seeds", type=int, default=4, help="renders with each choice (4); the noise column needs three")
    parser.add_argument("--all", action="store_true", help="also print the products of all choices")
    return parser


def main():
    parser = make_parser(__doc__, "256x256", 32)
    parser.add_argument("scenes", nargs="*", type=pathlib.Path, metavar="SCENE", help="default: all of scenes/")
    arguments = parser.parse_intermixed_args()
    scenes = arguments.scenes or sorted((ROOT / "scenes").glob("*.gltf"))
    compare_scenes([(scene.stem, (scene,)) for scene in scenes], arguments)
    return 0


if __name__ == "__main__":
    sys.exit(main())
