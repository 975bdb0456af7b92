#!/usr/bin/env python3
"""Tests that a command whose output gets lost fails with an exit code: streams_test.py COMMAND SCENE."""

import os
import pathlib
import stat
import subprocess
import sys
import tempfile

COMMAND, SCENE = sys.argv[1:3]
HOW = ["--size", "16x12", "--spp", "2"]
PRINTING = [
    ["--help"], ["--version"], ["help"], ["help", "render"], ["version"], ["render", "--help"],
    ["info", SCENE], ["info", SCENE, "--json"], ["info", "--limits"],
    ["render", SCENE, *HOW, "-o", "a.exr", "--json"],
    ["render", SCENE, *HOW, "-o", "-"],
    ["render", SCENE, *HOW, "-o", "png:-"],
    ["render", SCENE, *HOW, "-o", "a.exr", "--stats", "-"],
    ["render", SCENE, *HOW, "-o", "a.exr", "--stats", "stdout"],  # the link `stdout`
    ["merge", "a.part.exr", "-o", "a.exr", "--json"],
    ["merge", "a.part.exr", "-o", "-"],
    ["compare", "b.exr", "b.exr"],
    ["compare", "b.exr", "b.exr", "--json"],
    ["inspect", SCENE, "--pixel", "8,6", "--size", "16x12"],
    ["plan", SCENE, *HOW, "-o", "c.exr", "--parts", "1", "--for", "make", "-d", "job", "--json"],
]
QUIET = ["render", SCENE, *HOW, "-o", "a.exr"]


def bdpt(words, redirection, cwd):
    """Runs the command through a shell."""
    return subprocess.run(["sh", "-c", f'exec "$0" "$@" {redirection}', COMMAND, *words], stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False, cwd=cwd, timeout=120)


def checks(folder):
    for words in PRINTING:
        for redirection in (">&-", ">full"):
            done = bdpt(words, redirection, folder)
            message = done.stderr.decode()
            what = f"{' '.join(words)} {redirection}: {done.returncode}: {message}"
            yield what, done.returncode == 6 and message.splitlines()[-1].startswith("bdpt: error: ")
    yield "images are kept", (folder / "a.exr").exists()
    for redirection in ("<&-", ">&-", "2>&-", "<&- >&- 2>&-"):
        (folder / "a.exr").unlink(missing_ok=True)
        done = bdpt(QUIET, redirection, folder)
        yield f"{redirection}: nothing gets lost", done.returncode == 0 and (folder / "a.exr").exists()
    done = bdpt(QUIET, "2>full", folder)
    yield "a full standard error", done.returncode == 6
    done = bdpt(["render", "-", *HOW, "-o", "a.exr"], "<&-", folder)
    yield f"a closed input: {done.stderr}", done.returncode == 3
    # A reader that is gone before it starts, as "head" may be.
    for words in (["--help"], ["plan", "--help"], ["render", "--help-all"], ["help", "render"]):
        reader, writer = os.pipe()
        os.close(reader)
        done = subprocess.run([COMMAND, *words], stdin=subprocess.DEVNULL, stdout=writer, stderr=subprocess.PIPE, check=False)
        os.close(writer)
        yield f"{' '.join(words)} to a closed pipe: {done.stderr}", done.returncode == 0 and not done.stderr
    # The reader closes the pipe; the image must survive.
    (folder / "a.exr").unlink(missing_ok=True)
    done = bdpt([*QUIET, "--json"], "| true", folder)
    yield "a reader that left", (folder / "a.exr").exists()


with tempfile.TemporaryDirectory() as name:
    FOLDER = pathlib.Path(name)
    (FOLDER / "stdout").symlink_to("/proc/self/fd/1")
    if os.geteuid() == 0:  # root could lose the system's files
        os.mknod(FOLDER / "full", 0o666 | stat.S_IFCHR, os.makedev(1, 7))
    else:
        (FOLDER / "full").symlink_to("/dev/full")
    subprocess.run([COMMAND, "render", SCENE, *HOW, "-o", "b.exr", "--part", "a.part.exr", "-q"], check=True, cwd=FOLDER)
    RESULTS = list(checks(FOLDER))
FAILED = [what for what, passed in RESULTS if not passed]
print("\n".join(f"failed: {what}" for what in FAILED) or f"{len(RESULTS)} checks passed")
sys.exit(1 if FAILED else 0)
