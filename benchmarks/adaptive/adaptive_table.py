#!/usr/bin/env python3
"""Compares --adaptive with uniform sampling: adaptive_table.py BDPT [SCENE...]

Prints the gain of adaptive sampling for each scene and integrator: CPU time times relMSE of uniform renders, over that
of adaptive ones, whose time includes the pilot; beside it the same with relMSE over scales. A gain of 2 means half the
time for the same error. Then prints error and CPU time of adaptive renders over those of uniform ones, at equal --spp.
All are ratios of medians over seeds. The reference is a long uniform render with another seed. A scene may be followed
by options of bdpt render, in one word: "model.glb --env default"."""

import argparse
import json
import math
import pathlib
import resource
import shlex
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
METRICS = ("relmse", "relmse_scales")


def child_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def render(bdpt, scene, image, arguments, *options):
    """Renders the scene; returns CPU seconds."""
    before = child_seconds()
    subprocess.run([bdpt, "render", *scene, "-o", image, "--quiet", "--threads", "1", "--size", arguments.size, *options],
                   check=True)
    return child_seconds() - before


def errors(bdpt, image, reference):
    done = subprocess.run([bdpt, "compare", image, reference, "--json", "--relative"], capture_output=True, text=True,
                          check=False)
    metrics = json.loads(done.stdout)["metrics"]
    return [metrics[name]["mean"] for name in METRICS]


def measure(bdpt, scene, integrator, arguments):
    """Returns medians of CPU seconds and of each error, for uniform and adaptive renders."""
    with tempfile.TemporaryDirectory() as folder:
        image = pathlib.Path(folder) / "image.exr"
        words = "_".join([pathlib.Path(scene[0]).stem, *scene[1:], arguments.size])
        name = "".join(c if c.isalnum() else "_" for c in words)
        reference = (arguments.references or pathlib.Path(folder)) / f"{name}.exr"
        if not reference.exists():
            render(bdpt, scene, reference, arguments, "--spp", str(arguments.reference_spp), "--seed", "999")
        one_pixel = ("--spp", "1", "--integrator", "mis", "--crop", "0,0,1,1")
        start = min(render(bdpt, scene, image, arguments, *one_pixel) for _ in range(2))
        found = {}
        for name, more in (("uniform", ("--adaptive=false",)), ("adaptive", ("--adaptive",))):
            runs = []
            for seed in range(1, arguments.seeds + 1):
                seconds = render(bdpt, scene, image, arguments, "--spp", str(arguments.spp), "--seed", str(seed),
                                 "--integrator", integrator, *more) - start
                runs.append([max(seconds, 1e-6), *errors(bdpt, image, reference)])
            found[name] = [statistics.median(column) for column in zip(*runs)]
        return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bdpt", type=pathlib.Path)
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help="default: all of scenes/")
    parser.add_argument("--size", default="128x128", help="image size (128x128)")
    parser.add_argument("--spp", type=int, default=256, help="samples per pixel (256)")
    parser.add_argument("--seeds", type=int, default=5, help="renders of each kind (5)")
    parser.add_argument("--integrators", default="mis,auto", help="with commas between (mis,auto)")
    parser.add_argument("--reference-spp", type=int, default=8192, help="samples of the reference (8192)")
    parser.add_argument("--references", type=pathlib.Path, metavar="DIR", help="where references are kept for later runs")
    arguments = parser.parse_args()
    print(f"{'scene':34} {'integrator':10} {'gain':>6} {'scales':>7} {'error':>6} {'time':>6}")
    ratios = []
    for words in arguments.scenes or [str(path) for path in sorted((ROOT / "scenes").glob("*.gltf"))]:
        scene = shlex.split(words)
        for integrator in arguments.integrators.split(","):
            found = measure(arguments.bdpt, scene, integrator, arguments)
            time, error, scales = (a / u for a, u in zip(found["adaptive"], found["uniform"]))
            ratios.append((time * error, time * scales))
            print(f"{pathlib.Path(scene[0]).stem:34} {integrator:10} {1 / (time * error):6.2f} {1 / (time * scales):7.2f} "
                  f"{error:6.2f} {time:6.2f}", flush=True)
    means = [math.exp(statistics.fmean(-math.log(value) for value in column)) for column in zip(*ratios)]
    print(f"{'geometric mean':34} {'':10} {means[0]:6.2f} {means[1]:7.2f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
