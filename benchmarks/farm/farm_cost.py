#!/usr/bin/env python3
"""Measures the cost of parts: farm_cost.py BDPT SCENE [--parts 64] [--large-parts 8] [--folder FOLDER].

- bdpt merge of many parts at 1920x1080, and of some at 3840x2160: CPU time and peak memory
- a checkpoint at 1920x1080: CPU time
- one render by one process of two threads, and by two and four processes of one thread: total CPU time, merging
  included, as a ratio

Measures CPU time, because machines are shared; prints a table in Markdown. Takes ten minutes and 4 GB of disk."""

import argparse
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

SIZES = {"1920x1080": "parts", "3840x2160": "large_parts"}
CHECKPOINTS = 5


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bdpt", type=pathlib.Path)
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("--parts", type=int, default=64)
    parser.add_argument("--large-parts", type=int, default=8)
    parser.add_argument("--folder", type=pathlib.Path, help="for the parts; default: a temporary one")
    return parser.parse_args()


class Cost:
    """CPU time and peak memory of a process."""

    def __init__(self, usage):
        self.cpu = usage.ru_utime + usage.ru_stime  # [s]
        self.memory = usage.ru_maxrss / 1024  # [MB]


class Command:
    def __init__(self, arguments):
        self.bdpt = str(arguments.bdpt.resolve())
        self.scene = str(arguments.scene.resolve())

    def start(self, *words):
        return subprocess.Popen([self.bdpt, *map(str, words), "--quiet"])

    def wait(self, process):
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        return Cost(usage) if process.returncode == 0 else sys.exit(f"{process.args}: {process.returncode}")

    def run(self, *words):
        return self.wait(self.start(*words))

    def render(self, *words):
        return self.run("render", self.scene, "--integrator", "mis", *words)


def measure_merges(command, arguments, folder):
    for size, option in SIZES.items():
        count = getattr(arguments, option)
        parts = [folder / f"{size}-{i}.part.exr" for i in range(count)]
        for i, part in enumerate(parts):
            command.render("--size", size, "--samples", f"{i}:{i + 1}", "--part", part)
        merged = command.run("merge", *parts, "-o", folder / "merged.exr")
        megabytes = sum(part.stat().st_size for part in parts) / 1e6
        print(f"| merge of {count} parts of one sample at {size} ({megabytes:.0f} MB) | {merged.cpu:.1f} s of CPU time, "
              f"{merged.cpu / count:.2f} s a part | {merged.memory:.0f} MB |", flush=True)
        for part in parts:
            part.unlink()


def measure_checkpoints(command, folder):
    """Measures five checkpoints in a row, less a render that only writes its final part."""
    words = ["render", command.scene, "--integrator", "mis", "--size", "1920x1080", "--spp", "12", "--threads", "2"]
    costs = []
    for count in (0, CHECKPOINTS):
        part = folder / f"checkpoints-{count}.part.exr"
        process = command.start(*words, "--part", part)
        time.sleep(3)  # a signal before the render begins would end it
        written = 0
        before = None
        while written < count and process.poll() is None:
            process.send_signal(signal.SIGUSR1)
            while process.poll() is None and (now := part.stat().st_mtime_ns if part.exists() else None) == before:
                time.sleep(0.05)
            before = now
            written += 1
        costs.append(command.wait(process))
    each = (costs[1].cpu - costs[0].cpu) / CHECKPOINTS
    print(f"| a checkpoint at 1920x1080 | {each:.1f} s of CPU time; at one a minute {each / 60:.1%} of a core "
          f"| {costs[1].memory:.0f} MB |", flush=True)


def measure_processes(command, folder):
    words = ["--size", "640x480", "--max-depth", "8"]
    samples = 64
    alone = command.render(*words, "--spp", samples, "--threads", "2", "-o", folder / "alone.exr")
    print(f"| one process of two threads | {alone.cpu:.1f} s of CPU time: 1 | |", flush=True)
    for count in (2, 4):
        step = samples // count
        parts = [folder / f"{count}-{i}.part.exr" for i in range(count)]
        running = [command.start("render", command.scene, "--integrator", "mis", *words, "--threads", "1", "--samples",
                                 f"{i * step}:{(i + 1) * step}", "--part", part) for i, part in enumerate(parts)]
        total = sum(command.wait(process).cpu for process in running)
        total += command.run("merge", *parts, "-o", folder / "merged.exr").cpu
        print(f"| {count} processes of one thread, and merge | {total:.1f} s of CPU time: {total / alone.cpu:.2f} | |",
              flush=True)


def main():
    arguments = parse()
    command = Command(arguments)
    with tempfile.TemporaryDirectory(dir=arguments.folder) as name:
        folder = pathlib.Path(name)
        print("| | time | greatest memory |\n|---|---|---|", flush=True)
        measure_processes(command, folder)
        measure_checkpoints(command, folder)
        measure_merges(command, arguments, folder)


if __name__ == "__main__":
    main()
