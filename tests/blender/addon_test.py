#!/usr/bin/env python3
"""The add-on in Blender, without a window: addon_test.py BDPT. Needs the module bpy (exit code 77 without).

Renders small scenes with lamps of every kind by Cycles and by bdpt, and compares their means.
"""

import math
import os
import pathlib
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "apps" / "blender"))

try:
    import bpy
except ImportError:
    print("skipped: there is no module bpy")
    sys.exit(77)

import numpy as np

import bdpt_render

SIZE = (48, 32)
# Noise of the mean of so many pixels, and BSDFs that are not quite the same.
CLOSE = 0.03


def new_scene():
    """A grey floor and a red ball."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    bpy.ops.mesh.primitive_plane_add(size=8)
    paint(bpy.context.object, (0.5, 0.5, 0.5, 1))
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.7, location=(0, 0, 0.7))
    paint(bpy.context.object, (0.8, 0.1, 0.1, 1))
    bpy.ops.object.camera_add(location=(0, -5, 2.5), rotation=(math.radians(68), 0, 0))
    scene.camera = bpy.context.object
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    scene.render.resolution_percentage = 100
    scene.cycles.use_denoising = False
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.0
    return scene


def paint(thing, color):
    material = bpy.data.materials.new("paint")
    material.use_nodes = True
    shader = material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = color
    shader.inputs["Roughness"].default_value = 1.0
    # Blender 4.0 renamed it.
    specular = "Specular IOR Level" if "Specular IOR Level" in shader.inputs else "Specular"
    shader.inputs[specular].default_value = 0.0
    thing.data.materials.append(material)


def lamp(kind, energy, **more):
    bpy.ops.object.light_add(type=kind, location=(1.5, -1.5, 3.5), rotation=(math.radians(25), math.radians(20), 0))
    bpy.context.object.data.energy = energy
    for name, value in more.items():
        setattr(bpy.context.object.data, name, value)


def sky(scene, color=(0.2, 0.4, 0.8, 1), strength=0.7):
    background = scene.world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = color
    background.inputs["Strength"].default_value = strength


def sky_image(scene, turned=0.0):
    """Bright in one direction, to see that it is turned as in Cycles."""
    nodes, links = scene.world.node_tree.nodes, scene.world.node_tree.links
    image = bpy.data.images.new("sky", 64, 32, float_buffer=True)
    pixels = np.full((32, 64, 4), 0.1, np.float32)
    pixels[18:26, 40:48, :3] = (20, 10, 5)  # row 0 is the bottom one
    image.pixels.foreach_set(pixels.ravel())
    image.pack()
    texture, mapping, place = (nodes.new(kind) for kind in ("ShaderNodeTexEnvironment", "ShaderNodeMapping", "ShaderNodeTexCoord"))
    texture.image = image
    mapping.inputs["Rotation"].default_value[2] = turned
    links.new(place.outputs["Generated"], mapping.inputs["Vector"])
    links.new(mapping.outputs["Vector"], texture.inputs["Vector"])
    links.new(texture.outputs["Color"], nodes["Background"].inputs["Color"])
    nodes["Background"].inputs["Strength"].default_value = 1.0


def pixels_of(image):
    values = np.empty(image.size[0] * image.size[1] * image.channels, np.float32)
    image.pixels.foreach_get(values)
    return values.reshape(image.size[1], image.size[0], image.channels)[::-1, :, :3]


def by_cycles(scene, folder):
    scene.render.engine = "CYCLES"
    scene.cycles.device, scene.cycles.samples, scene.cycles.use_adaptive_sampling = "CPU", 128, False
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.filepath = str(folder / "cycles.exr")
    bpy.ops.render.render(write_still=True)
    return pixels_of(bpy.data.images.load(scene.render.filepath))


def by_bdpt(scene):
    scene.bdpt.samples, scene.bdpt.options = 128, "--max-depth 12"
    assert bpy.ops.render.bdpt() == {"FINISHED"}
    return pixels_of(bpy.data.images["bdpt"])


CASES = {
    "point": lambda scene: lamp("POINT", 300, shadow_soft_size=0.2),
    "spot": lambda scene: lamp("SPOT", 600, shadow_soft_size=0.2, spot_size=math.radians(60), spot_blend=0.0),
    "sun": lambda scene: lamp("SUN", 3, angle=0.0),
    "area": lambda scene: lamp("AREA", 200, size=1.0, shape="SQUARE"),
    "ellipse": lambda scene: lamp("AREA", 200, size=1.5, size_y=0.5, shape="ELLIPSE"),
    "colour of the sky": sky,
    "image of the sky": sky_image,
    "image of the sky, turned": lambda scene: sky_image(scene, math.radians(70)),
}


def main():
    bdpt_render.register()
    bdpt_render.program_of = lambda context: sys.argv[1]
    faults = []
    with tempfile.TemporaryDirectory() as folder:
        for name, light in CASES.items():
            scene = new_scene()
            light(scene)
            theirs, ours = by_cycles(scene, pathlib.Path(folder)), by_bdpt(scene)
            objects = [thing.name for thing in scene.objects if thing.type == "MESH"]
            if len(objects) != 2:
                faults.append(f"{name}: meshes were left behind: {objects}")
            # Quarters, so that a turned or mirrored image is found out.
            halves = [(slice(0, 16), slice(0, 24)), (slice(0, 16), slice(24, 48)), (slice(16, 32), slice(0, 24)),
                      (slice(16, 32), slice(24, 48))]
            ratios = [float(ours[part].mean() / max(theirs[part].mean(), 1e-6)) for part in halves]
            whole = float(ours.mean() / theirs.mean())
            print(f"{name}: bdpt / Cycles {whole:.4f}, quarters {', '.join(f'{r:.3f}' for r in ratios)}", flush=True)
            if abs(whole - 1) > CLOSE or max(abs(r - 1) for r in ratios) > 3 * CLOSE:
                faults.append(f"{name}: {whole}, {ratios}")
        scene = new_scene()
        scene.bdpt.options = "--spp nonsense"
        try:
            bpy.ops.render.bdpt()
            faults.append("a wrong option is no error")
        except RuntimeError as error:
            if "nonsense" not in str(error):
                faults.append(f"the error is {error}")
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    code = main()
    sys.stdout.flush()
    os._exit(code)  # the module crashes when it is taken down after an operator that failed
