#!/usr/bin/env python3
"""Tests that planned renders run by make, of which tasks are killed at random, equal one render, and planned frames
equal those of one render: plan_make_test.py COMMAND SCENE."""

import json
import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

COMMAND, SCENE = sys.argv[1:3]
WORDS = [SCENE, "--size", "48x36", "--spp", "2048", "--integrator", "bdpt"]
TASKS = 8
LEAST_KILLED = 6


def bdpt(*words):
    return subprocess.run([COMMAND, *map(str, words)], check=True, capture_output=True, text=True).stdout


def renders_below(group):
    """Returns the pids of the renders in a process group."""
    found = []
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            words = (folder / "cmdline").read_bytes().split(b"\0")
            if os.getpgid(int(folder.name)) == group and b"render" in words and words[0] == COMMAND.encode():
                found.append(int(folder.name))
        except (OSError, ProcessLookupError):
            pass
    return found


def send(process, number):
    try:
        os.kill(process, number)
    except ProcessLookupError:
        return False
    return True


def make_and_kill(job):
    """Runs make while it kills renders, some during a checkpoint; returns the number of kills."""
    make = subprocess.Popen(["make", "-C", job, "-j4", "-k", f"BDPT={COMMAND}", "THREADS=1"], start_new_session=True,
                            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    killed = 0
    while make.poll() is None:
        time.sleep(random.uniform(0.1, 0.5))
        for process in random.sample(found := renders_below(make.pid), min(len(found), 1)):
            send(process, signal.SIGUSR1)
            time.sleep(random.uniform(0.0, 0.5))
            killed += send(process, signal.SIGKILL)
    return killed


def check_frames(folder, scene):
    """Returns the errors of an animation that make renders in tasks smaller than a frame."""
    words = [scene, "--size", "48x27", "--spp", "16", "--env", "none", "--frames", "1:3", "--fps", "8"]
    job = folder / "frames"
    bdpt("plan", *words, "-o", folder / "planned.#.exr", "--parts", "5", "--for", "make", "-d", job)
    # The makefile contains the path of the program that wrote it.
    subprocess.run(["make", "-C", job, "-j2", "-k", "THREADS=1"], check=True, capture_output=True)
    bdpt("render", *words, "-o", folder / "whole.#.exr")
    pairs = [(folder / f"planned.{frame}.exr", folder / f"whole.{frame}.exr") for frame in (1, 2, 3)]
    return [f"{planned.name} is not {whole.name}" for planned, whole in pairs if mse(planned, whole) != 0]


def mse(image, reference):
    return json.loads(bdpt("compare", image, reference, "--json"))["metrics"]["mse"]["mean"]


def main():
    seed = random.randrange(1 << 32)
    print(f"seed {seed}")
    random.seed(seed)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        job = folder / "a job"
        bdpt("plan", *WORDS, "-o", folder / "out.exr", "--parts", TASKS, "--for", "make", "-d", job)
        killed = sum(make_and_kill(job) for _ in range(2))
        parts = [part.name for part in job.glob("*.part.exr")]
        print(f"killed {killed} renders; parts that are there: {len(parts)}")
        again = subprocess.run(["make", "-C", job, "-j4", "-k", f"BDPT={COMMAND}", "THREADS=1"], capture_output=True,
                               text=True, check=False)
        bdpt("render", *WORDS, "-o", folder / "whole.exr")
        errors = [] if again.returncode == 0 else [f"make after all the killing: {again.returncode} {again.stderr}"]
        errors += [] if killed >= LEAST_KILLED and parts else ["too few renders were killed to tell anything"]
        error = mse(folder / "out.exr", folder / "whole.exr")
        errors += [] if error == 0 else [f"the image is another one: mean square error {error}"]
        errors += check_frames(folder, pathlib.Path(SCENE).with_name("motion.gltf"))
        print("\n".join(errors) or "the pixels are those of one render")
        sys.exit(bool(errors))


if __name__ == "__main__":
    main()
