#!/usr/bin/env python3
"""Tests that bdpt works as process 1 of a container as it does elsewhere, and that two of these with the same host name
and pid do not damage each other's parts: process_one_test.py COMMAND SCENE. Exits with 77 (skipped) where processes
may not create namespaces."""

import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

COMMAND, SCENE = sys.argv[1:3]
ISOLATED = ["unshare", "--user", "--map-root-user", "--pid", "--fork", "--kill-child", "--mount-proc"]
WORDS = [SCENE, "--size", "64x48", "--integrator", "bdpt", "--threads", "1", "--quiet"]


def start(*words):
    return subprocess.Popen([*ISOLATED, COMMAND, "render", *WORDS, *map(str, words)])


def find_outer_pid(process):
    """Returns the outer pid of the container's process 1. Raises OSError if it has ended."""
    for _ in range(200):
        if process.poll() is not None:
            raise ProcessLookupError
        children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
        if children:
            status = pathlib.Path(f"/proc/{children[0]}/status").read_text()
            if "bdpt" in status.splitlines()[0]:
                assert "NSpid:\t" in status and status.split("NSpid:\t")[1].split("\n")[0].split()[-1] == "1"
                return int(children[0])
        time.sleep(0.05)
    raise RuntimeError("bdpt has not started")


def awaits(pid, number):
    """Tests whether the process blocks the signal or has a handler: process 1 ignores all others."""
    fields = dict(line.split(":", 1) for line in pathlib.Path(f"/proc/{pid}/status").read_text().splitlines())
    return (int(fields["SigBlk"], 16) | int(fields["SigCgt"], 16)) >> (number - 1) & 1


def send(process, number):
    try:
        os.kill(find_outer_pid(process), number)
    except OSError:
        pass  # the process has ended


def main():
    permitted = subprocess.run([*ISOLATED, "true"], capture_output=True, check=False)
    if permitted.returncode != 0:
        print("skipped: no namespaces here")
        sys.exit(77)
    checks = []

    def check(what, good):
        checks.append(good)
        print(f"{'ok  ' if good else 'FAIL'} {what}")

    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        part = folder / "a.part.exr"
        process = start("--spp", 2_000_000_000, "--part", part)
        try:
            while not awaits(find_outer_pid(process), signal.SIGTERM):
                time.sleep(0.05)
            time.sleep(2)
            send(process, signal.SIGTERM)
            # unshare passes the exit code on.
            code = process.wait(timeout=60)
        finally:
            process.kill()
        check(f"SIGTERM to process 1: exit code {code}", code == 143)
        check("and its part is there", part.exists())
        part.unlink()

        # Runs two containers, both with process 1, on one target, with as many writes as possible.
        both = [start("--spp", 1000, "--part", part) for _ in range(2)]
        while all(process.poll() is None for process in both):
            for process in both:
                send(process, signal.SIGUSR1)
            time.sleep(0.05)
        check("two writers of one part both succeed", [process.wait(timeout=300) for process in both] == [0, 0])
        merged = subprocess.run([COMMAND, "merge", part, "-o", folder / "out.exr", "--spp", "1000"], check=False)
        check("and what is there is whole", merged.returncode == 0)
        check("with nothing beside it", {file.name for file in folder.iterdir()} == {"a.part.exr", "out.exr"})
    sys.exit(not all(checks))


if __name__ == "__main__":
    main()
