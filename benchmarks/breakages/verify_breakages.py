#!/usr/bin/env python3
"""Breaks bdpt on purpose, one change at a time, and tests that `bdpt verify` detects it: verify_breakages.py [NAME...]

Applies each breakage of breakages.py to a copy of the sources, builds the copy and runs `bdpt verify`, which must fail
on the breakage's scene. NAME is a part of a breakage's name; by default all are tried. The exit code is 1 if one is
missed."""

import argparse
import pathlib
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True
from breakages import BREAKAGES

ROOT = pathlib.Path(__file__).resolve().parents[2]
CAUGHT = 10  # exit code of `bdpt verify`


def copy_sources(folder):
    """Copies the sources. Leaves unchanged files alone, so that builds are incremental."""
    for part in ("CMakeLists.txt", "LICENSE", "README.md", "cmake", "lib", "apps", "benchmarks"):
        for source in [ROOT / part] if (ROOT / part).is_file() else (ROOT / part).rglob("*"):
            copy = folder / source.relative_to(ROOT)
            if source.is_file() and not (copy.exists() and copy.read_bytes() == source.read_bytes()):
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(source, copy)


def build(folder):
    """Builds the copy; returns the path of the command. Raises CalledProcessError."""
    done = folder / "build"
    if not (done / "CMakeCache.txt").exists():
        subprocess.run(["cmake", "-S", folder, "-B", done, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                        "-DBDPT_BUILD_TESTS=OFF", "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=32"], check=True, stdout=subprocess.DEVNULL)
    made = subprocess.run(["cmake", "--build", done, "--target", "bdpt_app"], capture_output=True, text=True)
    if made.returncode:
        sys.exit(f"verify_breakages: it does not build:\n{made.stdout[-4000:]}")
    return done / "apps/bdpt"


def verify(bdpt, breakage, seconds):
    """Runs `bdpt verify`; returns its exit code and first finding."""
    done = subprocess.run([bdpt, "verify", ROOT / "scenes" / breakage.scene, "--time", f"{seconds}s",
                           *breakage.options], capture_output=True, text=True)
    _, _, findings = done.stdout.rstrip().rpartition("\n\n")  # the last paragraph: findings, then the verdict
    return done.returncode, findings.splitlines()[0].strip() if findings else done.stderr.strip()


def try_breakage(breakage, folder, seconds):
    """Returns whether `bdpt verify` detects the breakage. Restores the sources afterwards."""
    file = folder / breakage.file
    text = file.read_text(encoding="utf-8")
    if text.count(breakage.old) != 1:
        sys.exit(f"verify_breakages: {breakage.name}: {breakage.file} does not hold this once: {breakage.old}")
    file.write_text(text.replace(breakage.old, breakage.new), encoding="utf-8")
    try:
        code, told = verify(build(folder), breakage, seconds)
    finally:
        file.write_text(text, encoding="utf-8")
    verdict = "caught" if code == CAUGHT else "NOT CAUGHT"
    print(f"{verdict}: {breakage.name} ({breakage.scene}): {told}", flush=True)
    return code == CAUGHT


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--work", type=pathlib.Path, default=ROOT / "build/breakages", help="where the copy is built")
    parser.add_argument("--time", type=float, default=20, metavar="SECONDS", help="the most that each may take (20)")
    arguments = parser.parse_args()
    chosen = [b for b in BREAKAGES if not arguments.names or any(name in b.name for name in arguments.names)]
    if not chosen:
        parser.error("no such breakage; there are: " + "; ".join(b.name for b in BREAKAGES))
    arguments.work.mkdir(parents=True, exist_ok=True)
    copy_sources(arguments.work)
    caught = [try_breakage(breakage, arguments.work, arguments.time) for breakage in chosen]
    print(f"{sum(caught)} of {len(caught)} caught")
    return 0 if all(caught) else 1


if __name__ == "__main__":
    sys.exit(main())
