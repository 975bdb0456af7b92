#!/usr/bin/env python3
"""Compares two programs where `auto` chooses differently: changed_choices.py OLD NEW MODEL... [--env ENV]

OLD and NEW are programs `bdpt`. For each model for which their `--integrator auto` chooses different integrators or
numbers of light paths and connections, prints both choices, and CPU time (with the pilot, without loading) times
squared relative error of NEW over that of OLD: of all pixels, and without the worst 0.03, 0.1 and 0.3 %. Errors are
relative to a reference rendered by `bdpt`, so light that a program loses counts. Needs numpy."""

import argparse
import json
import math
import pathlib
import resource
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "light_paths"))
import numpy as np
import seed_errors

WITHOUT = (0.0, 0.0003, 0.001, 0.003)
REFERENCE = ("--integrator", "bdpt", "--light-paths", "0.25", "--connections", "1", "--seed", "1000")
NO_PILOT = ("--integrator", "mis", "--env-sampling", "compensated", "--spp", "1", "--crop", "0,0,1,1")


def render(program, model, image, arguments, *options):
    """Renders the model; returns CPU seconds and the settings."""
    scene = (model, *(("--env", arguments.env) if arguments.env else ()))
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    told = subprocess.run([program, "render", *scene, "--size", arguments.size, "-o", image, "--quiet",
                           "--threads", "1", "--stats", "-", *options], check=True, capture_output=True, text=True)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, json.loads(told.stdout)["settings"]


def find_choice(program, model, image, arguments):
    settings = render(program, model, image, arguments, "--spp", "1")[1]
    if settings["integrator"] == "mis":
        return "mis"
    rays = settings.get("connection_rays", 0)
    return f"n {settings['light_paths']:g} c {settings['connections']:g}" + (f" K {rays:g}" if rays else "")


def compute_products(program, model, image, reference, load, arguments):
    """Returns CPU time times error, for each fraction of pixels that does not count."""
    bright = reference + 0.01 * reference.mean()
    times, sums = [], np.zeros(len(WITHOUT))
    for seed in range(1, arguments.seeds + 1):
        time, _ = render(program, model, image, arguments, "--spp", str(arguments.spp), "--seed", str(seed))
        times.append(max(time - load, 1e-6))
        errors = np.sort((((seed_errors.pixels(image) - reference) / bright) ** 2).mean(axis=-1).ravel())
        sums += [errors[: math.ceil((1.0 - share) * errors.size)].mean() for share in WITHOUT]
    return min(times) * sums


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", nargs=2, metavar="PROGRAM")
    parser.add_argument("models", nargs="+", metavar="MODEL")
    parser.add_argument("--env")
    parser.add_argument("--size", default="320x240")
    parser.add_argument("--spp", type=int, default=32)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--reference", type=int, default=512, metavar="SPP")
    arguments = parser.parse_intermixed_args()
    ratios = []
    with tempfile.TemporaryDirectory() as folder:
        image = pathlib.Path(folder) / "image.exr"
        for model in arguments.models:
            try:
                old, new = (find_choice(program, model, image, arguments) for program in arguments.programs)
            except subprocess.CalledProcessError as error:
                print(f"{pathlib.Path(model).name}: {error.stderr.strip().splitlines()[-1]}", file=sys.stderr)
                continue
            if old == new:
                continue
            render(arguments.programs[1], model, image, arguments, *REFERENCE, "--spp", str(arguments.reference))
            reference = seed_errors.pixels(image)
            load = min(render(arguments.programs[1], model, image, arguments, *NO_PILOT)[0] for _ in range(2))
            first, second = (compute_products(program, model, image, reference, load, arguments)
                             for program in arguments.programs)
            ratios.append(second / first)
            row = "".join(f"{ratio:7.2f}" for ratio in ratios[-1])
            print(f"{pathlib.Path(model).name:40} {old:14} {new:14}{row}", flush=True)
    if ratios:
        means = np.exp(np.log(ratios).mean(axis=0))
        print(f"{'geometric mean':70}" + "".join(f"{r:7.2f}" for r in means))
    return 0


if __name__ == "__main__":
    sys.exit(main())
