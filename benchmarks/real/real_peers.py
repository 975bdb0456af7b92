#!/usr/bin/env python3
"""Holds bdpt against Cycles and Mitsuba 3 in real models: VENV/bin/python real_peers.py MODELS --bdpt PROGRAM

MODELS is a folder of third-party models, as for real_scenes.py, whose list of scenes is used where CAMERAS has a view.
All renderers get the same file (meshopt compression is decoded first), camera, environment, size and path length. The
interpreter needs numpy, pillow, meshoptimizer, and bpy (Cycles), mitsuba (with libLLVM) or both; a peer that fails is
skipped with its reason. Renderers take turns; each image is by one thread.

Prints for each scene and renderer: microseconds of CPU time for a camera path, squared relative error (variance
between seeds over the square of the renderer's light, see compute_light, without the worst 0.1 % of pixels), the same
relative to the independent reference of bdpt, CPU time, error x time over that of the first way of bdpt for both
errors, and the mean radiance over that of bdpt. Where rare bright paths decide, use --reference 2048 or more: errors
are divided by the reference, whose own noise makes those of dark pixels larger. CPU time is without loading: for bdpt
without a render of one pixel, for the others that of 63 samples beyond the first. Materials are not equal in all, so
means may differ: look at --pictures."""

import contextlib
import json
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "peers"))
import numpy as np
import peers
import plain_model
import real_scenes
import seed_errors

# File -> position, target, vertical field of view [degrees]; mostly what bdpt fits to the scene.
CAMERAS = {
    "HotelRoom_meshopt/scene.glb": ((12626.2, 1032.3, -8130.7), (11709.0, 912.5, -8510.7), 60),
    "Lamborghini/scene.glb": ((5.028, 3.476, 6.491), (0.716, 0.74, 0.333), 40),
    "Jungle/scene.gltf": ((374.9, 192.7, 586.3), (-2.4, -46.7, 47.5), 40),
    "GodotLivingRoom/living_room.glb": ((2, 1.4, 8.5), (-3, 0.8, -1), 60),
    "Garage/garage.gltf": ((2.67, 1.44, 1.801), (0.564, 1.081, -0.305), 60),
    "Chess/scene.gltf": ((207.690, 107.069, 250.711), (23.601, -9.746, -12.195), 40),
    "GodotRoom/scene.gltf": ((4, 2.5, -4), (-0.153, 1.792, 0.153), 60),
    "ShaderBall_materialx/shaderball.glb": ((2.215, 2.349, 3.206), (0.059, 0.981, 0.127), 40),
}
REFERENCE_SEED = 1000
LONG = 63  # samples of a peer's timed render beyond the first, which stands for loading


def system_seconds():
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_stime


class Bdpt:
    """Renders with one way of bdpt: options of `bdpt render`."""

    remarks = ()

    def __init__(self, way, job, arguments):
        self.name, self.arguments = f"bdpt {way}", arguments
        self.file = pathlib.Path(job["folder"]) / "bdpt.exr"
        numbers = [",".join(map(str, job[key])) for key in ("from", "look_at")]
        self.scene = (job["model"], "--env", job["environment"], f"--from={numbers[0]}", f"--look-at={numbers[1]}",
                      "--fov", str(job["fov"]))
        self.way = way if ": " in way else f"{arguments.bdpt}: {way}"
        self.version = "bdpt"
        self.started = None

    def render(self, spp, seed):
        took = self.run(self.way, "--spp", str(spp), "--seed", str(seed))
        return took, seed_errors.pixels(self.file)

    def run(self, way, *options):
        """Returns CPU seconds, with those of the system, as for the peers."""
        before = system_seconds()
        took = real_scenes.render(way, self.scene, self.file, self.arguments, *options)
        return took + system_seconds() - before

    def measure_load(self):
        """Renders one pixel without a pilot, which counts as rendering."""
        options = ("--spp", "1", "--crop", "0,0,1,1")
        way = f"{self.arguments.bdpt}: --integrator mis --env-sampling compensated"
        return min(self.run(way, *options) for _ in range(2))

    def render_time(self, took, load, _):
        return took - load

    def begin_reference(self, spp):
        self.started = spp

    def end_reference(self):
        return self.render(self.started, REFERENCE_SEED)[1]

    def close(self):
        pass


class Worker:
    """Renders with a peer in a process of its own, which loads once."""

    def __init__(self, name, job, environment):
        folder = pathlib.Path(job["folder"])
        self.name = name
        self.file = folder / (name + {"cycles": ".exr", "mitsuba": ".npy"}[name])
        job_file = folder / f"{name}.json"
        job_file.write_text(json.dumps(job), encoding="utf-8")
        self.log = open(folder / f"{name}.log", "w+", encoding="utf-8")
        self.process = subprocess.Popen([sys.executable, HERE / "peer_worker.py", name, job_file], text=True,
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self.log,
                                        env={**os.environ, **environment})
        told = self.receive()
        self.version, self.remarks = f"{name} {told['version']}", told["remarks"]

    def send(self, spp, seed, threads):
        self.process.stdin.write(f"{spp} {seed} {threads} {self.file}\n")
        self.process.stdin.flush()

    def receive(self):
        for line in self.process.stdout:
            if line.startswith("RESULT "):
                return json.loads(line.partition(" ")[2])
        self.process.wait()
        self.log.seek(0)
        lines = self.log.read().strip().splitlines() or [f"exit code {self.process.returncode}"]
        self.log.close()
        raise peers.Unavailable(lines[-1][:200])

    def pixels(self):
        return np.load(self.file) if self.file.suffix == ".npy" else seed_errors.pixels(self.file)

    def render(self, spp, seed):
        self.send(spp, seed, 1)
        return self.receive()["seconds"], self.pixels()

    def measure_load(self):
        """Returns seconds of one sample, and measures the others: loading can take longer than a few samples."""
        load, whole = (min(self.render(spp, seed)[0] for seed in (901, 902)) for spp in (1, 1 + LONG))
        self.seconds_of_sample = (whole - load) / LONG
        return load

    def render_time(self, _, __, spp):
        return self.seconds_of_sample * spp

    def begin_reference(self, spp):
        self.send(spp, REFERENCE_SEED, os.cpu_count())

    def end_reference(self):
        self.receive()
        return self.pixels()

    def close(self):
        self.process.stdin.close()
        self.process.wait()
        self.log.close()


def open_peer(name, job):
    """Returns the peer with the job's scene; Mitsuba with the newest LLVM that works. Raises Unavailable."""
    reason = "no libLLVM"
    libraries = [{"DRJIT_LIBLLVM_PATH": file} for file in peers.llvm_libraries()] if name == "mitsuba" else [{}]
    for environment in libraries:
        try:
            return Worker(name, job, environment)
        except peers.Unavailable as error:
            reason = str(error)
    raise peers.Unavailable(reason)


def measure(renderers, arguments):
    """Returns for each renderer the least seconds of one image, the images of all seeds, and its reference."""
    for renderer in renderers:
        renderer.begin_reference(arguments.reference)
    references = [renderer.end_reference() for renderer in reversed(renderers)][::-1]
    loads = [renderer.measure_load() for renderer in renderers]
    seconds, images = ([[] for _ in renderers] for _ in range(2))
    for seed in range(1, arguments.seeds + 1):
        for k, renderer in enumerate(renderers):
            took, image = renderer.render(arguments.spp, seed)
            seconds[k].append(renderer.render_time(took, loads[k], arguments.spp))
            images[k].append(image)
    return [max(min(each), 1e-6) for each in seconds], [np.stack(each) for each in images], references


def write_picture(references, file):
    """Writes the references side by side, all with one exposure."""
    from PIL import Image
    scale = 0.18 / np.exp(np.log(np.maximum(references[0].mean(axis=-1), 1e-6)).mean())
    linear = 1 - np.exp(-1.5 * scale * np.maximum(np.hstack(references), 0))
    Image.fromarray((255 * linear ** (1 / 2.2) + 0.5).astype(np.uint8)).save(file)


def compute_light(reference, of_bdpt):
    """Returns the light of a renderer without the noise of its reference, by which dark pixels would be divided: the
    reference of bdpt times the ratio of both, averaged over neighbours."""
    own, first = (seed_errors.smooth(each, seed_errors.SMOOTHING).mean(axis=-1, keepdims=True)
                  for each in (reference, of_bdpt))
    return of_bdpt * own / np.maximum(first, 1e-12)


def report(name, renderers, arguments):
    seconds, images, references = measure(renderers, arguments)
    errors = [real_scenes.compute_trimmed_error(each, compute_light(reference, references[0]))
              for each, reference in zip(images, references)]
    by_first = [real_scenes.compute_trimmed_error(each, references[0]) for each in images]
    paths = images[0].shape[1] * images[0].shape[2] * arguments.spp
    for k, renderer in enumerate(renderers):
        means = [references[i][..., :3].mean() for i in (k, 0)]
        print(f"{name:24}{renderer.name:26}{1e6 * seconds[k] / paths:8.2f}{errors[k]:10.3g}{by_first[k]:10.3g}"
              f"{seconds[k]:8.2f}{errors[k] * seconds[k] / (errors[0] * seconds[0]):9.2f}"
              f"{by_first[k] * seconds[k] / (by_first[0] * seconds[0]):9.2f}{means[0] / means[1]:8.3f}", flush=True)
    if arguments.pictures:
        arguments.pictures.mkdir(parents=True, exist_ok=True)
        stem = re.sub(r"\W+", "-", name)
        write_picture(references, arguments.pictures / f"{stem}.png")
        np.savez_compressed(arguments.pictures / f"{stem}.npz", references=references)


def make_job(file, options, folder, arguments):
    model = arguments.models / file
    loaded = plain_model.Model(model)
    if loaded.is_compressed:
        model = pathlib.Path(folder) / "plain.glb"
        loaded.write_plain(model)
    position, target, fov = CAMERAS[file]
    width, height = map(int, arguments.size.split("x"))
    environment = re.search(r"--env (\S+)", options)[1].format(hdr=arguments.models / "hdr")
    return {"model": str(model.resolve()), "environment": str(pathlib.Path(environment).resolve()), "from": position,
            "look_at": target, "fov": fov, "width": width, "height": height, "max_depth": arguments.max_depth,
            "sampler": arguments.mitsuba_sampler, "folder": folder}


def parse_arguments():
    parser = real_scenes.make_parser(__doc__, 3, 256)
    parser.add_argument("models", type=pathlib.Path, metavar="MODELS")
    parser.add_argument("--bdpt", type=pathlib.Path, default=real_scenes.ROOT / "build/release/apps/bdpt")
    parser.add_argument("--way", action="append", metavar="OPTIONS",
                        help="of `bdpt render`, or PROGRAM: OPTIONS; default: --integrator auto")
    parser.add_argument("--peers", default="cycles,mitsuba")
    parser.add_argument("--mitsuba-sampler", default="independent", help="its plugin, for example multijitter")
    parser.add_argument("--pictures", type=pathlib.Path, metavar="DIR")
    arguments = parser.parse_args()
    if arguments.spp < 2:
        parser.error("--spp must be at least 2")
    return arguments


def main():
    arguments = parse_arguments()
    print(f"{'scene':24}{'renderer':26}{'us/path':>8}{'error':>10}{'(to bdpt)':>10}{'seconds':>8}{'product':>9}"
          f"{'(bdpt)':>9}{'mean':>8}")
    told = set()
    for name, file, options in real_scenes.SCENES:
        if file not in CAMERAS or "--env" not in options or not re.search(arguments.only, name) \
                or not (arguments.models / file).exists():
            continue
        with tempfile.TemporaryDirectory() as folder, contextlib.ExitStack() as open_ones:
            job = make_job(file, options, folder, arguments)
            renderers = [Bdpt(way, job, arguments) for way in arguments.way or ["--integrator auto"]]
            for peer in filter(None, arguments.peers.split(",")):
                try:
                    renderers.append(open_peer(peer, job))
                    open_ones.callback(renderers[-1].close)
                except peers.Unavailable as error:
                    print(f"{name}: no {peer}: {error}", flush=True)
            report(name, renderers, arguments)
            told.update(f"{name}: {each.name} {remark}" for each in renderers for remark in each.remarks)
            told.update(each.version for each in renderers[len(arguments.way or [1]):])
    print("\n".join(sorted(told)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
