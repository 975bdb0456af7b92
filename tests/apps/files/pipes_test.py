#!/usr/bin/env python3
"""Tests that scenes from the standard input and images to the standard output equal those of files:
pipes_test.py COMMAND SCENE."""

import fcntl
import json
import os
import pathlib
import pty
import signal
import subprocess
import sys
import tempfile
import termios
import time

COMMAND, SCENE = sys.argv[1:3]
HOW = ["--size", "16x12", "--spp", "4", "--quiet"]
PNG = b"\x89PNG"
EXR = b"\x76\x2f\x31\x01"


def bdpt(*words, source=None, cwd=None):
    with open(source or os.devnull, "rb") as stream:
        return subprocess.run([COMMAND, *map(str, words)], stdin=stream, capture_output=True, check=False, cwd=cwd)


def are_equal(a, b, **more):
    """Returns whether the images in two files are equal."""
    return bdpt("compare", a, b, "--threshold", "mse=0", **more).returncode == 0


def check_images(folder):
    from_file = folder / "file.exr"
    piped = folder / "piped.exr"
    bdpt("render", SCENE, *HOW, "-o", from_file)
    # URIs of a scene from a pipe are relative to the working directory.
    done = bdpt("render", "-", *HOW, "-o", "-", source=SCENE, cwd=pathlib.Path(SCENE).parent)
    piped.write_bytes(done.stdout)
    yield "EXR", done.stdout[:4] == EXR and are_equal(piped, from_file)
    yield "compare from a pipe", are_equal("-", from_file, source=piped)
    yield "PNG", bdpt("render", SCENE, *HOW, "-o", "png:-").stdout[:4] == PNG
    yield "EXR by name", bdpt("render", SCENE, *HOW, "-o", "exr:-").stdout[:4] == EXR
    both = bdpt("render", SCENE, *HOW, "-o", folder / "beside.exr", "-o", "-")
    piped.write_bytes(both.stdout)
    yield "a pipe beside a file", are_equal(piped, folder / "beside.exr")
    frames = folder / "turn.##.exr"
    bdpt("render", "-", *HOW, "--orbit", "2", "--frames", "1:2", "-o", frames, source=SCENE)
    yield "frames of one pipe", all((folder / f"turn.0{i}.exr").exists() for i in (1, 2))


def check_other_commands(folder):
    part = folder / "a.part.exr"
    bdpt("render", SCENE, *HOW, "--part", part)
    yield "merge", bdpt("merge", part, "-o", "png:-", "--quiet").stdout[:4] == PNG
    yield "info", b"nodes" in bdpt("info", "-", source=SCENE).stdout
    stats = bdpt("render", SCENE, *HOW, "-o", folder / "a.png", "--stats", "-")
    yield "stats", json.loads(stats.stdout)["samples"] == 4


def check_refusals(folder):
    yield "empty input", bdpt("render", "-", *HOW, "-o", "-").returncode == 4
    zeros = subprocess.Popen([COMMAND, "render", "-", *HOW, "-o", "-"], stdin=open("/dev/zero", "rb"),
                             stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    line = zeros.stderr.read()
    _, status, usage = os.wait4(zeros.pid, 0)
    zeros.returncode = os.waitstatus_to_exitcode(status)
    yield "an input without end", zeros.returncode == 4 and line.startswith(b"bdpt: error: -: ")
    yield "the memory of an input without end", usage.ru_maxrss < 200_000  # [KiB]
    yield "two outputs", bdpt("render", SCENE, *HOW, "-o", "-", "-o", "png:-").returncode == 2
    yield "JSON beside an image", bdpt("render", SCENE, *HOW, "-o", "-", "--json").returncode == 2
    yield "two inputs", bdpt("render", "-", "--env", "-", *HOW, "-o", "-", source=SCENE).returncode == 2
    yield "several frames", bdpt("render", SCENE, *HOW, "--orbit", "2", "-o", "-").returncode == 2
    plan = ["--spp", "8", "--parts", "2", "--for", "make", "-d", folder / "job"]
    yield "plan of an input", bdpt("plan", "-", "-o", "a.png", *plan, source=SCENE).returncode == 2
    yield "plan of an output", bdpt("plan", SCENE, "-o", "-", *plan).returncode == 2
    with open("/dev/full", "wb") as full:
        done = subprocess.run([COMMAND, "render", SCENE, *HOW, "-o", "-"], stdout=full, stderr=subprocess.PIPE,
                              check=False)
    yield "a full output", done.returncode == 6 and b"standard output" in done.stderr
    _, terminal = pty.openpty()
    done = subprocess.run([COMMAND, "render", "-", *HOW, "-o", "a.exr"], stdin=terminal, stderr=subprocess.PIPE,
                          check=False, cwd=folder)
    yield "a terminal as input", done.returncode == 3 and b"terminal" in done.stderr
    done = subprocess.run([COMMAND, "render", SCENE, *HOW, "-o", "-"], stdout=terminal, stderr=subprocess.PIPE,
                          check=False)
    yield "a terminal as output", done.returncode == 6 and b"terminal" in done.stderr


def end_of(stalled, *signals):
    """Sends signals to a process, each when the one before has been handled. Returns the exit code; None if it goes
    on."""
    try:
        for number in signals:
            stalled.send_signal(number)
            time.sleep(0.3)
        return stalled.wait(timeout=20)
    except subprocess.TimeoutExpired:
        return None
    finally:
        stalled.kill()
        stalled.wait()


def start(*words):
    return subprocess.Popen([COMMAND, *map(str, words)], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                            stderr=subprocess.DEVNULL)


def wait_until_handled(process, number):
    """Waits until the process blocks the signal or has a handler for it."""
    def masks():
        for line in pathlib.Path(f"/proc/{process.pid}/status").read_text().splitlines():
            name, _, mask = line.partition(":")
            if name in ("SigBlk", "SigCgt"):
                yield int(mask, 16)

    while process.poll() is None and not any(mask >> (number - 1) & 1 for mask in masks()):
        time.sleep(0.01)


def wait_until_full(pipe):
    """Waits until nothing has been written into a pipe for a while."""
    before, now = None, 0
    while now == 0 or now != before:
        time.sleep(0.5)
        count = fcntl.ioctl(pipe, termios.FIONREAD, b"1234")
        before, now = now, int.from_bytes(count, sys.byteorder)


def check_readers_that_stall(folder):
    """Tests that signals end a command that waits for a reader."""
    code = 128 + signal.SIGTERM
    os.mkfifo(folder / "nobody.exr")
    render = ["render", SCENE, "--size", "1200x900", "--spp", "1", "--integrator", "pt"]
    stalled = start(*render, "-o", folder / "nobody.exr")
    wait_until_handled(stalled, signal.SIGTERM)
    time.sleep(0.5)
    yield "a named pipe that nobody reads", end_of(stalled, signal.SIGTERM, signal.SIGTERM) == code
    stalled = start(*render, "-o", "-")
    wait_until_full(stalled.stdout)
    yield "an image that nobody reads", end_of(stalled, signal.SIGTERM, signal.SIGHUP) == 128 + signal.SIGHUP
    for signals in ([signal.SIGTERM] * 2, [signal.SIGTERM, signal.SIGINT]):
        stalled = start("render", SCENE, *HOW[:4], "--integrator", "pt", "--orbit", "3000", "-o", folder / "s.####.png",
                        "--json")
        wait_until_full(stalled.stdout)
        yield f"events that nobody reads: {signals}", end_of(stalled, *signals) == 128 + signals[-1]


def check_files_called_so(folder):
    """Tests that a file of that name is not the standard input."""
    (folder / "-").write_bytes(pathlib.Path(SCENE).read_bytes())
    yield "a file called -", bdpt("render", "./-", *HOW, "-o", "b.exr", cwd=folder).returncode == 0
    scene = {"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4, "uri": "-"}], "scenes": [{}], "scene": 0}
    (folder / "odd.gltf").write_text(json.dumps(scene))
    (folder / "-").unlink()
    done = bdpt("render", "odd.gltf", *HOW, "-o", "c.exr", source=SCENE, cwd=folder)
    yield "a URI -", done.returncode == 3 and b"no such file" in done.stderr


with tempfile.TemporaryDirectory() as name:
    FOLDER = pathlib.Path(name)
    RESULTS = [result for check in (check_images, check_other_commands, check_refusals, check_readers_that_stall,
                                            check_files_called_so)
               for result in check(FOLDER)]
FAILED = [what for what, passed in RESULTS if not passed]
print("\n".join(f"failed: {what}" for what in FAILED) or f"{len(RESULTS)} checks passed")
sys.exit(1 if FAILED else 0)
