"""Renders a model with Cycles or Mitsuba: peer_worker.py cycles|mitsuba JOB.json, run by real_peers.py.

The job has `model`, `environment`, `from`, `look_at`, `fov` (vertical, degrees), `width`, `height`, `max_depth`
(edges) and `sampler` (of Mitsuba). Loads once; then reads lines "SPP SEED THREADS FILE" and renders each into FILE
(.exr by Cycles, .npy by Mitsuba). Answers with lines "RESULT {json}": first version and remarks, then the CPU seconds
of each image."""

import json
import pathlib
import resource
import sys
import tempfile
import time

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "peers"))
import numpy as np
import plain_model

PASS = 16  # samples of one pass of Mitsuba, which bounds the memory
HALF_TURN = 180.0


def cpu_seconds():
    """Returns those of the user and of the system: Mitsuba's memory for intermediate values is work for the system."""
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


class Cycles:
    """Renders with Blender's glTF importer and Cycles on the CPU."""

    def __init__(self, job):
        import bpy
        self.bpy, self.job = bpy, job
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.ops.import_scene.gltf(filepath=job["model"])
        self.scene = bpy.context.scene
        self.add_camera()
        self.add_environment()
        self.version = bpy.app.version_string
        self.remarks = []

    def add_camera(self):
        import mathutils
        job, scene = self.job, self.scene
        eye, target = (mathutils.Vector((p[0], -p[2], p[1])) for p in (job["from"], job["look_at"]))
        camera = self.bpy.data.cameras.new("view")
        camera.sensor_fit, camera.angle = "VERTICAL", np.radians(job["fov"])
        distance = (target - eye).length
        camera.clip_start, camera.clip_end = 1e-3 * distance, 1e4 * distance
        place = self.bpy.data.objects.new("view", camera)
        place.rotation_euler = (target - eye).to_track_quat("-Z", "Y").to_euler()
        place.location = eye
        scene.collection.objects.link(place)
        scene.camera = place
        scene.render.resolution_x, scene.render.resolution_y = job["width"], job["height"]
        scene.render.resolution_percentage = 100

    def add_environment(self):
        """The image's centre is towards -z of glTF, which is +y of Blender; Cycles puts it towards +x."""
        world = self.scene.world = self.bpy.data.worlds.new("environment")
        world.use_nodes = True
        nodes, links = world.node_tree.nodes, world.node_tree.links
        nodes.clear()
        place, turn, image, background, output = (
            nodes.new(f"ShaderNode{kind}")
            for kind in ("TexCoord", "Mapping", "TexEnvironment", "Background", "OutputWorld"))
        turn.inputs["Rotation"].default_value = (0.0, 0.0, -np.pi / 2)
        image.image = self.bpy.data.images.load(self.job["environment"])
        links.new(place.outputs["Generated"], turn.inputs["Vector"])
        links.new(turn.outputs["Vector"], image.inputs["Vector"])
        links.new(image.outputs["Color"], background.inputs["Color"])
        links.new(background.outputs["Background"], output.inputs["Surface"])

    def render(self, spp, seed, threads, file):
        import cycles_peer
        scene = self.scene
        cycles_peer.configure(scene, {**self.job, "threads": threads, "seed": seed, "output": file})
        scene.render.image_settings.exr_codec = "ZIP"
        scene.render.use_persistent_data = True
        scene.cycles.use_light_tree = True
        scene.cycles.samples = spp
        before, start = cpu_seconds(), time.perf_counter()
        self.bpy.ops.render.render(write_still=True)
        # While the threads of Cycles render, one of Blender can wait for them in a loop, which takes CPU time as well.
        return min(cpu_seconds() - before, threads * (time.perf_counter() - start))


class Mitsuba:
    """Renders with Mitsuba's path tracer, compiled by LLVM."""

    def __init__(self, job):
        import mitsuba as mi
        mi.set_variant("llvm_ad_rgb")
        self.mi, self.model, self.version = mi, plain_model.Model(job["model"]), mi.__version__
        self.remarks, self.bsdfs = set(), {}
        described = {"type": "scene", "integrator": {"type": "path", "max_depth": job["max_depth"]},
                     "environment": self.environment(job["environment"]), "sensor": self.sensor(job)}
        with tempfile.TemporaryDirectory() as folder:
            for i, piece in enumerate(self.model.pieces()):
                if len(piece.triangles):
                    described[f"piece{i}"] = self.shape(piece, pathlib.Path(folder) / f"{i}.ply")
            self.scene = mi.load_dict(described)
        self.render(1, 0, 2, None)  # compiles

    def sensor(self, job):
        distance = float(np.linalg.norm(np.subtract(job["look_at"], job["from"])))
        film = {"type": "hdrfilm", "width": job["width"], "height": job["height"], "pixel_format": "rgb",
                "component_format": "float32", "rfilter": {"type": "box"}}
        return {"type": "perspective", "fov": job["fov"], "fov_axis": "y", "near_clip": 1e-3 * distance,
                "far_clip": 1e4 * distance, "film": film, "sampler": {"type": job.get("sampler", "independent")},
                "to_world": self.mi.ScalarTransform4f().look_at(job["from"], job["look_at"], [0, 1, 0])}

    def environment(self, file):
        """Mitsuba has the image's centre towards +z, glTF towards -z."""
        mi = self.mi
        bitmap = mi.Bitmap(file).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False)
        return {"type": "envmap", "bitmap": mi.Bitmap(np.maximum(np.array(bitmap), 0)),
                "to_world": mi.ScalarTransform4f().rotate([0, 1, 0], HALF_TURN)}

    def texture(self, values):
        if np.ndim(values) < 2:
            return {"type": "rgb", "value": [float(v) for v in values]} if np.ndim(values) else float(values)
        values = np.ascontiguousarray(values if values.ndim == 3 else values[..., None], dtype=np.float32)
        return {"type": "bitmap", "bitmap": self.mi.Bitmap(values), "raw": True}

    def bsdf(self, index):
        """Returns `principled` by base colour, roughness, metalness, normal map and alpha. All else is left out."""
        material = self.model.material(index)
        pbr, extensions = material.get("pbrMetallicRoughness", {}), material.get("extensions", {})
        color = np.array(pbr.get("baseColorFactor", (1, 1, 1, 1)))
        if "baseColorTexture" in pbr:
            texels = self.model.image(pbr["baseColorTexture"]["index"]) / np.float32(255)
            texels[..., :3] = np.where(texels[..., :3] > 0.04045, ((texels[..., :3] + 0.055) / 1.055) ** 2.4,
                                       texels[..., :3] / 12.92)
            color = texels * color
        roughness, metallic = pbr.get("roughnessFactor", 1.0), pbr.get("metallicFactor", 1.0)
        if "metallicRoughnessTexture" in pbr:
            texels = self.model.image(pbr["metallicRoughnessTexture"]["index"]) / 255.0
            roughness, metallic = roughness * texels[..., 1], metallic * texels[..., 2]
        surface = {"type": "principled", "base_color": self.texture(color[..., :3]), "eta": self.index(extensions),
                   "roughness": self.texture(roughness), "metallic": self.texture(metallic)}
        if "normalTexture" in material:
            scale = material["normalTexture"].get("scale", 1.0) * np.float32([1, 1, 0]) + np.float32([0, 0, 1])
            normal = self.model.image(material["normalTexture"]["index"])[..., :3] / np.float32(255)
            surface = {"type": "normalmap", "normalmap": self.texture((normal - 0.5) * scale + 0.5), "bsdf": surface}
        surface = {"type": "twosided", "surface": surface}
        mode, alpha = material.get("alphaMode", "OPAQUE"), color[..., 3]
        if mode != "OPAQUE":
            alpha = alpha >= material.get("alphaCutoff", 0.5) if mode == "MASK" else alpha
            surface = {"type": "mask", "opacity": self.texture(alpha * 1.0), "surface": surface}
        self.remarks.update(f"without {name}" for name in {*extensions, *material} & {
            "emissiveTexture", "KHR_materials_clearcoat", "KHR_materials_transmission"})
        return surface

    def index(self, extensions):
        """Returns the index of refraction that reflects as much at normal incidence as ior and specular together do."""
        ior = extensions.get("KHR_materials_ior", {}).get("ior", 1.5)
        specular = extensions.get("KHR_materials_specular", {})
        color = np.mean(specular.get("specularColorFactor", 1.0))
        if "specularColorTexture" in specular:
            color *= np.mean((self.model.image(specular["specularColorTexture"]["index"])[..., :3] / 255.0) ** 2.2)
        reflected = min(((ior - 1) / (ior + 1)) ** 2 * color, 1) * specular.get("specularFactor", 1.0)
        if "specularTexture" in specular:
            reflected *= np.mean(self.model.image(specular["specularTexture"]["index"])[..., 3] / 255.0)
        if specular:
            self.remarks.add("with the mean of specular textures, as grey")
        root = min(float(np.sqrt(reflected)), 0.98)
        return max((1 + root) / (1 - root), 1.001)

    def shape(self, piece, file):
        write_ply(piece, file)
        if piece.material not in self.bsdfs:
            self.bsdfs[piece.material] = self.mi.load_dict(self.bsdf(piece.material))
        shape = {"type": "ply", "filename": str(file), "bsdf": self.bsdfs[piece.material]}
        emission = np.array(self.model.material(piece.material).get("emissiveFactor", (0, 0, 0)), float)
        if emission.any():
            shape["emitter"] = {"type": "area", "radiance": self.texture(emission)}
        return shape

    def render(self, spp, seed, threads, file):
        import drjit
        drjit.set_thread_count(threads)
        before, total, done = cpu_seconds(), 0, 0
        while done < spp:
            count = min(PASS, spp - done)
            image = self.mi.render(self.scene, spp=count, seed=seed * 100003 + done)
            total, done = total + count * np.array(image, dtype=np.float64), done + count
        took = cpu_seconds() - before
        if file:
            np.save(file, total / spp)
        return took


def write_ply(piece, file):
    columns = [("xyz", piece.positions)]
    if piece.normals is not None:
        columns.append((("nx", "ny", "nz"), piece.normals))
    if piece.uvs is not None:
        columns.append(("uv", piece.uvs))
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(piece.positions)}",
              *(f"property float {name}" for names, _ in columns for name in names),
              f"element face {len(piece.triangles)}", "property list uchar int vertex_indices", "end_header\n"]
    faces = np.empty(len(piece.triangles), [("count", "u1"), ("corners", "<i4", 3)])
    faces["count"], faces["corners"] = 3, piece.triangles
    vertices = np.hstack([values for _, values in columns]).astype("<f4")
    file.write_bytes("\n".join(header).encode() + vertices.tobytes() + faces.tobytes())


def answer(value):
    print("RESULT " + json.dumps(value), flush=True)


def main():
    name, job = sys.argv[1], json.loads(pathlib.Path(sys.argv[2]).read_text(encoding="utf-8"))
    peer = {"cycles": Cycles, "mitsuba": Mitsuba}[name](job)
    answer({"version": peer.version, "remarks": sorted(peer.remarks)})
    for line in sys.stdin:
        spp, seed, threads, file = line.rstrip("\n").split(" ", 3)
        answer({"seconds": peer.render(int(spp), int(seed), int(threads), file)})


if __name__ == "__main__":
    main()
