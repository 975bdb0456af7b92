#!/usr/bin/env python3
"""Renders many small images with two programs, and lists those that are not equal to the bit:

    same_bits.py BDPT_BEFORE BDPT_AFTER [--scenes FOLDER] [--quick] [--only REGEX] [--keep FOLDER]
                 [--rename OLD=NEW]... [--list]

Checks changes of the code that must not change images. Compares the pixels of all files (.exr, .png), the counts of
rays and paths (--stats), the metadata, and the warnings, but no clocks. The exit code is 1 if anything differs, 2 if
nothing was compared.
"""

import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import cases
import differences

ROOT = pathlib.Path(__file__).resolve().parents[2]
HOW = ("--size", "16x12", "--spp", "2", "--threads", "1", "--json")


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("before", type=pathlib.Path)
    parser.add_argument("after", type=pathlib.Path)
    parser.add_argument("--scenes", type=pathlib.Path, default=ROOT / "scenes")
    parser.add_argument("--quick", action="store_true", help="a part of the cases that has every option once")
    parser.add_argument("--only", metavar="REGEX", default="", help="cases whose name (--list) has it")
    parser.add_argument("--keep", type=pathlib.Path, metavar="FOLDER", help="leave all files here")
    parser.add_argument("--rename", action="append", default=[], metavar="OLD=NEW",
                        help="an option that the second program calls NEW")
    parser.add_argument("--list", action="store_true", help="print the names of the cases and render nothing")
    return parser.parse_args(words)


def choose_cases(options):
    found = cases.all_cases(sorted(options.scenes.glob("*.gltf")))
    found = cases.quick_cases(found) if options.quick else found
    return [case for case in found if re.search(options.only, case.name)]


def build_command(case, folder, environment, renamed):
    names = {cases.ENVIRONMENT: str(environment)}
    words = [renamed.get(word, names.get(word, word.replace(cases.FOLDER, str(folder))))
             for word in ("--integrator", case.integrator, *HOW, *case.options.words, "--stats", f"{folder}/stats.json")]
    return ["render", str(case.scene), "-o", f"{folder}/out.exr", *words]


def filter_events(stdout):
    """Returns the printed events, without progress and file names."""
    events = [json.loads(line) for line in stdout.splitlines()]
    return [event for event in events if event["event"] in ("warning", "error")]


def render(program, words, folder):
    """Runs a render; returns its exit code, warnings and errors."""
    folder.mkdir(parents=True, exist_ok=True)
    done = subprocess.run([str(program), *words], stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=600,
                          check=False)
    return done.returncode, filter_events(done.stdout), done.stderr.strip()


def compare(case, options, folder, environment):
    """Returns one line for each difference. A failed render is one, even if both fail: there is nothing to compare."""
    renamed = dict(pair.split("=", 1) for pair in options.rename)
    sides = [(options.before, folder / "before", {}), (options.after, folder / "after", renamed)]
    results = [render(program, build_command(case, place, environment, names), place) for program, place, names in sides]
    failures = [f"{place.name}: exit code {code}: {error or events}"
                for (_, place, _), (code, events, error) in zip(sides, results) if code]
    if failures:
        return failures
    (_, before, _), (_, after, _) = results
    found = [f"warnings: {before} became {after}"] if before != after else []
    return found + differences.of_folders(folder / "before", folder / "after")


def run(options, folder):
    """Returns the number of cases that differ."""
    environment = folder / "environment.hdr"
    cases.write_environment(environment)
    different = 0
    for i, case in enumerate(options.cases):
        found = compare(case, options, folder / f"{i:04}", environment)
        different += bool(found)
        for line in found:
            print(f"{case.name}: {line}", flush=True)
    return different


def main():
    options = parse(sys.argv[1:])
    options.cases = choose_cases(options)
    if options.list:
        print("\n".join(case.name for case in options.cases))
        return
    for program in (options.before, options.after):
        if not program.is_file():
            print(f"same_bits: no such program: {program}", file=sys.stderr)
            sys.exit(2)
    with tempfile.TemporaryDirectory() as name:
        folder = options.keep or pathlib.Path(name)
        folder.mkdir(parents=True, exist_ok=True)
        different = run(options, folder)
    print(f"{len(options.cases)} compared, {different} different")
    sys.exit(2 if not options.cases else 1 if different else 0)


if __name__ == "__main__":
    main()
