#!/usr/bin/env python3
"""Holds --integrator auto against mis, lt and bdpt with one light path each: auto_table.py BDPT [SCENE...]

Prints for each scene what auto chose, the share of its time that the pilot took, and its error at equal CPU time over
that of the best of the three and over that of bdpt: medians over seeds of CPU time (the pilot's included) times relMSE,
and times relMSE over scales. The noise is that of the first ratio, as a factor (one standard error, from its seeds).
Integrators take turns, so that a machine that is slow for a while is so for all. The reference is a long render by auto
with another seed."""

import argparse
import json
import math
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
INTEGRATORS = ("auto", "mis", "lt", "bdpt")
METRICS = ("relmse", "relmse_scales")


def child_seconds():
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime


def render(bdpt, scene, image, side, *options):
    """CPU seconds."""
    before = child_seconds()
    subprocess.run([bdpt, "render", scene, "--size", f"{side}x{side}", "-o", image, "--quiet", "--threads", "1", *options],
                   check=True)
    return child_seconds() - before


def errors(bdpt, image, reference):
    done = subprocess.run([bdpt, "compare", image, reference, "--json", "--relative"], capture_output=True, text=True,
                          check=False)
    metrics = json.loads(done.stdout)["metrics"]
    return [metrics[name]["mean"] for name in METRICS]


def measure(bdpt, scene, arguments):
    """Name of the integrator -> for each seed seconds times each error, and what auto chose."""
    with tempfile.TemporaryDirectory() as folder:
        image, stats = (pathlib.Path(folder) / name for name in ("image.exr", "stats.json"))
        reference = (arguments.references or pathlib.Path(folder)) / f"{scene.stem}.exr"
        if not reference.exists():
            render(bdpt, scene, reference, arguments.side, "--spp", str(arguments.reference_spp), "--seed", "999")
        start = min(render(bdpt, scene, image, arguments.side, "--spp", "1", "--integrator", "mis") for _ in range(2))
        products = {name: [] for name in INTEGRATORS}
        for seed in range(1, arguments.seeds + 1):
            for name in INTEGRATORS:
                seconds = render(bdpt, scene, image, arguments.side, "--spp", str(arguments.spp), "--seed", str(seed),
                                 "--integrator", name, "--stats", stats) - start
                products[name].append([max(seconds, 1e-6) * error for error in errors(bdpt, image, reference)])
                if name == "auto":
                    told = json.loads(stats.read_text())
        return products, told


def medians(runs):
    return [statistics.median(column) for column in zip(*runs)]


def noise(*products):
    """Of the quotient of two medians of relMSE, as a factor >= 1."""
    logs = [[math.log(run[0]) for run in runs] for runs in products]
    return math.exp(math.sqrt(sum(statistics.variance(column) / len(column) for column in logs)))


def words(settings):
    if settings["integrator"] == "mis":
        return "mis"
    n = settings["light_paths"]
    return f"n {n:g} c {settings.get('connections', n):g}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bdpt", type=pathlib.Path)
    parser.add_argument("scenes", nargs="*", type=pathlib.Path, metavar="SCENE", help="default: all of scenes/")
    parser.add_argument("--side", type=int, default=96, help="pixels a side (96)")
    parser.add_argument("--spp", type=int, default=64, help="samples per pixel (64)")
    parser.add_argument("--seeds", type=int, default=5, help="renders by each integrator (5)")
    parser.add_argument("--reference-spp", type=int, default=1024, help="samples of the reference (1024)")
    parser.add_argument("--references", type=pathlib.Path, metavar="DIR", help="where references are kept for later runs")
    arguments = parser.parse_intermixed_args()
    print(f"{'scene':26} {'auto chose':14} {'pilot':>6} {'over best single':>17} {'scales':>7} {'over bdpt':>10} {'scales':>7} {'best':>5} {'noise':>6}")
    ratios = []
    for scene in arguments.scenes or sorted((ROOT / "scenes").glob("*.gltf")):
        runs, told = measure(arguments.bdpt, scene, arguments)
        products = {name: medians(runs[name]) for name in INTEGRATORS}
        best = min(("mis", "lt", "bdpt"), key=lambda name: products[name][0])
        row = []
        for others in (("mis", "lt", "bdpt"), ("bdpt",)):
            row += [products["auto"][i] / min(products[name][i] for name in others) for i in range(len(METRICS))]
        ratios.append(row)
        times = told["seconds"]
        share = times["choose"] / (times["choose"] + times["render"])
        print(f"{scene.stem:26} {words(told['settings']):14} {100 * share:5.1f}% {row[0]:17.2f} {row[1]:7.2f} {row[2]:10.2f} "
              f"{row[3]:7.2f} {best:>5} {noise(runs['auto'], runs[best]):6.2f}", flush=True)
    means = [math.exp(statistics.fmean(math.log(value) for value in column)) for column in zip(*ratios)]
    print(f"{'geometric mean':26} {'':14} {'':6} {means[0]:17.2f} {means[1]:7.2f} {means[2]:10.2f} {means[3]:7.2f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
