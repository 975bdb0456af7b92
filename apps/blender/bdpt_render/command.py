"""The command bdpt, at work in a process of its own."""

import json
import queue
import subprocess
import threading


class Command:
    """bdpt render with those words. `ended()` takes note of what it has said since."""

    def __init__(self, program, words):
        self.fraction, self.warnings, self.error, self.done = 0.0, [], None, None
        self._lines = queue.Queue()
        self._closed = threading.Event()
        try:
            self._process = subprocess.Popen([program, "render", *words, "--json"], stdout=subprocess.PIPE,
                                             stderr=subprocess.STDOUT, text=True)
        except OSError as error:
            self._process, self.error = None, f"{program}: {error.strerror}: see the preferences of the add-on"
            return
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self):
        for line in self._process.stdout:
            self._lines.put(line)
        self._closed.set()

    def ended(self):
        if self._process is None:
            return True
        ended = self._closed.is_set() and self._process.poll() is not None
        while not self._lines.empty():
            self._take(self._lines.get())
        if ended and self._process.returncode not in (0, 130, 143) and not self.error:
            self.error = f"bdpt ended with exit code {self._process.returncode}"
        return ended

    def _take(self, line):
        try:
            event = json.loads(line)
        except ValueError:
            self.warnings.append(line.strip())
            return
        if event["event"] == "progress" and event.get("samples_total"):
            self.fraction = event["samples"] / event["samples_total"]
        elif event["event"] == "warning":
            self.warnings.append(event["message"])
        elif event["event"] == "error":
            self.error = event["message"]
        elif event["event"] == "done":
            self.done = {"samples": event["samples"], "seconds": event["seconds"]}

    def wait(self, seconds):
        if self._process is not None:
            self._closed.wait(seconds)

    def stop(self):
        """After the pass in flight."""
        if self._process is not None:
            self._process.terminate()
