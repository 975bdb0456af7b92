#!/usr/bin/env python3
"""Kills renders by SIGKILL at random moments, some while they write a checkpoint, and reports whether renders that
resume from their parts produce the pixels of an uninterrupted render: kill_trial.py BDPT SCENE [--kills N].

- a job of 32 tasks, run by make -j2 -k again and again, until N renders (20) were killed
- one render with --part, killed five times
- ranges of samples by 1 to 4 threads each, merged in a random order

Takes about three minutes on two cores. The exit code is 1 if any pixel differs, or too few renders were killed."""

import argparse
import json
import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

TASKS = 32


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bdpt", type=pathlib.Path)
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--size", default="96x72")
    parser.add_argument("--spp", type=int, default=2048)
    parser.add_argument("--seed", type=int, default=random.randrange(1 << 32))
    return parser.parse_args()


def renders_in(group, bdpt):
    """Returns the pids of the renders in a process group."""
    found = []
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            words = (folder / "cmdline").read_bytes().split(b"\0")
            if os.getpgid(int(folder.name)) == group and words[0] == str(bdpt).encode() and b"render" in words:
                found.append(int(folder.name))
        except OSError:
            pass
    return found


def send(process, number):
    try:
        os.kill(process, number)
        return True
    except ProcessLookupError:
        return False


class Killer:
    """Kills renders, and counts those that were writing a checkpoint."""

    def __init__(self):
        self.killed = 0
        self.writing = 0

    def kill(self, process, folder):
        """Kills a render. Triggers many checkpoints before, so that some kills hit one."""
        for _ in range(random.randrange(1, 6)):
            send(process, signal.SIGUSR1)
            time.sleep(random.uniform(0.0, 0.08))
        if send(process, signal.SIGKILL):
            self.killed += 1
            time.sleep(0.05)
            left = list(folder.glob(f"*.tmp-*-{process}-*"))
            self.writing += bool(left)
            for file in left:
                file.unlink()  # harmless, as the manual says


class Trial:
    """Runs the trials for one program and scene in one folder."""

    def __init__(self, arguments, folder):
        self.bdpt = arguments.bdpt.resolve()
        self.words = [arguments.scene.resolve(), "--size", arguments.size, "--integrator", "bdpt", "--aov", "depth"]
        self.spp = arguments.spp
        self.folder = folder
        self.run("render", *self.words, "--spp", self.spp, "-o", folder / "whole.exr")

    def run(self, *words):
        done = subprocess.run([self.bdpt, *map(str, words), "--quiet"], capture_output=True, text=True, check=False)
        return done.stdout if done.returncode == 0 else sys.exit(f"{' '.join(map(str, words))}: {done.stderr}")

    def report(self, what, image):
        done = self.run("compare", image, self.folder / "whole.exr", "--json")
        error = json.loads(done)["metrics"]["mse"]["mean"]
        print(f"{what}: mean square error {error}", flush=True)
        return error == 0

    def try_job(self, kills):
        """Tests a make job of which renders are killed."""
        job = self.folder / "job"
        killer = Killer()
        self.run("plan", *self.words, "--spp", self.spp, "-o", self.folder / "job.exr", "--parts", TASKS, "--for",
                 "make", "-d", job)
        starts = 0
        command = ["make", "-C", job, "-j2", "-k", f"BDPT={self.bdpt}", "THREADS=1"]
        while killer.killed < kills:
            starts += 1
            make = subprocess.Popen(command, start_new_session=True, stdout=subprocess.DEVNULL,
                                    stderr=subprocess.DEVNULL)
            deadline = random.uniform(2.0, 6.0) + time.monotonic()
            while make.poll() is None and killer.killed < kills and time.monotonic() < deadline:
                time.sleep(random.uniform(0.1, 0.6))
                found = renders_in(make.pid, self.bdpt)
                if found:
                    killer.kill(random.choice(found), job)
            send(make.pid, signal.SIGTERM)  # on SIGTERM make ends its renders, which write their parts
            make.wait()
            if (self.folder / "job.exr").exists():
                break
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"make after all the killing: {done.returncode} {done.stderr}")
        same = self.report(f"job of {TASKS} tasks, make started {starts + 1} times, {killer.killed} renders killed, "
                           f"{killer.writing} of them while writing", self.folder / "job.exr")
        return same and killer.killed >= kills

    def try_one_render(self, kills=5):
        """Tests a render with --part that is killed."""
        part = self.folder / "one.part.exr"
        killer = Killer()
        words = [self.bdpt, "render", *self.words, "--spp", self.spp, "--part", part, "--quiet"]
        for _ in range(kills):
            render = subprocess.Popen([*map(str, words)])
            time.sleep(random.uniform(0.3, 2.0))
            killer.kill(render.pid, self.folder)
            render.wait()
        self.run(*words[1:-1], "-o", self.folder / "one.exr")
        same = self.report(f"render with --part, killed {killer.killed} times, {killer.writing} of them while writing",
                           self.folder / "one.exr")
        return same and killer.killed == kills

    def try_ranges(self):
        """Tests random ranges of samples by random numbers of threads."""
        ends = sorted(random.sample(range(1, self.spp), 6))
        parts = []
        for begin, end in zip([0, *ends], [*ends, self.spp]):
            parts.append(self.folder / f"{begin}.part.exr")
            self.run("render", *self.words, "--samples", f"{begin}:{end}", "--threads", random.randint(1, 4), "--part",
                     parts[-1])
        random.shuffle(parts)
        self.run("merge", *parts, "-o", self.folder / "merged.exr")
        return self.report(f"{len(parts)} ranges of samples by 1 to 4 threads, in a random order",
                           self.folder / "merged.exr")


def main():
    arguments = parse()
    print(f"seed {arguments.seed}", flush=True)
    random.seed(arguments.seed)
    with tempfile.TemporaryDirectory() as name:
        trial = Trial(arguments, pathlib.Path(name))
        good = [trial.try_job(arguments.kills), trial.try_one_render(), trial.try_ranges()]
    sys.exit(not all(good))


if __name__ == "__main__":
    main()
