#!/usr/bin/env python3
"""Tests that the scripts of a Slurm plan handle signals and failures as docs/farm.md says, with programs in place of
Slurm's that log their calls: plan_slurm_test.py COMMAND SCENE."""

import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

COMMAND, SCENE = sys.argv[1:3]
ENDLESS = 2_000_000_000


class Job:
    """A Slurm plan in a scratch folder, of two tasks that run very long or very short."""

    def __init__(self, folder, samples):
        self.folder = folder
        self.calls = folder / "calls"
        self.job = folder / "a job"
        tools = folder / "tools"
        tools.mkdir()
        for name in ("sbatch", "scontrol"):
            (tools / name).write_text(f'#!/bin/sh\necho "{name} $*" >> "{self.calls}"\necho "17;cluster"\n')
            (tools / name).chmod(0o755)
        subprocess.run([COMMAND, "plan", SCENE, "--size", "32x24", "--spp", str(samples), "--parts", "2", "--for",
                        "slurm", "-o", folder / "out.exr", "-d", self.job, "--quiet"], check=True)
        self.environment = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}", "BDPT": COMMAND,
                            "SLURM_ARRAY_JOB_ID": "17", "SLURM_ARRAY_TASK_ID": "1", "SLURM_CPUS_PER_TASK": "1"}

    def start(self, restarts=0):
        environment = {**self.environment, "SLURM_RESTART_COUNT": str(restarts)}
        return subprocess.Popen(["bash", "tasks.sbatch"], cwd=self.job, env=environment, stderr=subprocess.PIPE)

    def seen(self):
        lines = self.calls.read_text().splitlines() if self.calls.exists() else []
        self.calls.unlink(missing_ok=True)
        return lines


def find_render_pid(process):
    """Returns the pid of the render that a script has started, after the script has set its signal handlers."""
    for _ in range(200):
        for folder in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                status = (folder / "status").read_text()
                words = (folder / "cmdline").read_bytes()
            except OSError:
                continue
            if f"PPid:\t{process.pid}\n" in status and b"--task" in words:
                time.sleep(1.0)  # gives the render something to save
                return int(folder.name)
        time.sleep(0.05)
    raise RuntimeError("no render was started")


def run_with(job, number, to_render=False, restarts=0):
    """Sends a signal to a task; returns its exit code and its calls of Slurm."""
    script = job.start(restarts)
    render = find_render_pid(script)
    os.kill(render if to_render else script.pid, number)
    if number == signal.SIGTERM:
        time.sleep(0.01)
        os.kill(script.pid, number)  # preemption sends it twice
    script.communicate(timeout=60)
    try:
        os.kill(render, 0)
        return "the render lives on", job.seen()
    except ProcessLookupError:
        return script.returncode, job.seen()


def main():
    again = ["scontrol requeue 17_1"]
    checks = []

    def check(what, result, expected):
        checks.append(result == expected)
        print(f"{'ok  ' if checks[-1] else 'FAIL'} {what}: {result}" + ("" if checks[-1] else f", not {expected}"))

    with tempfile.TemporaryDirectory() as name:
        job = Job(pathlib.Path(name), ENDLESS)
        part = job.job / "task-1.part.exr"
        check("the time limit", run_with(job, signal.SIGUSR1), (143, again))
        check("its part is there", part.exists(), True)
        check("the time limit, without end", run_with(job, signal.SIGUSR1, restarts=1000), (143, []))
        check("scancel and preemption", run_with(job, signal.SIGTERM), (143, []))
        check("a killed render", run_with(job, signal.SIGKILL, to_render=True), (137, again))
        check("one that was killed before", run_with(job, signal.SIGKILL, to_render=True, restarts=3), (137, []))
        subprocess.run(["./submit.sh", "--time=5", "--array=1"], cwd="/", env=job.environment, check=False,
                       executable=job.job / "submit.sh", stdout=subprocess.DEVNULL)
        check("submit.sh", job.seen(), ["sbatch --parsable --time=5 --array=1 tasks.sbatch",
                                        "sbatch --parsable --dependency=afterany:17 merge.sbatch"])
        job.environment["SLURM_ARRAY_TASK_ID"] = "2"
        script = job.start()
        check("what a task refuses is its exit code", (script.wait(), job.seen()), (2, []))

    with tempfile.TemporaryDirectory() as name:
        job = Job(pathlib.Path(name), 4)
        check("a task that is done", (job.start().wait(), job.seen()), (0, []))
        merge = subprocess.run(["bash", "merge.sbatch"], cwd=job.job, env=job.environment, capture_output=True, text=True,
                               check=False)
        check("a merge that lacks one", (merge.returncode, "(tasks 0 of plan.json)" in merge.stderr), (12, True))
    sys.exit(not all(checks))


if __name__ == "__main__":
    main()
