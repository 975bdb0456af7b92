#!/usr/bin/env python3
"""Runs a Slurm plan on a real Slurm, on one machine in a scratch folder, provokes failures, and prints the results:
slurm_trial.py BDPT SCENE, as root.

Needs munged, slurmctld and slurmd (Debian: slurm-wlm, munge), none of which may be running; needs no systemd and no
control groups. Takes about ten minutes, most of them the two that Slurm waits before it restarts a job. The exit code
is 1 if the outcome differs from docs/farm.md."""

import argparse
import json
import os
import pathlib
import re
import secrets
import signal
import socket
import subprocess
import sys
import tempfile
import time

CONFIGURATION = """ClusterName=trial
SlurmctldHost={host}
SlurmUser=root
SlurmdUser=root
SlurmctldPort=16817
SlurmdPort=16818
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
ReturnToService=2
SlurmdTimeout=15
KillWait=8
MinJobAge=3600
NodeName={host} CPUs=4 State=UNKNOWN
PartitionName=trial Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


class Cluster:
    """Starts and stops the three daemons."""

    def __init__(self, folder):
        self.folder = folder
        for name in ("state", "spool"):
            (folder / name).mkdir()
        key = folder / "munge.key"
        key.write_bytes(secrets.token_bytes(128))
        key.chmod(0o400)
        self.configuration = folder / "slurm.conf"
        self.configuration.write_text(CONFIGURATION.format(host=socket.gethostname().split(".")[0], folder=folder))
        os.environ["SLURM_CONF"] = str(self.configuration)
        self.daemons = {}
        self.start("munged", "--foreground", "--force", f"--key-file={key}", f"--socket={folder}/munge.socket",
                   f"--pid-file={folder}/munged.pid", f"--log-file={folder}/munged.log",
                   f"--seed-file={folder}/munged.seed")
        time.sleep(2)
        self.start("slurmctld", "-D", "-f", str(self.configuration))
        self.start_node()
        for _ in range(60):
            if "idle" in run("sinfo", "-h", "-o", "%T"):
                return
            time.sleep(1)
        raise RuntimeError("no idle node: " + (folder / "slurmctld.log").read_text()[-2000:])

    def start(self, name, *words):
        log = (self.folder / f"{name}.out").open("a")
        self.daemons[name] = subprocess.Popen([name, *words], stdout=log, stderr=log, start_new_session=True)

    def start_node(self):
        self.start("slurmd", "-D", "-f", str(self.configuration))

    def kill_node(self):
        """Simulates a power cut: kills slurmd, its job helpers (slurmstepd) and all their children."""
        mine = [process for process in processes() if "slurmstepd: [" in process.command]
        self.daemons["slurmd"].kill()
        for process in mine + [child for parent in mine for child in find_descendants(parent.number)]:
            send(process.number, signal.SIGKILL)
        self.daemons["slurmd"].wait()

    def stop(self):
        for daemon in reversed(self.daemons.values()):
            daemon.terminate()
            daemon.wait()


class Process:
    def __init__(self, folder):
        self.number = int(folder.name)
        self.command = (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
        self.parent = int(re.search(r"PPid:\s+(\d+)", (folder / "status").read_text())[1])


def processes():
    found = []
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            found.append(Process(folder))
        except OSError:
            pass
    return found


def find_descendants(number):
    children = [process for process in processes() if process.parent == number]
    return children + [other for child in children for other in find_descendants(child.number)]


def send(number, which):
    try:
        os.kill(number, which)
    except ProcessLookupError:
        pass


def run(*words):
    return subprocess.run([*map(str, words)], check=True, capture_output=True, text=True).stdout.strip()


class Trial:
    def __init__(self, options, folder):
        self.options, self.folder = options, folder
        self.start, self.shown, self.failed = time.monotonic(), {}, False

    def say(self, text):
        print(f"{time.monotonic() - self.start:5.0f} s  {text}", flush=True)

    def expect(self, what, good):
        self.failed |= not good
        self.say(f"{'ok' if good else 'NOT AS EXPECTED'}: {what}")

    def words(self):
        return [self.options.scene, "--size", "96x72", "--spp", self.options.spp, "--integrator", "bdpt"]

    def submit(self, name, *options):
        """Plans a render of its own and submits it; returns the ids of the task array and of the merge job."""
        job = self.folder / name
        run(self.options.bdpt, "plan", *self.words(), "--parts", 4, "--for", "slurm", "-d", job, "-o",
            self.folder / f"{name}.exr", "--quiet")
        os.environ["BDPT"] = str(self.options.bdpt)
        said = run(job / "submit.sh", *options)
        self.say(said)
        return re.findall(r"job (\d+)", said)

    def states(self, *jobs):
        """Returns the states of jobs and tasks; prints changes."""
        lines = run("squeue", "-h", "-a", "-r", "-t", "all", "-j", ",".join(jobs), "-o", "%F_%K %T %r").splitlines()
        now = {line.split(" ", 1)[0].replace("_N/A", ""): line.split(" ", 1)[1] for line in lines}
        for name, state in sorted(now.items()):
            if self.shown.get(name) != state:
                self.say(f"job {name}: {state}")
        self.shown.update(now)
        return now

    def wait(self, seconds, until, *jobs):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            states = self.states(*jobs)
            if until(states):
                return states
            time.sleep(1)
        self.expect(f"waited {seconds} s for nothing", False)
        return self.states(*jobs)

    def find_render(self, name, task):
        found = [p for p in processes() if f"--task {task} " in p.command and p.command.startswith(str(self.options.bdpt))]
        cwd = [p for p in found if pathlib.Path(f"/proc/{p.number}/cwd").resolve() == self.folder / name]
        return cwd[0].number if cwd else None


def running(job, tasks):
    return lambda states: all(states.get(f"{job}_{task}", "").startswith("RUNNING") for task in tasks)


def try_cancel(trial):
    job, merge = trial.submit("cancelled", "--time=10")
    trial.wait(60, running(job, range(4)), job)
    time.sleep(6)
    run("scancel", job)
    trial.wait(60, lambda states: all("CANCELLED" in state for state in states.values()), job)
    time.sleep(5)
    parts = list((trial.folder / "cancelled").glob("*.part.exr"))
    trial.expect(f"scancel: {len(parts)} of 4 tasks have kept their parts", len(parts) == 4)
    ended = trial.wait(90, lambda states: states.get(merge, "PENDING").split()[0] in ("COMPLETED", "FAILED"), merge)
    log = (trial.folder / "cancelled/merge.log").read_text()
    trial.expect("the merge ran all the same, and named the tasks", "FAILED" in ended[merge] and "tasks 0-3" in log)


def try_mishaps(trial, cluster):
    """Tests a killed render, the time limit, and a node that dies, in one job."""
    # Slurm warns up to a minute early: 30 to 90 s after the start.
    job, merge = trial.submit("mishaps", "--time=3", "--signal=B:USR1@90")
    trial.wait(60, running(job, range(4)), job)
    time.sleep(5)
    trial.say("kill -9 of the render of task 1")
    send(trial.find_render("mishaps", 1), signal.SIGKILL)
    states = trial.wait(150, lambda states: not any("RUNNING" in s or "COMPLETING" in s for s in states.values()), job)
    again = [name for name, state in states.items() if state.startswith("PENDING")]
    trial.expect(f"queued again: {len(again)} tasks, 1 after the kill, others at their time limit", f"{job}_1" in again)
    trial.wait(240, lambda states: any("RUNNING" in state for state in states.values()), job)
    time.sleep(5)
    trial.say("the node dies")
    cluster.kill_node()
    time.sleep(25)
    trial.states(job)
    cluster.start_node()
    states = trial.wait(900, lambda states: merge in states and states[merge].split()[0] in ("COMPLETED", "FAILED"), job,
                        merge)
    trial.expect("all tasks are done", all(state.startswith("COMPLETED") for state in states.values()))
    whole = trial.folder / "whole.exr"
    run(trial.options.bdpt, "render", *trial.words(), "-o", whole, "--quiet")
    result = json.loads(run(trial.options.bdpt, "compare", trial.folder / "mishaps.exr", whole, "--json"))
    trial.expect("the pixels are those of one render", result["metrics"]["mse"]["mean"] == 0)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("bdpt", type=pathlib.Path)
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("--spp", type=int, default=12288, help="so many that a task takes about two minutes")
    options = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))  # ends the daemons, too
    options.bdpt, options.scene = options.bdpt.resolve(), options.scene.resolve()
    with tempfile.TemporaryDirectory(prefix="bdpt-slurm-", dir="/var/tmp") as name:
        trial = Trial(options, pathlib.Path(name))
        cluster = Cluster(pathlib.Path(name))
        try:
            trial.say(run("sinfo", "--version"))
            try_cancel(trial)
            try_mishaps(trial, cluster)
        finally:
            cluster.stop()
    sys.exit(trial.failed)


if __name__ == "__main__":
    main()
