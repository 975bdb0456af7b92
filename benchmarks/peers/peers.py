"""Lists the renderers of the comparison, and finds and runs them."""

import dataclasses
import glob
import json
import os
import pathlib
import re
import shutil
import subprocess

from scene import Camera, Material, Mesh, PointLight, Scene, to_json

HERE = pathlib.Path(__file__).resolve().parent
PROBE_SECONDS = 120  # a start takes seconds; compiling is slow on busy machines
RENDER_GRACE = 600  # [s] for loading and compiling, in addition to rendering
SMOOTH = {"metal", "glass"}
MEDIA = frozenset({"media"})


class Unavailable(Exception):
    """Raised when a peer is not installed or does not work; the reason is one line."""


@dataclasses.dataclass(frozen=True)
class Entry:
    """Describes one way to render. `job` has the adapter's arguments besides the common ones."""

    name: str
    peer: str  # key of PEERS, or "bdpt"
    job: dict
    cannot_show: frozenset = frozenset()  # surface kinds that it cannot show, and "media"
    is_for: frozenset = frozenset()  # needs a scene with one of these kinds; otherwise another entry does the same
    note: str = ""

    def unsupported_kinds(self, scene):
        """Returns why it cannot show a scene; empty if it can."""
        return ", ".join(sorted(self.cannot_show & scene.kinds()))

    def lacks(self, scene):
        """Returns what a scene lacks to be worth rendering with this entry; empty if nothing."""
        return "" if not self.is_for or self.is_for & scene.kinds() else ", ".join(sorted(self.is_for))


ENTRIES = (
    Entry("bdpt", "bdpt", {"integrator": "bdpt"}),
    Entry("bdpt-auto", "bdpt", {"integrator": "auto"}, note="which chooses path tracing, or its light paths and connections"),
    Entry("bdpt-mis", "bdpt", {"integrator": "mis"}, note="our path tracer"),
    Entry("mitsuba-path", "mitsuba", {"integrator": "path"}, MEDIA),
    Entry("mitsuba-volpath", "mitsuba", {"integrator": "volpath"}, is_for=MEDIA, note="path tracing in media"),
    Entry("mitsuba-volpathmis", "mitsuba", {"integrator": "volpathmis"}, is_for=MEDIA,
          note="the same with weights over colours"),
    Entry("mitsuba-ptracer", "mitsuba", {"integrator": "ptracer"}, MEDIA | SMOOTH,
          note="light tracing: through a pinhole it does not show smooth metal and glass"),
    Entry("luxcore-pathcpu", "luxcore", {"integrator": "PATHCPU", "roulette": False}, MEDIA, note="without Russian roulette"),
    Entry("luxcore-bidircpu", "luxcore", {"integrator": "BIDIRCPU", "roulette": False}, MEDIA,
          note="without Russian roulette; no limit of the whole path"),
    Entry("luxcore-bidircpu-rr", "luxcore", {"integrator": "BIDIRCPU", "roulette": True}, MEDIA,
          note="as it is by default: its Russian roulette is biased"),
    Entry("cycles", "cycles", {"integrator": "path"}, MEDIA),
)
PEERS = {"mitsuba": "mitsuba_peer", "luxcore": "luxcore_peer", "cycles": "cycles_peer"}  # -> adapter


def llvm_libraries():
    """Returns the LLVM libraries that Mitsuba may compile with, newest first."""
    given = os.environ.get("DRJIT_LIBLLVM_PATH")
    found = [given] if given else glob.glob("/usr/lib/*/libLLVM*.so*") + glob.glob("/usr/lib/llvm-*/lib/libLLVM*.so*")
    versions = {}
    for file in found:
        numbers = re.findall(r"\d+", file.rpartition("libLLVM")[2])
        if numbers or given:
            versions.setdefault(int(numbers[0]) if numbers else 0, file)
    return [versions[version] for version in sorted(versions, reverse=True)]


def candidates(peer):
    """Returns (job arguments, environment) of each way to run a peer, fastest first."""
    if peer != "mitsuba":
        return [({}, {})]
    return [({"variant": "llvm_ad_rgb"}, {"DRJIT_LIBLLVM_PATH": file}) for file in llvm_libraries()] + \
        [({"variant": "scalar_rgb"}, {})]


def probe_scene():
    """Returns a few triangles with a surface of each kind: a peer that renders it can compile every scene."""
    materials = (Material("lamp", "diffuse", emission=(1.0, 1.0, 1.0)), Material("mirror", "metal"),
                 Material("rough metal", "metal", alpha=0.1), Material("glass", "glass"),
                 Material("rough glass", "glass", alpha=0.1))
    corners = ((-1.0, -1.0), (1.0, -1.0), (0.0, 1.0))
    meshes = tuple(Mesh(material.name, i, tuple((x + i - 2.0, y, 0.1 * i) for x, y in corners), ((0, 1, 2),))
                   for i, material in enumerate(materials))
    return Scene("probe", materials, meshes, (PointLight("point", (0.0, 0.0, 2.0), (1.0, 1.0, 1.0)),),
                 Camera((0.0, 0.0, 4.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 1.0, 1.0), ())


def find_failure_reason(done):
    """Returns one line about why a process failed."""
    if done.returncode < 0:
        return f"it ended by signal {-done.returncode}"
    lines = [line.strip() for line in (done.stderr + done.stdout).splitlines()]
    errors = [line for line in lines if re.match(r"[\w.]*(Error|Exception)\b.*", line)]
    return (errors or [line for line in lines if line] or [f"exit code {done.returncode}"])[-1][:200]


@dataclasses.dataclass(frozen=True)
class Peer:
    """A renderer that works."""

    name: str
    command: tuple  # the adapter's name and the job file are appended
    job: dict
    environment: dict
    version: str = ""

    def render(self, job, folder, seconds):
        """Renders one image; returns the adapter's result. Raises Unavailable."""
        job_file, result = folder / "job.json", folder / "result.json"
        result.unlink(missing_ok=True)
        job_file.write_text(json.dumps({**job, **self.job, "result": str(result)}), encoding="utf-8")
        try:
            done = subprocess.run([*self.command, PEERS[self.name], str(job_file)], capture_output=True, text=True,
                                  errors="replace", env={**os.environ, **self.environment}, timeout=seconds,
                                  check=False)
        except OSError as error:
            raise Unavailable(f"{self.command[0]}: {error.strerror}") from error
        except subprocess.TimeoutExpired as error:
            raise Unavailable(f"it did not end within {seconds:.0f} s") from error
        if done.returncode or not result.exists():
            raise Unavailable(find_failure_reason(done))
        return json.loads(result.read_text(encoding="utf-8"))


def commands(python, blender):
    """Returns the command lines that run the adapters of each peer."""
    worker = str(HERE / "worker.py")
    in_blender = (blender, "--background", "--factory-startup", "--python-exit-code", "3", "--python", worker, "--")
    return {"mitsuba": (python, worker), "luxcore": (python, worker), "cycles": in_blender}


def find(name, command, folder):
    """Returns the peer after a test render. Raises Unavailable with the reason if it fails."""
    if shutil.which(command[0]) is None:
        raise Unavailable(f"{command[0]} is not there")
    scene = folder / "probe.json"
    scene.write_text(to_json(probe_scene()), encoding="utf-8")
    entry = next(entry for entry in ENTRIES if entry.peer == name)
    reason = ""
    for job, environment in candidates(name):
        peer = Peer(name, command, job, environment)
        try:
            told = peer.render({**entry.job, "scene": str(scene), "width": 16, "height": 16, "max_depth": 4,
                                "threads": 1, "seed": 1, "samples": 4, "output": str(folder / "probe.exr")},
                               folder, PROBE_SECONDS)
        except Unavailable as error:
            reason = str(error)
            continue
        return dataclasses.replace(peer, version=told["version"])
    raise Unavailable(reason)
