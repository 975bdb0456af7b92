#!/usr/bin/env python3
"""Measures how large scenes load: scale_table.py BDPT [KIND...] [--count KIND=N] [--rounds 3].

BDPT is the command. Each scene of make_scale_scene.py is written to a temporary folder (--folder), rendered at 32 x 32
pixels with one sample each, and deleted before the next. The table has, for the median round, the time to read the
file, to build the scene and to render, the wall-clock time of the process, its CPU time, which other programs disturb
less, and its peak memory.
"""

import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

from make_scale_scene import COUNTS

MAKER = pathlib.Path(__file__).parent / "make_scale_scene.py"


def run(command):
    """Runs a process; returns seconds, CPU seconds and peak resident set [bytes]."""
    begin = os.times().elapsed
    process = subprocess.Popen(command)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"{' '.join(command)} ended with exit code {process.returncode}")
    return os.times().elapsed - begin, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024


def measure(bdpt, scene, folder, threads):
    """Returns one line's figures: those of --stats, and the resources of the process."""
    stats = folder / "stats.json"
    command = [bdpt, "render", str(scene), "--size", "32x32", "--spp", "1", "--quiet", "-o", str(folder / "out.exr"),
               "--stats", str(stats)] + (["--threads", str(threads)] if threads else [])
    seconds, cpu, memory = run(command)
    return {**json.loads(stats.read_text(encoding="utf-8"))["seconds"], "process": seconds, "cpu": cpu,
            "memory": memory}


def line(kind, count, size, rounds, empty):
    """Formats a line. `empty` is the memory [bytes] of a process that renders almost nothing."""
    median = {key: statistics.median(r[key] for r in rounds) for key in rounds[0]}
    each = (median["memory"] - empty) / count
    times = " | ".join(f"{median[key]:.2f} s" for key in ("load", "build", "render", "process", "cpu"))
    return f"| {count:,} {kind} | {size / 1e6:.0f} MB | {times} | {median['memory'] / 1e6:.0f} MB | {each:,.0f} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bdpt", help="the command that renders")
    parser.add_argument("kinds", nargs="*", metavar="KIND", help="all if none is given")
    parser.add_argument("--count", action="append", default=[], metavar="KIND=N")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--threads", type=int, default=0)
    parser.add_argument("--folder", help="where scenes are written; at most 400 MB at a time")
    arguments = parser.parse_args()
    counts = {**COUNTS, **{kind: int(number) for kind, number in (c.split("=") for c in arguments.count)}}
    kinds = arguments.kinds or list(COUNTS)
    for kind in {*kinds, *counts} - COUNTS.keys():
        sys.exit(f"no such kind of scene: {kind}; there are {', '.join(COUNTS)}")
    print("| scene | file | read | build | first image | in all | CPU | "
          "peak memory | bytes each |\n|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory(dir=arguments.folder) as temporary:
        folder = pathlib.Path(temporary)

        def figures(kind, count):
            scene = folder / f"{kind}.glb"
            subprocess.run([sys.executable, str(MAKER), kind, str(scene), "--count", str(count)], check=True)
            size = scene.stat().st_size
            rounds = [measure(arguments.bdpt, scene, folder, arguments.threads) for _ in range(arguments.rounds)]
            scene.unlink()
            return size, rounds

        _, rounds = figures("triangles", 8)
        empty = statistics.median(r["memory"] for r in rounds)
        for kind in kinds:
            size, rounds = figures(kind, counts[kind])
            print(line(kind, counts[kind], size, rounds, empty), flush=True)


if __name__ == "__main__":
    main()
