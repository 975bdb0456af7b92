#!/usr/bin/env python3
"""Tests that no output replaces a special file: special_files_test.py COMMAND SCENE.

Each output of each command names devices, pipes, sockets, folders and links. They keep their type, and receive the
bytes or are refused with exit code 6. Root creates devices for the test; it never names those of the system, which a
defect could replace.
"""

import os
import pathlib
import socket
import stat
import subprocess
import sys
import tempfile
import threading
import time

COMMAND, SCENE = sys.argv[1:3]
HOW = ["--size", "16x12", "--spp", "2", "--integrator", "bdpt", "--max-depth", "3", "--quiet"]
ROOT = os.geteuid() == 0
PATIENCE = 120  # [s]


def bdpt(*words, cwd):
    return subprocess.run([COMMAND, *map(str, words)], stdin=subprocess.DEVNULL, capture_output=True, check=False,
                          cwd=cwd, timeout=PATIENCE)


def render(*words):
    return ["render", SCENE, *HOW, *words]


# Maps the name of an output to the command that writes it; a.exr, b.exr and p.part.exr exist.
OUTPUTS = {
    "out.exr": render("-o", "out.exr"),
    "out.png": render("-o", "out.png"),
    "stats.json": render("-o", "beside.exr", "--stats", "stats.json"),
    "strategies.exr": render("-o", "beside.exr", "--strategies", "strategies.exr"),
    "strategies.png": render("-o", "beside.exr", "--strategies", "strategies.exr"),
    "rates.exr": render("-o", "beside.exr", "--spp", "16", "--adaptive", "--save-rates", "rates.exr"),
    "rates.png": render("-o", "beside.exr", "--spp", "16", "--adaptive", "--save-rates", "rates.png"),
    "kept.part.exr": render("--part", "kept.part.exr"),
    "anew.part.exr": render("--part", "anew.part.exr", "--restart"),
    "turn.01.exr": render("--orbit", "2", "--frames", "1:1", "-o", "turn.##.exr"),
    "merged.exr": ["merge", "p.part.exr", "-o", "merged.exr", "--quiet"],
    "merged.png": ["merge", "p.part.exr", "-o", "merged.png", "--quiet"],
    "merged.part.exr": ["merge", "p.part.exr", "-o", "merged.part.exr", "--quiet"],
    "error.png": ["compare", "a.exr", "b.exr", "--error-image", "error.png", "--quiet"],
    "directions.exr": ["inspect", SCENE, "--pixel", "8,6", "--size", "16x12", "-o", "directions.exr"],
    "directions.png": ["inspect", SCENE, "--pixel", "8,6", "--size", "16x12", "-o", "directions.png"],
    "job/plan.json": ["plan", SCENE, *HOW, "-o", "planned.exr", "--parts", "2", "--for", "make", "-d", "job", "--restart"],
    "job/Makefile": ["plan", SCENE, *HOW, "-o", "planned.exr", "--parts", "2", "--for", "make", "-d", "job", "--restart"],
}
PARTS = {"kept.part.exr", "anew.part.exr"}  # the command reads these back


def make_device(path):
    os.mknod(path, 0o666 | stat.S_IFCHR, os.makedev(1, 3))


def make_link(path):
    """Makes a link to a device that may be lost."""
    if ROOT:
        make_device(path.parent / "null")
    path.symlink_to("null" if ROOT else "/dev/null")


def make_disk(path):
    os.mknod(path, 0o666 | stat.S_IFBLK, os.makedev(7, 99))


def make_socket(path):
    # Binds a relative name, because addresses of sockets are short.
    here = os.getcwd()
    os.chdir(path.parent)
    socket.socket(socket.AF_UNIX).bind(path.name)
    os.chdir(here)


KINDS = {
    "link to a device": make_link,
    "folder": lambda path: path.mkdir(),
    "pipe": os.mkfifo,
    "socket": make_socket,
    "links in a circle": lambda path: path.symlink_to(path.name),
    "dangling link": lambda path: path.symlink_to("aim"),
} | ({"device": make_device, "disk": make_disk} if ROOT else {})
WRITTEN = {"link to a device", "pipe", "device", "dangling link"}  # all other kinds are refused


def read_status(path):
    status = path.lstat()
    return stat.S_IFMT(status.st_mode), status.st_ino, status.st_rdev, status.st_mode


class Reader:
    """Reads a pipe. Opens it at once, so that writers do not block."""

    def __init__(self, path):
        self.pipe = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
        self.bytes = b""
        self.ended = threading.Event()
        self.thread = threading.Thread(target=self.read)
        self.thread.start()

    def read(self):
        while True:
            last = self.ended.is_set()
            try:
                block = os.read(self.pipe, 65536)
            except BlockingIOError:
                block = b""
            self.bytes += block
            if last and not block:
                return
            if not block:
                time.sleep(0.01)

    def end(self):
        self.ended.set()
        self.thread.join()
        os.close(self.pipe)
        return self.bytes


def try_output(folder, kind, output, words):
    """Returns an error message, or None."""
    path = folder / output
    path.parent.mkdir(exist_ok=True)
    KINDS[kind](path)
    before = read_status(path)
    reader = Reader(path) if kind == "pipe" and output not in PARTS else None
    done = bdpt(*words, cwd=folder)
    bytes_read = reader.end() if reader else None
    if not path.exists() and not path.is_symlink():
        return "is gone"
    if read_status(path) != before:
        return f"was {before}, is {read_status(path)}"
    message = done.stderr.decode()
    if kind in WRITTEN and not (output in PARTS and kind != "dangling link"):
        if done.returncode != 0:
            return f"exit code {done.returncode}: {message}"
        if kind == "pipe" and len(bytes_read) < 100:
            return f"read {len(bytes_read)} bytes"
        if kind == "dangling link" and (path.parent / "aim").stat().st_size < 100:
            return "nothing at the end of the link"
        return None
    if done.returncode != 6 or "cannot write" not in message or message.count("\n") != 1:
        return f"exit code {done.returncode}, not 6: {message}"
    return None


def check_outputs(results):
    for kind in KINDS:
        for output, words in OUTPUTS.items():
            if output.startswith("job/") and kind != "device":
                continue  # plans are read back, and their links are refused
            with tempfile.TemporaryDirectory() as name:
                folder = pathlib.Path(name)
                for file in ("a.exr", "b.exr", "p.part.exr"):
                    (folder / file).write_bytes((READY / file).read_bytes())
                results.append((f"{kind}, {output}", try_output(folder, kind, output, words)))


def check_bench(results):
    """Tests a benchmark whose tables are devices."""
    for name in ("bench.json", "bench.csv", "report.html"):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / name
            make_link(path)
            done = bdpt("bench", SCENE, "-o", folder, *BENCH_WORDS, cwd=folder)
            kept = path.is_symlink() and done.returncode == 0
            results.append((f"bench, {name}", None if kept else f"{done.returncode}: {done.stderr.decode()}"))


BENCH_WORDS = ["--integrators", "mis", "--time", "0.1s", "--reference-time", "0.1s", "--size", "8x6", "--quiet"]

with tempfile.TemporaryDirectory() as ready:
    READY = pathlib.Path(ready)
    for index, image in enumerate(("a.exr", "b.exr")):
        bdpt(*render("-o", image, "--seed", index), cwd=READY)
    bdpt(*render("--part", "p.part.exr"), cwd=READY)
    assert {file.name for file in READY.iterdir()} == {"a.exr", "b.exr", "p.part.exr"}
    RESULTS = []
    check_outputs(RESULTS)
    check_bench(RESULTS)
    # Tests names of the standard output, but not /dev/stdout itself, which root could lose.
    (READY / "stdout").symlink_to("/proc/self/fd/1")
    for stdout in ("stdout", "/dev/fd/1", "/proc/self/fd/1"):
        done = bdpt(*render("-o", "x.exr", "--stats", stdout), cwd=READY)
        good = done.returncode == 0 and b'"samples": 2' in done.stdout
        RESULTS.append((stdout, None if good else f"{done.returncode}: {done.stderr.decode()}"))
        log = READY / "log"
        with log.open("wb") as stream:
            stream.write(b"before\n")
            stream.flush()
            subprocess.run([COMMAND, *render("-o", "x.exr", "--stats", stdout)], stdout=stream, check=False, cwd=READY)
            stream.seek(0, os.SEEK_END)
            stream.write(b"after\n")
        text = log.read_text()
        good = text.startswith("before\n") and text.endswith("after\n") and '"samples"' in text
        RESULTS.append((f"{stdout} in a file", None if good else text))
FAILED = [(what, fault) for what, fault in RESULTS if fault]
print("\n".join(f"failed: {what}: {fault}" for what, fault in FAILED) or f"{len(RESULTS)} checks passed"
      + ("" if ROOT else "; skipped: devices, which only root makes"))
sys.exit(1 if FAILED else 0)
