#!/usr/bin/env python3
"""Renders scenes with bdpt and other renderers; compares their means, then their errors at equal time.

compare_peers.py SCENE... -o DIR --bdpt BIN [--python VENV/bin/python] [--blender BLENDER]

Writes DIR/results.txt, results.csv and results.json, and the images. Skips renderers that are not installed."""

import argparse
import dataclasses
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import contest
import peers
import report
from scene import Medium, NotShared

CPU_SCENE = pathlib.Path(__file__).resolve().parents[2] / "scenes" / "cornell-box.gltf"
CPU_SIZE, CPU_DEPTH = (512, 512), 11


def size(text):
    match = re.fullmatch(r"(\d+)x(\d+)", text)
    if not match or 0 in map(int, match.groups()):
        raise argparse.ArgumentTypeError(f"{text} is not a size like 64x64")
    return tuple(map(int, match.groups()))


def extinction(text):
    numbers = [float(part) for part in text.split(",")]
    if len(numbers) not in (1, 3) or not all(0 < number < float("inf") for number in numbers):
        raise argparse.ArgumentTypeError(f"{text} is neither one number above 0 nor three")
    return tuple(numbers * (3 // len(numbers)))


def positive(kind):
    def parse(text):
        value = kind(text)
        if not value > 0 or value == float("inf"):
            raise argparse.ArgumentTypeError(f"{text} is not above 0")
        return value
    parse.__name__ = kind.__name__
    return parse


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("scenes", nargs="+", type=pathlib.Path, metavar="SCENE",
                        help="glTF files like those of scenes/")
    parser.add_argument("-o", "--output", required=True, type=pathlib.Path, metavar="DIR")
    parser.add_argument("--bdpt", required=True, help="the command")
    parser.add_argument("--python", default=sys.executable, help="the interpreter that has mitsuba and pyluxcore")
    parser.add_argument("--blender", default="blender", help="Blender's command")
    parser.add_argument("--time", type=positive(float), default=2.0, metavar="S", help="seconds of a run; 2")
    parser.add_argument("--reference-time", type=positive(float), metavar="S", help="16 times --time if not given")
    parser.add_argument("--seeds", type=positive(int), default=3, metavar="N", help="runs of each; 3")
    parser.add_argument("--size", type=size, default=(64, 64), metavar="WxH", help="64x64")
    parser.add_argument("--max-depth", type=positive(int), default=32, metavar="N", help="longest path in edges; 32")
    parser.add_argument("--threads", type=positive(int), default=2, metavar="N", help="2")
    parser.add_argument("--fog", type=extinction, metavar="X|R,G,B", help="white fog in all scenes: its extinction [1/m]")
    parser.add_argument("--volume", type=pathlib.Path, metavar="FILE", help="white smoke in all scenes: an OpenVDB file, "
                        "which takes the Python module pyopenvdb to read")
    parser.add_argument("--volume-extinction", type=extinction, default=(1.0, 1.0, 1.0), metavar="X|R,G,B",
                        help="where its density is 1 [1/m]; 1")
    parser.add_argument("--only", help="entries, with commas between: " + ",".join(e.name for e in peers.ENTRIES))
    parser.add_argument("--cpu", action="store_true", help="also CPU time for a sample per pixel, of the Cornell box")
    result = parser.parse_args()
    names = {entry.name for entry in peers.ENTRIES}
    wrong = set(result.only.split(",")) - names if result.only else set()
    if wrong:
        parser.error(f"no such entry: {', '.join(sorted(wrong))}")
    if result.max_depth < 2:
        parser.error("--max-depth is at least 2: Cycles has no shorter paths")
    if result.fog and result.volume:
        parser.error("--fog and --volume do not go together: Mitsuba's media exclude each other")
    return result


def find_peers(entries, args):
    """Returns the peers that work (name -> Peer) and why others do not (name -> reason)."""
    found, missing = {}, {}
    commands = peers.commands(args.python, args.blender)
    with tempfile.TemporaryDirectory() as folder:
        for name in dict.fromkeys(entry.peer for entry in entries if entry.peer != "bdpt"):
            try:
                found[name] = peers.find(name, commands[name], pathlib.Path(folder))
            except peers.Unavailable as error:
                missing[name] = str(error)
                print(f"{name}: skipped: {error}", flush=True)
    return found, missing


def compare_on_scene(options, file, entries, found, folder):
    """Renders and compares one scene; returns the results."""
    stage = contest.Stage(options, file, folder / file.stem)
    stage.make_reference()
    runs, skipped = contest.contest(stage, entries, found, lambda line: print(line, flush=True))
    return {"scene": stage.name, "width": options.size[0], "height": options.size[1], "max_depth": options.max_depth,
            "changes": stage.scene.changes, "skipped": skipped, "reference": stage.reference_run,
            **contest.judge(stage, runs)}


def measure_cpu_cost(options, entries, found, folder):
    """Returns the CPU seconds per sample and pixel of each entry, with one thread."""
    alone = dataclasses.replace(options, size=CPU_SIZE, max_depth=CPU_DEPTH, threads=1, seeds=1, fog=None,
                                volume=None)
    stage = contest.Stage(alone, CPU_SCENE, folder / "cpu")
    runs, skipped = contest.contest(stage, entries, found, lambda line: print(line, flush=True))
    return {"scene": stage.name, "width": CPU_SIZE[0], "height": CPU_SIZE[1], "max_depth": CPU_DEPTH,
            "skipped": skipped, "runs": runs,
            "cost": {name: run["cpu_seconds"] / run["samples"] for name, (run,) in runs.items()}}


def main():
    args = arguments()
    chosen = {"bdpt", *args.only.split(",")} if args.only else {entry.name for entry in peers.ENTRIES}
    entries = [entry for entry in peers.ENTRIES if entry.name in chosen]
    args.output = args.output.resolve()  # Blender resolves relative names against another folder
    args.output.mkdir(parents=True, exist_ok=True)
    found, missing = find_peers(entries, args)
    entries = [entry for entry in entries if entry.peer == "bdpt" or entry.peer in found]
    options = contest.Options(args.bdpt, args.time, args.reference_time or 16 * args.time, args.seeds, args.size,
                              args.max_depth, args.threads, args.fog and Medium(args.fog, (1.0, 1.0, 1.0)),
                              args.volume and str(args.volume.resolve()), args.volume_extinction)
    document = {"command": shlex.join(sys.argv), "machine": report.machine(),
                "options": dataclasses.asdict(options), "notes": {e.name: e.note for e in entries if e.note},
                "peers": {name: {"version": peer.version, "job": peer.job, "environment": peer.environment}
                          for name, peer in found.items()},
                "missing": missing, "refused": {}, "scenes": []}
    for file in args.scenes:
        try:
            document["scenes"].append(compare_on_scene(options, file, entries, found, args.output))
        except NotShared as error:
            document["refused"][file.stem] = str(error)
        report.write(document, args.output)  # keeps finished results if a later scene fails
    if args.cpu:
        document["cpu"] = measure_cpu_cost(options, entries, found, args.output)
    report.write(document, args.output)
    print("\n" + report.text(document), end="")


if __name__ == "__main__":
    try:
        main()
    except (OSError, subprocess.CalledProcessError) as error:
        sys.exit(f"compare_peers.py: {error}")
