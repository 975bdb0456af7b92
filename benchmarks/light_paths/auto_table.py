#!/usr/bin/env python3
"""Compares --integrator auto with mis, lt and bdpt with one light path each: auto_table.py BDPT [SCENE...]

Prints for each scene the choice of auto, the time share of the pilot, and its error at equal CPU time over that of the
best of the three and over that of bdpt. That error is the least CPU time of all seeds (with the pilot) times relMSE,
times relMSE over scales, and times relMSE without the ten pixels of largest error, which shows whether a few rare
bright paths dominate. relMSE comes from the spread between seeds, so no noise of a reference counts. Light that lt
misses is an error that does not fall with time: it is multiplied by the time of auto. The noise column is one standard
error of the first ratio, as a factor, by the jackknife over seeds. Integrators take turns, so that a slow phase of the
machine affects all. Needs numpy."""

import argparse
import json
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import numpy as np
import seed_errors

ROOT = pathlib.Path(__file__).resolve().parents[2]
INTEGRATORS = ("auto", "mis", "lt", "bdpt")


def child_seconds():
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime


def render(bdpt, scene, image, side, *options):
    """Renders the scene; returns CPU seconds."""
    before = child_seconds()
    subprocess.run([bdpt, "render", scene, "--size", f"{side}x{side}", "-o", image, "--quiet", "--threads", "1", *options],
                   check=True)
    return child_seconds() - before


def measure(bdpt, scene, arguments):
    """Returns CPU seconds and images of each seed by integrator, and the statistics of auto."""
    seconds, images = ({name: [] for name in INTEGRATORS} for _ in range(2))
    with tempfile.TemporaryDirectory() as folder:
        image, stats = (pathlib.Path(folder) / name for name in ("image.exr", "stats.json"))
        start = min(render(bdpt, scene, image, arguments.side, "--spp", "1", "--integrator", "mis") for _ in range(2))
        for seed in range(1, arguments.seeds + 1):
            for name in INTEGRATORS:
                time = render(bdpt, scene, image, arguments.side, "--spp", str(arguments.spp), "--seed", str(seed),
                              "--integrator", name, "--stats", stats) - start
                seconds[name].append(max(time, 1e-6))
                images[name].append(seed_errors.pixels(image))
                if name == "auto":
                    told = json.loads(stats.read_text())
    return seconds, {name: np.stack(each) for name, each in images.items()}, told


def compute_products(seconds, images, seeds):
    """Returns for each integrator the least time of the chosen seeds, which all do the same work, times each of their
    errors."""
    chosen = {name: each[seeds] for name, each in images.items()}
    least = {name: np.min(np.array(each)[seeds]) for name, each in seconds.items()}
    judge = seed_errors.SeedErrors([chosen["auto"], chosen["bdpt"]])
    products = {name: least[name] * judge.errors(chosen[name]) for name in INTEGRATORS}
    products["lt"] += least["auto"] * judge.biases(chosen["lt"])
    return products


def estimate_noise(seconds, images, best):
    """Returns the standard error of the ratio of auto and the best single integrator."""
    def ratio(seeds):
        some = compute_products(seconds, images, seeds)
        return some["auto"][0] / some[best][0]
    return seed_errors.noise(len(seconds["auto"]), ratio)


def format_settings(settings):
    if settings["integrator"] == "mis":
        return "mis"
    n = settings["light_paths"]
    rays = settings.get("connection_rays", 0)
    return f"n {n:g} c {settings.get('connections', n):g}" + (f" K {rays:g}" if rays else "")


def format_ratios(ratios):
    return "".join(f"{ratio:9.2f}" for ratio in ratios)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bdpt", type=pathlib.Path)
    parser.add_argument("scenes", nargs="*", type=pathlib.Path, metavar="SCENE", help="default: all of scenes/")
    parser.add_argument("--side", type=int, default=256, help="pixels a side (256)")
    parser.add_argument("--spp", type=int, default=16, help="samples per pixel (16)")
    parser.add_argument("--seeds", type=int, default=5, help="renders by each integrator (5)")
    arguments = parser.parse_intermixed_args()
    measures = ("relMSE", "scales", "no dots")
    heads = "".join(f"{name:>9}" for name in measures)
    print(f"{'':53} {'over the best single:':>27}{'over bdpt:':>27}")
    print(f"{'scene':26} {'auto chose':18} {'pilot':>6} {heads}{heads} {'best':>5} {'noise':>6}")
    ratios = []
    for scene in arguments.scenes or sorted((ROOT / "scenes").glob("*.gltf")):
        seconds, images, told = measure(arguments.bdpt, scene, arguments)
        found = compute_products(seconds, images, list(range(arguments.seeds)))
        best = min(("mis", "lt", "bdpt"), key=lambda name: found[name][0])
        row = []
        for others in (("mis", "lt", "bdpt"), ("bdpt",)):
            row += list(found["auto"] / np.min([found[name] for name in others], axis=0))
        ratios.append(row)
        times = told["seconds"]
        share = times["choose"] / (times["choose"] + times["render"])
        print(f"{scene.stem:26} {format_settings(told['settings']):18} {100 * share:5.1f}% {format_ratios(row)} {best:>5} "
              f"{estimate_noise(seconds, images, best):6.2f}", flush=True)
    means = [statistics.geometric_mean(column) for column in zip(*ratios)]
    print(f"{'geometric mean':26} {'':18} {'':6} {format_ratios(means)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
