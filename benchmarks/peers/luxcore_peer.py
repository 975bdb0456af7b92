"""Renders with LuxCore: `PATHCPU` and `BIDIRCPU`.

BIDIRCPU limits each subpath but not the whole path, so only images without longer paths agree. For rough surfaces
LuxCore uses GGX with another masking term."""

import math
import time

POLL = 0.02  # [s]
LEAST_SAMPLES = 4  # per pixel: with less than one, some pixels would stay black


def material_properties(name, material):
    kinds = {
        ("diffuse", False): {"type": "matte", "kd": list(material.color)},
        ("metal", False): {"type": "mirror", "kr": [1.0] * 3},
        ("metal", True): {"type": "metal2", "uroughness": material.alpha, "vroughness": material.alpha,
                          "fresnel": "white"},
        ("glass", False): {"type": "glass", "kr": [1.0] * 3, "kt": [1.0] * 3, "interiorior": material.ior},
        ("glass", True): {"type": "roughglass", "kr": [1.0] * 3, "kt": [1.0] * 3, "interiorior": material.ior,
                          "uroughness": material.alpha, "vroughness": material.alpha},
    }
    result = dict(kinds[material.kind, material.alpha > 0])
    if material.emission:
        result["emission"] = list(material.emission)
    return {f"scene.materials.{name}.{key}": value for key, value in result.items()}


def camera_properties(camera, job):
    # The field of view covers the screen window from -1 to 1. LuxCore's pixel rows are off by one, so the window is
    # shifted by one row.
    aspect, row = job["width"] / job["height"], 2.0 / job["height"]
    return {"scene.camera.type": "perspective", "scene.camera.lookat.orig": list(camera.position),
            "scene.camera.lookat.target": [p + d for p, d in zip(camera.position, camera.direction)],
            "scene.camera.up": list(camera.up), "scene.camera.fieldofview": math.degrees(camera.vertical_fov),
            "scene.camera.screenwindow": [-aspect, aspect, -1.0 - row, 1.0 - row],
            "scene.camera.autofocus.enable": False, "scene.camera.lensradius": 0.0}


def settings(job):
    result = {
        "renderengine.type": job["integrator"], "renderengine.seed": job["seed"] + 1,
        "native.threads.count": job["threads"], "sampler.type": "SOBOL", "sampler.sobol.adaptive.strength": 0.0,
        "film.width": job["width"], "film.height": job["height"], "film.filter.type": "NONE",
        "film.outputs.0.type": "RGB", "film.outputs.0.filename": job["output"],
        "path.clamping.variance.maxvalue": 0.0,
    }
    if not job["roulette"]:  # roulette makes its mean wrong: see README.md
        result["path.russianroulette.depth"] = job["max_depth"] + 1
    if job["integrator"] == "BIDIRCPU":
        return {**result, "path.maxdepth": job["max_depth"], "light.maxdepth": job["max_depth"]}
    kinds = ("total", "diffuse", "glossy", "specular")
    return {**result, **{f"path.pathdepth.{kind}": job["max_depth"] for kind in kinds}}


def properties(pyluxcore, values):
    result = pyluxcore.Properties()
    for key, value in values.items():
        result.Set(pyluxcore.Property(key, value))
    return result


def load(pyluxcore, described, job):
    scene = pyluxcore.Scene()
    scene.Parse(properties(pyluxcore, {
        **camera_properties(described.camera, job), "scene.textures.white.type": "fresnelcolor",
        "scene.textures.white.kr": [1.0] * 3}))
    for i, material in enumerate(described.materials):
        scene.Parse(properties(pyluxcore, material_properties(f"m{i}", material)))
    for i, mesh in enumerate(described.meshes):
        scene.DefineMesh(f"s{i}", list(mesh.positions), list(mesh.triangles), None, None, None, None)
        scene.Parse(properties(pyluxcore, {f"scene.objects.o{i}.shape": f"s{i}",
                                           f"scene.objects.o{i}.material": f"m{mesh.material}"}))
    for i, point in enumerate(described.points):
        light = f"scene.lights.l{i}"
        scene.Parse(properties(pyluxcore, {
            f"{light}.type": "point", f"{light}.position": list(point.position), f"{light}.color": [1.0] * 3,
            f"{light}.gain": [4 * math.pi * candela for candela in point.intensity]}))  # the gain is a radiant flux
    return scene


def render(described, job):
    import pyluxcore
    from worker import Stopwatch
    pyluxcore.Init()
    pyluxcore.SetLogHandler(lambda message: None)
    values = settings(job)
    if "samples" in job:
        values["batch.haltspp"] = job["samples"]
    config = pyluxcore.RenderConfig(properties(pyluxcore, values), load(pyluxcore, described, job))
    session = pyluxcore.RenderSession(config)
    session.Start()
    watch = Stopwatch()

    def samples():
        session.UpdateStats()
        count = session.GetStats().Get("stats.renderengine.total.samplecount").GetFloat()
        return count / (job["width"] * job["height"])

    while not session.HasDone() and (watch.seconds() < job.get("seconds", math.inf) or samples() < LEAST_SAMPLES):
        time.sleep(POLL)
        session.UpdateStats()
    session.Pause()
    result = {"seconds": watch.seconds(), "cpu_seconds": watch.cpu_seconds(), "samples": samples()}
    session.GetFilm().SaveOutputs()
    session.Stop()
    shown = {key: value for key, value in values.items() if key.startswith(("sampler", "path", "light"))}
    return {**result, "version": pyluxcore.Version(), "settings": shown}
