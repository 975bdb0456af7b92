#!/usr/bin/env python3
"""Measures the cost of depth of field: lens_cost.py BDPT [SCENE] [--integrators mis,bdpt] [--rounds 5].

SCENE has a camera with a lens (default: scenes/nine-spheres-dof.gltf). Renders it through the lens and through a
pinhole in turn, with equal samples; the table has medians of CPU seconds of processes, and the median, least and
greatest ratio of rounds.
"""

import argparse
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

SCENE = pathlib.Path(__file__).resolve().parents[2] / "scenes/nine-spheres-dof.gltf"
VIEWS = {"pinhole": ["--lens-radius", "0"], "lens": []}


def cpu_seconds(command):
    process = subprocess.Popen(command)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"{' '.join(command)} ended with exit code {process.returncode}")
    return usage.ru_utime + usage.ru_stime


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bdpt")
    parser.add_argument("scene", nargs="?", default=str(SCENE))
    parser.add_argument("--integrators", default="mis,bdpt")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--size", default="256x192")
    parser.add_argument("--spp", default="32")
    arguments = parser.parse_args()
    print("| integrator | pinhole | lens | lens / pinhole |\n|---|---|---|---|")
    for integrator in arguments.integrators.split(","):
        rounds = {name: [] for name in VIEWS}
        with tempfile.TemporaryDirectory() as folder:
            for _ in range(arguments.rounds):
                for name, view in VIEWS.items():
                    rounds[name].append(cpu_seconds(
                        [arguments.bdpt, "render", arguments.scene, "--integrator", integrator, "--max-depth", "5", "--size",
                         arguments.size, "--spp", arguments.spp, "--quiet", "-o", f"{folder}/out.exr", *view]))
        ratios = [lens / pinhole for pinhole, lens in zip(rounds["pinhole"], rounds["lens"])]
        times = " | ".join(f"{statistics.median(rounds[name]):.2f} s" for name in VIEWS)
        print(f"| `{integrator}` | {times} | {statistics.median(ratios):.2f} ({min(ratios):.2f} to {max(ratios):.2f}) |",
              flush=True)


if __name__ == "__main__":
    main()
