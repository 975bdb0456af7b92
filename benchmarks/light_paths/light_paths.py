#!/usr/bin/env python3
"""Compares numbers of light paths and connections: light_paths.py BDPT [SCENE...]

Prints for each scene and choice the CPU time, the relMSE of the image and of its averages over 8 x 8 pixels (errors
that are correlated between pixels do not average out), and the product of time and relMSE over that of one light path
for each camera path: the error at equal time. The column `shared` is 64 times the relMSE of averages over that of
pixels: it is 1 where the errors of pixels are independent. Needs oiiotool."""

import argparse
import json
import pathlib
import resource
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENES = ("cornell-box", "cornell-box-hidden", "cornell-spheres", "lamp-box", "glass-rough", "instances", "motion",
          "caustic-glass", "room-sun")
SIDE = 96
BLOCK = 8

CHOICES = {"own 1": ["--light-paths", "1"],
           "mis": ["--integrator", "mis"],
           "lt": ["--integrator", "lt"],
           "n 0.06 c 1": ["--light-paths", "0.06", "--connections", "1"],
           "n 0.25 c 1": ["--light-paths", "0.25", "--connections", "1"],
           "n 0.25 c 3": ["--light-paths", "0.25", "--connections", "3"],
           "n 0.06 c 0.25": ["--light-paths", "0.06", "--connections", "0.25"],
           "n 4 c 1": ["--light-paths", "4", "--connections", "1"],
           "vcm": ["--integrator", "vcm"],
           "vcm n 0.25": ["--integrator", "vcm", "--light-paths", "0.25"],
           "vcm wider": ["--integrator", "vcm", "--merge-radius", "0.01"]}


def child_seconds():
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime


def render(bdpt, scene, image, *options):
    """Renders the scene; returns CPU seconds."""
    before = child_seconds()
    subprocess.run([bdpt, "render", scene, "--size", f"{SIDE}x{SIDE}", "-o", image, "--quiet", *options], check=True)
    return child_seconds() - before


def average_image(image):
    result = image.with_name(image.stem + "-averages.exr")
    side = SIDE // BLOCK
    subprocess.run(["oiiotool", image, "--ch", "R,G,B", "--resize:filter=box", f"{side}x{side}", "-o", result], check=True)
    return result


def relmse(bdpt, image, reference):
    done = subprocess.run([bdpt, "compare", image, reference, "--json"], capture_output=True, text=True, check=False)
    return json.loads(done.stdout)["metrics"]["relmse"]["mean"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bdpt", type=pathlib.Path)
    parser.add_argument("scenes", nargs="*", type=pathlib.Path, metavar="SCENE", help=f"default: {', '.join(SCENES)}")
    parser.add_argument("--spp", type=int, default=32, help="samples per pixel (32)")
    parser.add_argument("--seeds", type=int, default=3, help="renders of each choice (3)")
    parser.add_argument("--reference-spp", type=int, default=2048, help="of bdpt with one light path each (2048)")
    arguments = parser.parse_args()
    for scene in arguments.scenes or [ROOT / "scenes" / f"{name}.gltf" for name in SCENES]:
        with tempfile.TemporaryDirectory() as folder:
            reference = pathlib.Path(folder) / "reference.exr"
            image = pathlib.Path(folder) / "image.exr"
            render(arguments.bdpt, scene, reference, "--light-paths", "1", "--spp", str(arguments.reference_spp), "--seed",
                   "999")
            averages = average_image(reference)
            first = None
            print(f"{scene.stem}\n  {'choice':14} {'seconds':>8} {'relMSE':>9} {'averages':>9} {'at equal time':>14} {'shared':>7}")
            for name, choice in CHOICES.items():
                start = render(arguments.bdpt, scene, image, "--spp", "1", *choice)
                seconds = error = coarse = 0.0
                for seed in range(1, arguments.seeds + 1):
                    seconds += render(arguments.bdpt, scene, image, "--spp", str(arguments.spp), "--seed", str(seed),
                                      *choice) - start
                    error += relmse(arguments.bdpt, image, reference)
                    coarse += relmse(arguments.bdpt, average_image(image), averages)
                seconds, error, coarse = (sum_ / arguments.seeds for sum_ in (seconds, error, coarse))
                first = first or (seconds * error, seconds * coarse)
                print(f"  {name:14} {seconds:8.2f} {error:9.5f} {coarse:9.6f} {seconds * error / first[0]:6.2f} "
                      f"{seconds * coarse / first[1]:7.2f} {BLOCK * BLOCK * coarse / error:7.1f}", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
