#!/usr/bin/env python3
"""Tests that a render on a disk that fills up keeps its part, leaves no half-written file, and reports the error:
full_disk_test.py COMMAND SCENE. Exits with 77 (skipped) where processes may not mount file systems in a namespace.

The disk is a tmpfs in a new namespace, in which this script runs itself again."""

import os
import pathlib
import signal
import subprocess
import sys
import tempfile

COMMAND, SCENE = sys.argv[1:3]
WORDS = [SCENE, "--size", "96x72", "--integrator", "bdpt", "--threads", "1"]
DISK = 2 << 20  # [bytes]; a part takes about a tenth of it
ISOLATED = ["unshare", "--user", "--map-root-user", "--mount"]


class Render:
    """Runs a render until it is stopped."""

    def __init__(self, part):
        words = [COMMAND, "render", *WORDS, "--spp", "2000000000", "--part", str(part), "--json"]
        self.process = subprocess.Popen(words, stdout=subprocess.PIPE, text=True)
        self.begun = self.wait_for('"progress"')  # a signal before the render begins would end it

    def wait_for(self, text):
        """Returns whether the text appears before many lines of progress."""
        patience = 60
        for line in self.process.stdout:
            patience -= '"progress"' in line
            if text in line or patience == 0:
                return text in line
        return False

    def checkpoint(self, outcome):
        """Requests a checkpoint; returns whether it has this outcome."""
        self.process.send_signal(signal.SIGUSR1)
        return self.wait_for(outcome)

    def stop(self):
        self.process.send_signal(signal.SIGTERM)
        self.process.communicate(timeout=120)
        return self.process.returncode


def fill(folder):
    """Fills the disk completely."""
    filler = folder / "filler"
    with filler.open("wb", buffering=0) as file:
        try:
            while True:
                file.write(bytes(4096))
        except OSError:
            return filler


def tests(folder):
    part = folder / "a.part.exr"
    names = lambda: {file.name for file in folder.iterdir()}

    render = Render(part)
    yield "there is a checkpoint while there is room", render.checkpoint('"event":"part"')
    before = part.read_bytes()
    filler = fill(folder)
    yield "a full disk is a warning, with what happens next", render.checkpoint("No space left on device; the render continues")
    yield "the checkpoint before it stays", part.read_bytes() == before
    yield "nothing half-written is left", names() == {"a.part.exr", "filler"}
    filler.unlink()
    yield "what was missed comes with the next one", render.checkpoint('"event":"part"')
    before = part.read_bytes()
    filler = fill(folder)
    yield "a disk that is full again is told of again", render.checkpoint("No space left on device; the render continues")
    filler.unlink()
    yield "what was missed is no error when the last write succeeds", render.stop() == 143
    yield "and it has more samples", part.read_bytes() != before

    render = Render(part)
    yield "it goes on", render.begun
    before = part.read_bytes()
    fill(folder)
    yield "a last write that fails is exit code 6", render.stop() == 6
    yield "the checkpoint stays then, too", part.read_bytes() == before
    yield "still nothing half-written", names() == {"a.part.exr", "filler"}

    filler.unlink()
    image = folder / "now.exr"
    subprocess.run([COMMAND, "merge", str(part), "-o", str(image), "--partial", "--quiet"], check=True)
    fill(folder)
    old = image.read_bytes()
    done = subprocess.run([COMMAND, "merge", str(part), "-o", str(image), "--partial", "--quiet"], check=False,
                          capture_output=True, text=True)
    yield "merge has no room: exit code 6, one line", done.returncode == 6 and done.stderr.count("\n") == 1
    yield "and the image before it stays", image.read_bytes() == old
    yield "with nothing beside it", names() == {"a.part.exr", "filler", "now.exr"}


def inside(folder):
    subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={DISK}", "tmpfs", folder], check=True)
    failed = 0
    for what, good in tests(folder):
        failed += not good
        print(f"{'ok  ' if good else 'FAIL'} {what}", flush=True)
    sys.exit(failed > 0)


def main():
    if len(sys.argv) > 3:
        inside(pathlib.Path(sys.argv[3]))
    with tempfile.TemporaryDirectory() as folder:
        permitted = subprocess.run([*ISOLATED, "mount", "-t", "tmpfs", "tmpfs", folder], capture_output=True, check=False)
        if permitted.returncode != 0:
            print(f"skipped: no mounts here: {permitted.stderr.decode().strip()}")
            sys.exit(77)
        again = [*ISOLATED, sys.executable, os.path.abspath(__file__), COMMAND, SCENE, folder]
        sys.exit(subprocess.run(again, check=False).returncode)


if __name__ == "__main__":
    main()
