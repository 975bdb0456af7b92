#!/usr/bin/env python3
"""Measures how long whole scenes take: scene_times.py BDPT [FILE...] [--triangles N]... [--rounds 3].

The scenes are the files given or all of scenes/, then bumpy spheres of about N triangles by make_large_scene.py. The
table has wall-clock seconds from --stats: to read the file, to prepare the scene (BVH, lights, materials), and to
render 16 samples of 192 x 192 pixels by path tracing with MIS. All are medians of rounds.
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PHASES = ("load", "build", "render")


def measure(bdpt, scene, folder):
    stats = folder / "stats.json"
    subprocess.run([bdpt, "render", str(scene), "--integrator", "mis", "--size", "192x192", "--spp", "16", "--quiet", "-o",
                    str(folder / "out.exr"), "--stats", str(stats)], check=True)
    return json.loads(stats.read_text(encoding="utf-8"))


def count_triangles(bdpt, scene):
    done = subprocess.run([bdpt, "info", str(scene), "--json"], check=True, stdout=subprocess.PIPE, text=True)
    return json.loads(done.stdout)["triangles"]["in_scene"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bdpt")
    parser.add_argument("files", nargs="*", metavar="FILE")
    parser.add_argument("--triangles", action="append", default=[], metavar="N")
    parser.add_argument("--rounds", type=int, default=3)
    arguments = parser.parse_args()
    print("| scene | triangles | read | build | 16 samples |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        files = [pathlib.Path(file) for file in arguments.files] or sorted((ROOT / "scenes").glob("*.gltf"))
        for triangles in arguments.triangles:
            files.append(folder / f"ball-{triangles}.glb")
            subprocess.run([sys.executable, str(ROOT / "benchmarks/make_large_scene.py"), str(files[-1]), "--triangles",
                            triangles], check=True, stdout=subprocess.DEVNULL)
        for file in files:
            rounds = [measure(arguments.bdpt, file, folder) for _ in range(arguments.rounds)]
            times = [statistics.median(told["seconds"][phase] for told in rounds) for phase in PHASES]
            print(f"| `{file.stem}` | {count_triangles(arguments.bdpt, file):,} | "
                  + " | ".join(f"{seconds:.3f} s" for seconds in times) + " |", flush=True)


if __name__ == "__main__":
    main()
