"""Renders with Blender's Cycles on the CPU. One operator both loads and renders, so the load time is measured first."""

import math

PILOT = 4  # samples per pixel of the first render, which converts a time limit to samples


def socket(node, name, value):
    node.inputs[name].default_value = value


def material_nodes(bpy, item):
    result = bpy.data.materials.new(item.name)
    result.use_nodes = True
    tree = result.node_tree
    tree.nodes.clear()
    kind = {"diffuse": "ShaderNodeBsdfDiffuse", "metal": "ShaderNodeBsdfGlossy", "glass": "ShaderNodeBsdfGlass"}
    surface = tree.nodes.new(kind[item.kind])
    socket(surface, "Color", (*item.color, 1.0))
    if item.kind == "diffuse":
        socket(surface, "Roughness", 0.0)  # above 0 it would be Oren-Nayar
    else:
        surface.distribution = "GGX"  # smooth where the roughness is 0
        socket(surface, "Roughness", math.sqrt(item.alpha))
    if item.kind == "glass":
        socket(surface, "IOR", item.ior)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    shader = surface.outputs[0]
    if item.emission:
        shader = with_emission(tree, shader, item.emission)
    tree.links.new(shader, output.inputs["Surface"])
    return result


def with_emission(tree, shader, radiance):
    """Adds emission from the front only: Blender emits from both sides unless the strength is multiplied by 1 -
    Backfacing."""
    strength = max(radiance)
    emission, sides = tree.nodes.new("ShaderNodeEmission"), tree.nodes.new("ShaderNodeNewGeometry")
    front, both = tree.nodes.new("ShaderNodeMath"), tree.nodes.new("ShaderNodeAddShader")
    socket(emission, "Color", (*(c / strength for c in radiance), 1.0))
    front.operation = "MULTIPLY_ADD"  # strength - strength * Backfacing
    front.inputs[1].default_value, front.inputs[2].default_value = -strength, strength
    tree.links.new(sides.outputs["Backfacing"], front.inputs[0])
    tree.links.new(front.outputs[0], emission.inputs["Strength"])
    tree.links.new(shader, both.inputs[0])
    tree.links.new(emission.outputs[0], both.inputs[1])
    return both.outputs[0]


def add_camera(bpy, mathutils, scene, described, job):
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit, camera.angle = "VERTICAL", described.vertical_fov
    camera.clip_start, camera.clip_end = 1e-3, 1e4
    z, y = mathutils.Vector([-c for c in described.direction]), mathutils.Vector(described.up)
    x = y.cross(z)
    place = bpy.data.objects.new("camera", camera)
    rows = [(x[i], y[i], z[i], described.position[i]) for i in range(3)]
    place.matrix_world = mathutils.Matrix([*rows, (0, 0, 0, 1)])
    scene.collection.objects.link(place)
    scene.camera = place
    scene.render.resolution_x, scene.render.resolution_y = job["width"], job["height"]
    scene.render.resolution_percentage = 100


def load(bpy, described, job):
    import mathutils
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    materials = [material_nodes(bpy, item) for item in described.materials]
    for item in described.meshes:
        mesh = bpy.data.meshes.new(item.name)
        mesh.from_pydata([tuple(p) for p in item.positions], [], [tuple(t) for t in item.triangles])
        mesh.materials.append(materials[item.material])
        scene.collection.objects.link(bpy.data.objects.new(item.name, mesh))
    for item in described.points:
        light = bpy.data.lights.new(item.name, "POINT")
        candela = max(item.intensity)
        light.shadow_soft_size, light.color = 0.0, [c / candela for c in item.intensity]
        light.energy = candela * 4 * math.pi  # Blender takes radiant flux
        place = bpy.data.objects.new(item.name, light)
        place.location = item.position
        scene.collection.objects.link(place)
    add_camera(bpy, mathutils, scene, described.camera, job)
    return scene


def configure(scene, job):
    render, cycles, bounces = scene.render, scene.cycles, job["max_depth"] - 2
    render.engine, cycles.device = "CYCLES", "CPU"
    render.threads_mode, render.threads = "FIXED", job["threads"]
    render.film_transparent, render.use_compositing, render.use_sequencer = False, False, False
    render.filepath = job["output"]
    image = render.image_settings
    image.file_format, image.color_mode, image.color_depth = "OPEN_EXR", "RGB", "32"
    for name in ("max", "diffuse", "glossy", "transmission"):
        setattr(cycles, f"{name}_bounces", bounces)
    cycles.min_light_bounces = cycles.min_transparent_bounces = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.blur_glossy = cycles.light_sampling_threshold = 0.0
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    cycles.use_adaptive_sampling = cycles.use_denoising = cycles.use_auto_tile = False
    cycles.pixel_filter_type, cycles.filter_width, cycles.film_exposure = "BOX", 1.0, 1.0
    cycles.seed = job["seed"]


def render(described, job):
    import bpy
    from worker import Stopwatch
    scene = load(bpy, described, job)
    configure(scene, job)

    def timed(samples, write=False):
        scene.cycles.samples = samples
        watch = Stopwatch()
        bpy.ops.render.render(write_still=write)
        # While the threads of Cycles render, one of Blender can wait for them in a loop, which takes CPU time as well.
        return watch.seconds(), min(watch.cpu_seconds(), job["threads"] * watch.seconds())

    timed(1)  # does the work that only the first render has
    first, samples = timed(1), job.get("samples")
    if not samples:
        count, took = PILOT, timed(PILOT)
        while took[0] - first[0] < job["seconds"] / 8:
            count *= 2
            took = timed(count)
        samples = max(2, round(job["seconds"] * (count - 1) / (took[0] - first[0])))
    whole = timed(samples, write=True)
    seconds, cpu = ((b - a) * samples / (samples - 1) for a, b in zip(first, whole))
    return {"seconds": seconds, "cpu_seconds": cpu, "samples": samples, "version": bpy.app.version_string,
            "settings": {"sampling_pattern": scene.cycles.sampling_pattern}}
