#!/usr/bin/env python3
"""Measures the memory of a triangle: load_memory.py BDPT [--triangles 1000000].

BDPT is the command. It renders a scene of that many triangles and one of a few; the script prints the difference of the
peak memory of both processes, divided by the number of triangles.
"""

import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

MAKER = pathlib.Path(__file__).parent / "make_large_scene.py"


def make_scene(path, triangles):
    """Writes the scene; returns its number of triangles. Runs in a separate process: peak memory of this one would
    count for its children too."""
    done = subprocess.run([sys.executable, str(MAKER), str(path), "--triangles", str(triangles)], check=True,
                          capture_output=True, text=True)
    return int(done.stdout.split()[-2])


def peak_bytes(command):
    """Returns the peak resident set of a process [bytes]."""
    process = subprocess.Popen(command)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"{command[0]} ended with exit code {process.returncode}")
    return usage.ru_maxrss * 1024


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("bdpt", help="the command that renders")
    parser.add_argument("--triangles", type=int, default=1000000)
    parser.add_argument("--rounds", type=int, default=3)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder)
        counts = {name: make_scene(path / name, triangles)
                  for name, triangles in (("few.glb", 8), ("many.glb", arguments.triangles))}

        def peak(name):
            return peak_bytes([arguments.bdpt, "render", str(path / name), "--spp", "1", "--size", "64x64", "--quiet",
                               "-o", str(path / "out.exr")])

        pairs = [(peak("few.glb"), peak("many.glb")) for _ in range(arguments.rounds)]
    few, many = (sorted(peaks)[len(peaks) // 2] for peaks in zip(*pairs))
    triangles = counts["many.glb"] - counts["few.glb"]
    print(f"{few / 1e6:.1f} MB with {counts['few.glb']} triangles, {many / 1e6:.1f} MB with {counts['many.glb']}: "
          f"{(many - few) / triangles:.0f} bytes a triangle")


if __name__ == "__main__":
    main()
