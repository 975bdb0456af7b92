"""Renders one image with one peer: worker.py ADAPTER JOB.json, run by the interpreter that has the peer.

The job has `scene` (a file of scene.to_json), `integrator`, `width`, `height`, `max_depth` (edges), `threads`, `seed`,
`seconds` or `samples` (per pixel) as the limit, `output` (an EXR file), `result` (a JSON file) and arguments of the
adapter (`variant`, `roulette`). The result has `version`, `settings` and, for rendering without loading, `seconds`,
`cpu_seconds` and `samples`."""

import importlib
import json
import os
import pathlib
import sys
import time

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import scene


class Stopwatch:
    """Measures wall-clock and CPU seconds since its creation."""

    def __init__(self):
        self.wall, self.cpu = time.perf_counter(), self.cpu_now()

    @staticmethod
    def cpu_now():
        times = os.times()
        return times.user + times.system

    def seconds(self):
        return time.perf_counter() - self.wall

    def cpu_seconds(self):
        return self.cpu_now() - self.cpu


def main():
    adapter, job_file = sys.argv[-2:]
    job = json.loads(pathlib.Path(job_file).read_text(encoding="utf-8"))
    described = scene.from_json(pathlib.Path(job["scene"]).read_text(encoding="utf-8"))
    result = importlib.import_module(adapter).render(described, job)
    pathlib.Path(job["result"]).write_text(json.dumps(result), encoding="utf-8")
    sys.stdout.flush()
    os._exit(0)  # the result is written, and LuxCore crashes at exit


if __name__ == "__main__":
    main()
