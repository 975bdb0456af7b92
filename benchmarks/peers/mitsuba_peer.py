"""Renders with Mitsuba 3: `path`, `ptracer` (light tracing), and the volumetric path tracers `volpath` and
`volpathmis`, all in RGB mode."""

import pathlib
import tempfile

LANES = 1 << 20  # samples of one pass, which bounds the memory


def bsdf(material):
    if material.kind == "glass" and material.ior == 1:
        return {"type": "null"}
    if material.kind == "glass":
        kind = {"type": "roughdielectric", "distribution": "ggx", "alpha": material.alpha} if material.alpha > 0 \
            else {"type": "dielectric"}
        return {**kind, "int_ior": material.ior, "ext_ior": 1.0}
    if material.kind == "metal":  # "none" reflects everything
        inner = {"type": "roughconductor", "distribution": "ggx", "alpha": material.alpha, "material": "none"} \
            if material.alpha > 0 else {"type": "conductor", "material": "none"}
    else:
        inner = {"type": "diffuse", "reflectance": {"type": "rgb", "value": list(material.color)}}
    return {"type": "twosided", "bsdf": inner}


def medium(described):
    scale = max(*described.extinction, 1e-9)
    return {"type": "homogeneous", "scale": scale, "albedo": {"type": "rgb", "value": list(described.albedo)},
            "sigma_t": {"type": "rgb", "value": [e / scale for e in described.extinction]},
            "phase": {"type": "hg", "g": described.anisotropy}}


def add_fog(result, scene):
    """Adds a sphere with a null boundary that contains the fog; bodies are inside of it."""
    result["fog"] = medium(scene.fog)
    center, radius = scene.sphere()
    result["extent of the fog"] = {"type": "sphere", "center": list(center), "radius": radius, "bsdf": {"type": "null"},
                                   "interior": {"type": "ref", "id": "fog"}}


def add_volume(mi, result, volume):
    """Adds densities in a box with a null boundary."""
    import numpy
    densities = numpy.load(volume.densities).transpose(2, 1, 0)[..., None]
    densities = densities * numpy.array(volume.extinction, dtype=numpy.float32)
    transform = mi.ScalarTransform4f
    box = transform([list(row) for row in volume.world_from_grid]) @ transform().scale(list(volume.size))
    grid = {"type": "gridvolume", "grid": mi.VolumeGrid(numpy.ascontiguousarray(densities)), "to_world": box, "raw": True,
            "filter_type": "trilinear", "wrap_mode": "clamp"}
    result["extent of the volume"] = {
        "type": "cube", "to_world": box @ transform().translate([0.5, 0.5, 0.5]) @ transform().scale([0.5, 0.5, 0.5]),
        "bsdf": {"type": "null"},
        "interior": {"type": "heterogeneous", "sigma_t": grid, "albedo": 1.0, "phase": {"type": "isotropic"}}}


def write_ply(mesh, path):
    lines = ["ply", "format ascii 1.0", f"element vertex {len(mesh.positions)}",
             *(f"property float {c}" for c in "xyz"), f"element face {len(mesh.triangles)}", "property list uchar int vertex_indices", "end_header",
             *("{:.9g} {:.9g} {:.9g}".format(*p) for p in mesh.positions),
             *("3 {} {} {}".format(*t) for t in mesh.triangles)]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def description(mi, scene, job, folder):
    """Returns the scene as Mitsuba's dictionary."""
    camera = scene.camera
    target = [p + d for p, d in zip(camera.position, camera.direction)]
    result = {
        "type": "scene",
        "integrator": {"type": job["integrator"], "max_depth": job["max_depth"]},
        "sensor": {
            "type": "perspective", "fov": camera.vertical_fov * 57.29577951308232, "fov_axis": "y",
            "near_clip": 1e-3, "far_clip": 1e4,
            "to_world": mi.ScalarTransform4f().look_at(list(camera.position), target, list(camera.up)),
            "film": {"type": "hdrfilm", "width": job["width"], "height": job["height"], "pixel_format": "rgb",
                     "component_format": "float32", "rfilter": {"type": "box"}},
            "sampler": {"type": "independent"},
        },
    }
    if scene.fog:
        add_fog(result, scene)
    if scene.volume:
        add_volume(mi, result, scene.volume)
    for i, mesh in enumerate(scene.meshes):
        material, file = scene.materials[mesh.material], folder / f"{i}.ply"
        write_ply(mesh, file)
        shape = {"type": "ply", "filename": str(file), "face_normals": True, "bsdf": bsdf(material)}
        if material.inside:
            shape["interior"] = medium(material.inside)
        if scene.fog and material.kind == "glass":
            shape["exterior"] = {"type": "ref", "id": "fog"}
        if material.emission:
            shape["emitter"] = {"type": "area", "radiance": {"type": "rgb", "value": list(material.emission)}}
        result[f"mesh{i}"] = shape
    for i, point in enumerate(scene.points):
        result[f"point{i}"] = {"type": "point", "position": list(point.position),
                               "intensity": {"type": "rgb", "value": list(point.intensity)}}
    return result


def render(scene, job):
    import drjit
    import mitsuba as mi
    from worker import Stopwatch
    mi.set_variant(job["variant"])
    drjit.set_thread_count(job["threads"])
    with tempfile.TemporaryDirectory() as folder:
        loaded = mi.load_dict(description(mi, scene, job, pathlib.Path(folder)))
    pixels = job["width"] * job["height"]
    spp = max(1, min(LANES // pixels, job.get("samples") or LANES))

    def one_pass(number):
        image = mi.render(loaded, spp=spp, seed=(job["seed"] * 100003 + number) % (1 << 32))
        drjit.eval(image)
        drjit.sync_thread()
        return image

    one_pass(100002)  # triggers compilation
    total, passes, watch = None, 0, Stopwatch()
    while passes == 0 or (watch.seconds() < job["seconds"] if "seconds" in job else passes * spp < job["samples"]):
        image = one_pass(passes)
        total, passes = image if total is None else total + image, passes + 1
    drjit.eval(total)
    drjit.sync_thread()
    result = {"seconds": watch.seconds(), "cpu_seconds": watch.cpu_seconds(), "samples": passes * spp}
    drjit.set_thread_count(2)  # a single thread deadlocks when it writes
    mi.Bitmap(total / passes).write(job["output"])
    return {**result, "version": mi.__version__,
            "settings": {"variant": job["variant"], "sampler": "independent", "samples of a pass": spp}}
