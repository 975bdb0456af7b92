#!/usr/bin/env python3
"""Compares what people see of the noise of ways to render: eyes_table.py BDPT [MODELS] --way OPTIONS --way OPTIONS...

A way is a list of options of `bdpt render`, as of real_scenes.py. Prints for each scene and way HDR-FLIP at the CPU
time, without loading, of the first way with --spp samples, raw and denoised, each over that of the first way, whose own
FLIP is in the first columns. Other ways render 8, 16, 32 ... samples; FLIP is interpolated between them, as a power of
time. Denoising does not count as time. The reference is a long render of the first way by another seed. Scenes are
the first twelve, or those of --only: of scenes/, and those of MODELS (see real_scenes.py) that are present. Ways take
turns. Needs numpy; denoised columns need Open Image Denoise."""

import json
import math
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import real_scenes

OWN = ("cornell-box", "alpha", "glass-rough", "room-sun", "veach-plates", "instances")
REAL = ("hotel, studio", "living room, courtyard", "garage, courtyard", "car, sunset", "jungle, default sky",
        "shader ball, interior")
MOST = 128  # samples per pixel


def measure_flip(arguments, images, reference):
    """Returns the mean HDR-FLIP of the images of a folder."""
    told = subprocess.run([arguments.bdpt, "compare", images, reference, "--metrics", "flip", "--json"], check=True,
                          capture_output=True, text=True)
    return json.loads(told.stdout)["metrics"]["flip"]["mean"]


def measure_point(way, scene, spp, folder, arguments, load):
    """Returns the least CPU time of a way with `spp` samples, and its FLIP, raw and denoised."""
    seconds = []
    for kind in ("raw", "denoised") if arguments.denoise else ("raw",):
        (folder / kind).mkdir(exist_ok=True)
        for seed in range(1, arguments.seeds + 1):
            options = ["--spp", str(spp), "--seed", str(seed)] + (["--denoise"] if kind == "denoised" else [])
            time = real_scenes.render(way, scene, folder / kind / f"{seed}.exr", arguments, *options)
            if kind == "raw":
                seconds.append(max(time - load, 1e-6))
    flips = [measure_flip(arguments, folder / kind, folder / "reference.exr")
             for kind in ("raw", "denoised") if (folder / kind).exists()]
    return min(seconds), flips


def measure_load(way, scene, folder, arguments):
    """Returns the least CPU time in which the program of a way loads the scene and renders a pixel."""
    program = way.partition(":")[0] + ":" if ":" in way else ""
    return min(real_scenes.render(program + "--integrator mis", scene, folder / "start.exr", arguments, "--spp", "1",
                                  "--crop", "0,0,1,1") for _ in range(2))


def at_time(points, time):
    """Interpolates FLIP between the points around `time`, or beyond the last two."""
    before, after = next(((a, b) for a, b in zip(points, points[1:]) if b[0] >= time), points[-2:])
    share = math.log(time / before[0]) / math.log(after[0] / before[0])
    return [math.exp((1 - share) * math.log(a) + share * math.log(b)) for a, b in zip(before[1], after[1])]


def measure(scene, arguments):
    """Returns FLIP, raw and denoised, of each way at the time of the first."""
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        real_scenes.render(arguments.way[0], scene, folder / "reference.exr", arguments, "--seed", "1000", "--spp",
                           str(arguments.reference))
        time, first = measure_point(arguments.way[0], scene, arguments.spp, folder, arguments,
                                    measure_load(arguments.way[0], scene, folder, arguments))
        flips = [first]
        for way in arguments.way[1:]:
            load = measure_load(way, scene, folder, arguments)
            points = []
            spp = 8
            while len(points) < 2 or (points[-1][0] < time and spp <= MOST):
                points.append(measure_point(way, scene, spp, folder, arguments, load))
                spp *= 2
            flips.append(at_time(points, time))
        return flips


def main():
    parser = real_scenes.make_parser(__doc__, 2, 1024)
    parser.add_argument("bdpt", type=pathlib.Path, metavar="BDPT")
    parser.add_argument("models", type=pathlib.Path, nargs="?", default=pathlib.Path(), metavar="MODELS")
    parser.add_argument("--way", action="append", required=True, metavar="[PROGRAM:]OPTIONS")
    parser.add_argument("--denoise", action="store_true", help="also compares denoised images")
    arguments = parser.parse_intermixed_args()
    scenes = [(name, real_scenes.ROOT / f"scenes/{name}.gltf", []) for name in OWN if re.search(arguments.only, name)]
    scenes += [each for each in real_scenes.find_scenes(arguments, pathlib.Path("/nonexistent")) if each[0] in REAL]
    kinds = 2 if arguments.denoise else 1
    heads = f"{'raw':>8}" + (f"{'denoised':>10}" if arguments.denoise else "")
    print(f"{'scene':26}" + heads * len(arguments.way))
    ratios = [[[] for _ in range(kinds)] for _ in arguments.way[1:]]
    for name, path, options in scenes:
        flips = measure((path, *options), arguments)
        row = f"{flips[0][0]:8.4f}" + (f"{flips[0][1]:10.4f}" if arguments.denoise else "")
        for way, found in enumerate(flips[1:]):
            over = [a / b for a, b in zip(found, flips[0])]
            row += f"{over[0]:8.2f}" + (f"{over[1]:10.2f}" if arguments.denoise else "")
            for kind, ratio in enumerate(over):
                ratios[way][kind].append(ratio)
        print(f"{name:26}{row}", flush=True)
    means = "".join(f"{statistics.geometric_mean(column):{10 if kind else 8}.2f}"
                    for way in ratios for kind, column in enumerate(way))
    print(f"{'geometric mean':26}{'':{18 if arguments.denoise else 8}}{means}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
