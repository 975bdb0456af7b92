"""Runs the command bdpt in a process of its own."""

import contextlib
import json
import queue
import re
import shlex
import shutil
import subprocess
import sysconfig
import tempfile
import threading

STOPPED = (0, 130, 143)  # exit codes after which the image has been written


def program(chosen):
    """Returns the path of the command: the chosen one, else that in PATH, else that of the Python environment."""
    if chosen:
        return chosen
    found = shutil.which("bdpt")
    return found or shutil.which("bdpt", path=sysconfig.get_path("scripts"))


def write_job(file, scene, words):
    """Writes `words`, options of `bdpt render` as typed, as a job that renders `scene`; later ones come first.

    The words may be a stranger's: bdpt refuses jobs that load code, connect to machines, or write elsewhere.
    """
    job, key = {}, None
    for word in words:
        if word.startswith("--"):
            name, has_value, value = word[2:].partition("=")
            key = name.replace("-", "_")
            job[key] = parse_value(value) if has_value else True
        elif key is not None and job[key] is True:
            job[key] = parse_value(word)
        else:
            raise RuntimeError(f"Options: {word}: expected --NAME or --NAME VALUE")
    file.write_text(json.dumps({**job, "bdpt_job": 1, "file": str(scene)}))


def parse_value(text):
    """Returns a number of JSON, or the text."""
    return json.loads(text) if re.fullmatch(r"-?(0|[1-9]\d*)(\.\d+)?([eE][+-]?\d+)?", text) else text


def split_options(text):
    """Splits a line as a shell does."""
    try:
        return shlex.split(text)
    except ValueError as error:
        raise RuntimeError(f"Options: {error}: {text}") from None


class Command:
    """Runs `bdpt render` with the given words. `ended()` also processes the events printed since the last call."""

    def __init__(self, path, words):
        self.fraction, self.samples, self.noise = 0.0, 0, None
        self.warnings, self.error, self.done = [], None, None
        self._lines = queue.Queue()
        self._process, self._texts = None, tempfile.TemporaryFile("w+")
        if not path:
            self.error = "the command bdpt is not found; set its path in Preferences > Add-ons > bdpt"
            return
        try:
            self._process = subprocess.Popen([path, "render", *words, "--json"], stdout=subprocess.PIPE,
                                             stderr=self._texts, text=True)
        except OSError as error:
            self.error = f"{path}: {error.strerror}; set the path of bdpt in Preferences > Add-ons > bdpt"
            return
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        for line in self._process.stdout:
            self._lines.put(line)

    def ended(self):
        if self._process is None:
            return True
        ended = self._process.poll() is not None
        if ended:
            self._reader.join()
        while not self._lines.empty():
            self._take(self._lines.get())
        if ended and self._process.returncode not in STOPPED and not self.error:
            self._texts.seek(0)
            said = self._texts.read().strip().rpartition("\n")[2]
            self.error = said or f"bdpt ended with exit code {self._process.returncode}"
        return ended

    def _take(self, line):
        event = json.loads(line)
        if event["event"] == "progress":
            self.fraction, self.samples = event.get("fraction") or 0.0, event["samples"]
        elif event["event"] == "warning":
            self.warnings.append(event["message"])
        elif event["event"] == "error":
            self.error = event["message"]
        elif event["event"] == "done":
            self.samples, self.done = event["samples"], event

    def sentence(self):
        """Describes a render that succeeded."""
        noise = self.done.get("noise")
        left = f", noise {100 * noise:.2g} %" if noise is not None else ""
        return f"bdpt rendered {self.samples} samples per pixel in {self.done['seconds']:.1f} s{left}"

    def wait(self, seconds):
        """Waits until the command ends, for at most that many seconds."""
        if self._process is not None:
            with contextlib.suppress(subprocess.TimeoutExpired):
                self._process.wait(seconds)

    def stop(self):
        """Interrupts the command, which writes its image after the pass in flight."""
        if self._process is not None:
            self._process.terminate()

    def kill(self):
        if self._process is not None and self._process.poll() is None:
            self._process.kill()
            self._process.wait()
