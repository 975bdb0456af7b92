"""Renders scenes with all entries in turn, and judges the images."""

import dataclasses
import json
import math
import pathlib
import resource
import statistics
import subprocess

import gltf_reader
import gltf_writer
from peers import RENDER_GRACE, Unavailable
from scene import Medium, read_volume, to_json

REFERENCE_SEED = 100000  # differs from the seeds of all runs
BLAMELESS = 4.0  # standard errors that a channel's mean may deviate
BLAMELESS_EXCESS = 1.5  # limit of the squared error over its noise; few seeds estimate the spread no better


@dataclasses.dataclass(frozen=True)
class Options:
    bdpt: str
    seconds: float  # time of a run
    reference_seconds: float
    seeds: int
    size: tuple  # (width, height)
    max_depth: int  # edges
    threads: int
    fog: Medium = None
    volume: str = None  # an OpenVDB file
    volume_extinction: tuple = (1.0, 1.0, 1.0)


def read_child_cpu():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def fog_options(fog):
    """Returns the fog options of `bdpt render`."""
    if fog is None:
        return ()
    return ("--fog", ",".join(map(str, fog.extinction)), "--fog-albedo", ",".join(map(str, fog.albedo)), "--fog-anisotropy",
            str(fog.anisotropy))


def volume_options(volume):
    return ("--volume", volume.file, "--volume-extinction", ",".join(map(str, volume.extinction))) if volume else ()


def run_bdpt(options, gltf, volume, integrator, seed, limit, output):
    """Renders until `limit`, an option and its value. Returns the fields of a worker's result, but the CPU time of the
    whole process."""
    stats = output.with_suffix(".stats.json")
    before = read_child_cpu()
    subprocess.run([options.bdpt, "render", str(gltf), "-o", str(output), "--integrator", integrator, "--size",
                    "{}x{}".format(*options.size), "--max-depth", str(options.max_depth), "--threads",
                    str(options.threads), "--seed", str(seed), *limit, "--stats", str(stats), "--env", "none",
                    *fog_options(options.fog), *volume_options(volume), "--quiet"], check=True)
    cpu = read_child_cpu() - before
    told = json.loads(stats.read_text(encoding="utf-8"))
    stats.unlink()
    return {"seconds": told["seconds"]["render"], "cpu_seconds": cpu, "samples": told["samples"],
            "version": told["version"], "settings": {"sampler": told["settings"]["sampler"]}}


def compare(options, image, reference):
    """Returns the report of `bdpt compare` for an image or a folder of images."""
    done = subprocess.run([options.bdpt, "compare", str(image), str(reference), "--relative", "--json", "--metrics",
                           "relmse,mse"], check=True, stdout=subprocess.PIPE, text=True)
    return json.loads(done.stdout)


class Stage:
    """Prepares one scene for all entries: its description, its glTF file, and a reference by bdpt."""

    def __init__(self, options, file, folder):
        folder.mkdir(parents=True, exist_ok=True)
        self.options, self.folder, self.name = options, folder, file.stem
        volume = options.volume and read_volume(options.volume, options.volume_extinction, folder.resolve())
        self.scene = dataclasses.replace(gltf_reader.read(file), fog=options.fog, volume=volume)
        self.description, self.gltf = folder / "scene.json", folder / f"{file.stem}.gltf"
        self.description.write_text(to_json(self.scene), encoding="utf-8")
        gltf_writer.write(self.scene, self.gltf)

    def make_reference(self):
        self.reference = self.folder / "reference.exr"
        limit = ("--time", f"{self.options.reference_seconds}s")
        self.reference_run = run_bdpt(self.options, self.gltf, self.scene.volume, "bdpt", REFERENCE_SEED, limit,
                                      self.reference)

    def run(self, entry, peer, seed, output):
        """Renders one image with one entry. Raises Unavailable."""
        options = self.options
        if entry.peer == "bdpt":
            limit = ("--time", f"{options.seconds}s")
            return run_bdpt(options, self.gltf, self.scene.volume, entry.job["integrator"], seed, limit, output)
        job = {**entry.job, "scene": str(self.description), "width": options.size[0], "height": options.size[1],
               "max_depth": options.max_depth, "threads": options.threads, "seed": seed, "seconds": options.seconds,
               "output": str(output)}
        return peer.render(job, self.folder, RENDER_GRACE + 8 * options.seconds)


def contest(stage, entries, peers, tell):
    """Runs the entries in turn (A B C A B C). Returns the runs of each (name -> list), and why others have none (name
    -> reason)."""
    runs, skipped = {}, {}
    for entry in entries:
        unsupported_kinds = stage.scene and entry.unsupported_kinds(stage.scene)
        lacking = stage.scene and entry.lacks(stage.scene)
        if unsupported_kinds:
            skipped[entry.name] = f"it does not show {unsupported_kinds}"
        elif lacking:
            skipped[entry.name] = f"it is for {lacking}"
        else:
            runs[entry.name] = []
    for seed in range(stage.options.seeds):
        for entry in [entry for entry in entries if entry.name in runs]:
            folder = stage.folder / entry.name
            folder.mkdir(exist_ok=True)
            image = folder / f"{seed}.exr"
            try:
                run = stage.run(entry, peers.get(entry.peer), seed, image)
            except Unavailable as error:
                del runs[entry.name]
                skipped[entry.name] = str(error)
                tell(f"{stage.name}: {entry.name}: skipped: {error}")
                continue
            runs[entry.name].append({**run, "seed": seed, "picture": str(image)})
            tell(f"{stage.name}: {entry.name}, seed {seed}: {run['samples']:.4g} spp in {run['seconds']:.3g} s")
    return runs, skipped


def compute_standard_error(values):
    """Returns the standard error of the mean of some values; 0 for a single one."""
    return statistics.stdev(values) / math.sqrt(len(values)) if len(values) > 1 else 0.0


def decide_means(reports, noise):
    """Returns the bias of each channel over all seeds, in standard errors. The standard error combines the larger of
    those between seeds and within images with that of the reference (`noise`)."""
    result = {}
    for channel in ("red", "green", "blue", "mean"):
        values = [report["bias"][channel]["value"] for report in reports]
        within = math.hypot(*(report["bias"][channel]["standard_error"] for report in reports)) / len(reports)
        error = math.hypot(max(within, compute_standard_error(values)), noise.get(channel, 0.0))
        bias = statistics.fmean(values)
        result[channel] = {"bias": bias, "standard_error": error, "z": bias / error if error > 0 else 0.0}
    return result


def estimate_noise(folder_report, seeds):
    """Returns the mean squared error that noise explains in one image, from the spread between seeds."""
    return seeds * folder_report["bias"]["pixel_standard_error"] ** 2


def excess(folder_report, seeds, noise_of_reference):
    """Returns mean squared error over noise: 1 if images differ by noise only, more if their content differs."""
    noise = estimate_noise(folder_report, seeds) + noise_of_reference
    return folder_report["metrics"]["mse"]["mean"] / noise if noise > 0 else 1.0


def own_errors(errors, error_of_reference):
    """Subtracts the reference's error. Returns none if that exceeds half of the errors, because the rest would be
    noise."""
    if statistics.median(errors) < 2 * error_of_reference:
        return []
    return [max(error - error_of_reference, 0.0) for error in errors]


def judge(stage, runs):
    """Returns for each entry its errors and whether its mean agrees with bdpt's. The runs of bdpt give the noise of the
    reference."""
    options, reports, folders = stage.options, {}, {}
    for name, list_of_runs in runs.items():
        reports[name] = [compare(options, run["picture"], stage.reference) for run in list_of_runs]
        if options.seeds > 1:
            folders[name] = compare(options, pathlib.Path(list_of_runs[0]["picture"]).parent, stage.reference)
    share = runs["bdpt"][0]["samples"] / stage.reference_run["samples"]  # ratio of variances
    ours = decide_means(reports["bdpt"], {})
    noise = {channel: ours[channel]["standard_error"] * math.sqrt(options.seeds * share) for channel in ours}
    our_errors = [report["metrics"]["relmse"]["mean"] for report in reports["bdpt"]]
    error_of_reference = share / (1 + share) * statistics.median(our_errors)
    squared_noise = share * estimate_noise(folders["bdpt"], options.seeds) if folders else 0.0
    result = {}
    for name, list_of_runs in runs.items():
        errors = own_errors([r["metrics"]["relmse"]["mean"] for r in reports[name]], error_of_reference)
        means = decide_means(reports[name], noise)
        more = excess(folders[name], options.seeds, squared_noise) if folders else 1.0
        agrees = all(abs(channel["z"]) <= BLAMELESS for channel in means.values()) and more <= BLAMELESS_EXCESS
        result[name] = {"means": means, "excess": more, "agrees": agrees, "relmse": errors,
                        "seconds": [run["seconds"] for run in list_of_runs],
                        "cpu_seconds": [run["cpu_seconds"] for run in list_of_runs],
                        "samples": [run["samples"] for run in list_of_runs],
                        "version": list_of_runs[0]["version"], "settings": list_of_runs[0]["settings"]}
    for name, entry in result.items():
        for clock in ("seconds", "cpu_seconds"):
            entry[f"ratio_{clock}"] = ratio(entry, result["bdpt"], clock)
    return {"mean": reports["bdpt"][0]["scale"]["epsilon"] / 0.01, "entries": result}


def ratio(theirs, ours, clock):
    """Returns the error at equal time over that of bdpt: the median over seeds of the ratio of relMSE times time, since
    relMSE falls with 1 / time; None if either is unknown."""
    ratios = [a * s / (b * t) for a, s, b, t in
              zip(theirs["relmse"], theirs[clock], ours["relmse"], ours[clock]) if b * t > 0]
    return statistics.median(ratios) if ratios else None
