#!/usr/bin/env python3
"""Counts how often `bdpt verify` fails a correct renderer: verify_false_alarms.py BDPT [SCENE...]

Tries each scene as it is, and darkened: with all base colours multiplied by a factor, so that Russian roulette ends as
many walks as possible. Every run has a seed of its own and 155 batches (the first test that has enough samples), and
may be a false alarm with the probability --false-alarm. The exit code is 1 if there are more than chance explains."""

import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENES = ("cornell-box", "cornell-box-hidden", "cornell-spheres", "lamp-box", "room-sun")
FAILED = 10  # exit code of `bdpt verify`


def darken(scene, factor, folder):
    """Writes a copy of the scene with all base colours multiplied by the factor."""
    document = json.loads(scene.read_text(encoding="utf-8"))
    for material in document.get("materials", []):
        pbr = material.setdefault("pbrMetallicRoughness", {})
        color = pbr.get("baseColorFactor", [1, 1, 1, 1])
        pbr["baseColorFactor"] = [factor * c for c in color[:3]] + color[3:]
    copy = folder / f"{scene.stem}-{factor:g}.gltf"
    copy.write_text(json.dumps(document), encoding="utf-8")
    return copy


def is_alarm(bdpt, scene, seed, chance):
    done = subprocess.run([bdpt, "verify", scene, "--false-alarm", f"{100 * chance:g}", "--size", "8x8", "--bias", "100",
                           "--seed", str(seed), "--time", "1h"], capture_output=True, text=True)
    if done.returncode not in (0, FAILED, 11):
        sys.exit(f"verify_false_alarms: {scene}: exit code {done.returncode}: {done.stderr.strip()}")
    return done.returncode == FAILED


def compute_max_alarms(runs, chance):
    """Returns the 99.9th percentile of the number of false alarms."""
    below = 0.0
    for count in range(runs + 1):
        below += math.comb(runs, count) * chance**count * (1 - chance) ** (runs - count)
        if below >= 0.999:
            return count
    return runs


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bdpt", type=pathlib.Path)
    parser.add_argument("scenes", nargs="*", type=pathlib.Path, metavar="SCENE", help=f"default: {', '.join(SCENES)}")
    parser.add_argument("--runs", type=int, default=20, help="of each scene and factor (20)")
    parser.add_argument("--factors", type=float, nargs="+", default=[1, 0.25, 0.1], help="of base colours (1 0.25 0.1)")
    parser.add_argument("--false-alarm", type=float, default=0.1, help="chance of each run (0.1)")
    arguments = parser.parse_args()
    scenes = arguments.scenes or [ROOT / "scenes" / f"{name}.gltf" for name in SCENES]
    most = compute_max_alarms(arguments.runs, arguments.false_alarm)
    total = excess = 0
    with tempfile.TemporaryDirectory() as folder:
        for scene in scenes:
            for factor in arguments.factors:
                copy = darken(scene, factor, pathlib.Path(folder))
                alarms = sum(is_alarm(arguments.bdpt, copy, seed, arguments.false_alarm)
                             for seed in range(1, arguments.runs + 1))
                total += alarms
                excess += alarms > most
                print(f"{alarms} of {arguments.runs}: {scene.stem}, base colours times {factor:g}", flush=True)
    runs = arguments.runs * len(scenes) * len(arguments.factors)
    print(f"{total} of {runs} runs are false alarms; {arguments.false_alarm * runs:g} are allowed")
    return 1 if excess else 0


if __name__ == "__main__":
    sys.exit(main())
