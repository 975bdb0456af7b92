#!/usr/bin/env python3
"""Compares ways to render real models: real_scenes.py MODELS --way OPTIONS --way OPTIONS...

MODELS is a folder of third-party models (HotelRoom_meshopt, Lamborghini, GodotLivingRoom, Garage, Jungle,
ShaderBall_materialx, hdr/...). Renders those that are present, each under the environments of the table below, then
scenes of mixed_light_scenes.py and of scenes/. A way is a list of additional options of `bdpt render`, for example
`--way "--integrator mis"`; `PROGRAM: OPTIONS` runs another program than --bdpt. Prints for each scene and way: squared
relative error without the worst 0.1 % of pixels, CPU time of one thread without loading, and their product, each over
that of the first way; below that, for every way, CPU time of a camera path, seconds from the start to the end of the
first sample, and peak memory. Errors come from the spread between seeds. They are relative to an independent reference,
because a way's own noise in the divisor would favour the noisier way. Ways take turns. Needs numpy."""

import argparse
import json
import math
import os
import pathlib
import re
import resource
import shlex
import statistics
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "light_paths"))
import mixed_light_scenes
import numpy as np
import seed_errors

ROOT = pathlib.Path(__file__).resolve().parents[2]
# name, file, options
LIVING_ROOM = "--from 2,1.4,8.5 --look-at -3,0.8,-1"
SCENES = (
    ("hotel, courtyard", "HotelRoom_meshopt/scene.glb", "--env {hdr}/courtyard.exr"),
    ("hotel, studio", "HotelRoom_meshopt/scene.glb", "--env {hdr}/studio.exr"),
    ("living room, courtyard", "GodotLivingRoom/living_room.glb", "--env {hdr}/courtyard.exr " + LIVING_ROOM),
    ("garage, sunset", "Garage/garage.gltf", "--env {hdr}/sunset.exr"),
    ("garage, courtyard", "Garage/garage.gltf", "--env {hdr}/courtyard.exr"),
    ("car, studio", "Lamborghini/scene.glb", "--env {hdr}/studio.exr"),
    ("car, sunset", "Lamborghini/scene.glb", "--env {hdr}/sunset.exr"),
    ("jungle, sunset", "Jungle/scene.gltf", "--env {hdr}/sunset.exr"),
    ("jungle, default sky", "Jungle/scene.gltf", "--env default"),
    ("chess, studio", "Chess/scene.gltf", "--env {hdr}/studio.exr"),
    ("room of spheres, courtyard", "GodotRoom/scene.gltf", "--env {hdr}/courtyard.exr"),
    ("shader ball, interior", "ShaderBall_materialx/shaderball.glb", "--env {hdr}/interior.exr"),
    ("floor of 6 m", "floor-6.gltf", "--env {hdr}/courtyard.exr"),
    ("floor of 60 m", "floor-60.gltf", "--env {hdr}/courtyard.exr"),
    ("floor of 200 m", "floor-200.gltf", "--env {hdr}/courtyard.exr"),
    ("lamp room", "lamp-room.gltf", "--env {hdr}/courtyard.exr"),
    ("glazed room", "glazed-room.gltf", "--env {hdr}/courtyard.exr"),
    ("shop", "shop.gltf", "--env {hdr}/courtyard.exr"),
    ("six rooms", "six-rooms.gltf", "--env {hdr}/courtyard.exr"),
    ("offices", "offices.gltf", ""),
    ("room-environment", "room-environment.gltf", ""),
    ("room-environment, sunset", "room-environment.gltf", "--env {hdr}/sunset.exr"),
)


def child_seconds():
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime


def render_command(way, scene, image, arguments, *options):
    program, sep, own = way.partition(":")
    program, own = (program, own) if sep else (arguments.bdpt, way)
    return [program, "render", *scene, "--size", arguments.size, "--max-depth", str(arguments.max_depth), "-o", image,
            "--quiet", "--threads", "1", *shlex.split(own), *options]


def render(way, scene, image, arguments, *options):
    """Renders the scene; returns CPU seconds."""
    before = child_seconds()
    subprocess.run(render_command(way, scene, image, arguments, *options), check=True)
    return child_seconds() - before


def measure_start(way, scene, image, arguments):
    """Renders the scene; returns seconds from the start to the end of the first sample, and peak memory in MiB."""
    command = render_command(way, scene, image, arguments, "--spp", str(arguments.spp), "--stats", "-")
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        told = process.stdout.read()
        _, status, usage = os.wait4(process.pid, 0)  # getrusage() gives the peak of all children
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise subprocess.CalledProcessError(process.returncode, command)
    stats = json.loads(told)
    seconds = stats["seconds"]
    first = sum(seconds.get(step, 0) for step in ("load", "build", "choose")) + seconds["render"] / stats["samples"]
    return first, usage.ru_maxrss / 1024


def measure(scene, arguments):
    """Returns lists with an entry for each way: CPU seconds of each seed without loading, images, results of
    measure_start(). Returns the reference, too."""
    seconds, images = ([[] for _ in arguments.way] for _ in range(2))
    with tempfile.TemporaryDirectory() as folder:
        image = pathlib.Path(folder) / "image.exr"
        render("--integrator mis --env-sampling compensated --seed 1000", scene, image, arguments, "--spp",
               str(arguments.reference))
        reference = seed_errors.pixels(image)
        load = min(render("--integrator mis --env-sampling compensated", scene, image, arguments, "--spp", "1",
                          "--crop", "0,0,1,1") for _ in range(2))
        for seed in range(1, arguments.seeds + 1):
            for k, way in enumerate(arguments.way):
                time = render(way, scene, image, arguments, "--spp", str(arguments.spp), "--seed", str(seed))
                seconds[k].append(max(time - load, 1e-6))
                images[k].append(seed_errors.pixels(image))
        starts = [measure_start(way, scene, image, arguments) for way in arguments.way]
    return seconds, [np.stack(each) for each in images], starts, reference


def compute_trimmed_error(images, reference):
    """Returns the mean of the variance between seeds over the square of the reference, without the worst 0.1 % of
    pixels."""
    dark = 0.01 * reference.mean()
    errors = np.sort((images.var(axis=0, ddof=1) / (reference + dark) ** 2).mean(axis=-1).ravel())
    return errors[: math.ceil(0.999 * errors.size)].mean()


def make_parser(description, seeds, reference):
    """Returns a parser with the options of measurements in real models."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", default="", help="scenes whose names this regular expression matches")
    parser.add_argument("--size", default="240x135")
    parser.add_argument("--spp", type=int, default=16)
    parser.add_argument("--seeds", type=int, default=seeds)
    parser.add_argument("--max-depth", type=int, default=8)
    parser.add_argument("--reference", type=int, default=reference, metavar="SPP")
    return parser


def main():
    parser = make_parser(__doc__, 4, 256)
    parser.add_argument("models", type=pathlib.Path, metavar="MODELS")
    parser.add_argument("--bdpt", type=pathlib.Path, default=ROOT / "build/release/apps/bdpt")
    parser.add_argument("--way", action="append", required=True, metavar="[PROGRAM:]OPTIONS")
    arguments = parser.parse_args()
    print(f"{'scene':26}" + "".join(f"{'error':>8}{'time':>7}{'product':>9}" for _ in arguments.way[1:]) + "   mean")
    products = [[] for _ in arguments.way[1:]]
    with tempfile.TemporaryDirectory() as made:
        mixed_light_scenes.write(made)
        measure_all(arguments, pathlib.Path(made), products)
    print(f"{'geometric mean':26}" + "".join(
        f"{'':15}{statistics.geometric_mean(each):9.3f}" for each in products if each))
    return 0


def find_scenes(arguments, made):
    """Yields name, file and list of options of each scene of --only that is in the folder of models, of made scenes, or
    in scenes/."""
    models = arguments.models
    for name, file, options in SCENES:
        path = next((p for p in (models / file, made / file, ROOT / "scenes" / file) if p.exists()), None)
        if path is not None and re.search(arguments.only, name):
            yield name, path, shlex.split(options.format(hdr=models / "hdr"))


def measure_all(arguments, made, products):
    for name, path, options in find_scenes(arguments, made):
        seconds, images, starts, reference = measure((path, *options), arguments)
        errors = [compute_trimmed_error(each, reference) for each in images]
        times = [min(each) for each in seconds]
        row = ""
        for k in range(1, len(arguments.way)):
            error, time = errors[k] / errors[0], times[k] / times[0]
            products[k - 1].append(error * time)
            row += f"{error:8.3f}{time:7.2f}{error * time:9.3f}"
        means = " ".join(f"{each.mean() / reference.mean():.4f}" for each in images)
        print(f"{name:26}{row}   {means}")
        paths = reference.shape[0] * reference.shape[1] * arguments.spp
        print(f"{'':26}" + ";".join(f"{time / paths * 1e6:7.2f} us {first:6.2f} s {memory:5.0f} MiB"
                                     for time, (first, memory) in zip(times, starts)), flush=True)


if __name__ == "__main__":
    sys.exit(main())
