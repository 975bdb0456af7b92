#!/usr/bin/env python3
"""Runs `bdpt verify` on bdpt with every number of light paths and connections that auto can choose:
verify_choices.py BDPT [SCENE...]

Prints a line for each scene: how many choices passed, were inconclusive in the time limit, and failed. If one failed,
prints its output and exits with status 1."""

import argparse
import collections
import pathlib
import subprocess
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from candidates import read_candidates

ROOT = pathlib.Path(__file__).resolve().parents[2]
VERDICTS = {0: "passed", 10: "failed", 11: "inconclusive"}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bdpt", type=pathlib.Path)
    parser.add_argument("scenes", nargs="*", type=pathlib.Path, metavar="SCENE", help="default: all of scenes/")
    parser.add_argument("--time", default="10s", help="for each choice (10s)")
    parser.add_argument("--bias", default="5", help="error of a strategy that must be found [%% of the image] (5)")
    arguments = parser.parse_args()
    failed = False
    for scene in arguments.scenes or sorted((ROOT / "scenes").glob("*.gltf")):
        counts = collections.Counter()
        for n, c, rays in read_candidates()[1:]:
            done = subprocess.run(
                [arguments.bdpt, "verify", scene, "--light-paths", str(n), "--connections", str(c), "--connection-rays",
                 str(rays), "--time", arguments.time, "--bias", arguments.bias], capture_output=True, text=True, check=False)
            if done.returncode not in VERDICTS:
                sys.exit(f"{scene}: {done.stderr}")
            counts[VERDICTS[done.returncode]] += 1
            if done.returncode == 10:
                failed = True
                print(f"{scene.stem}, {n:g} light paths, {c:g} connections, {rays:g} rays:\n{done.stdout}", flush=True)
        print(f"{scene.stem:26} " + ", ".join(f"{counts[word]} {word}" for word in VERDICTS.values()), flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
