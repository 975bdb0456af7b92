#!/usr/bin/env python3
"""Tests that the engine agrees with Cycles: cycles_test.py BDPT. Needs Blender (exits with 77 without it).

Renders small scenes with lamps of every kind, skies, depth of field and motion blur with both, and compares means.
"""

import math
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from in_blender import SKIPPED, background, bpy, lamp, new_scene, paint, rendered, run, sky, socket

if bpy:
    from bdpt_render import meshes
    make_glass_solid = meshes.make_glass_solid

# Allows for the noise of the mean of so many pixels, and for slightly different BSDFs.
CLOSE = 0.03


def sky_image(scene, turned=0.0):
    """Returns a sky that is bright in one direction, so that a wrong rotation shows."""
    import numpy as np
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
    links.new(texture.outputs["Color"], background(scene).inputs["Color"])
    background(scene).inputs["Strength"].default_value = 1.0


def scaled_area():
    lamp("AREA", 200, size=1.0, shape="SQUARE").scale = (2, 0.5, 1)


def lamp_with_nodes():
    light = lamp("POINT", 100, shadow_soft_size=0.2).data
    light.use_nodes = True
    light.node_tree.nodes["Emission"].inputs["Strength"].default_value = 3.0
    light.node_tree.nodes["Emission"].inputs["Color"].default_value = (1, 0.5, 0.25, 1)


def glass(scene, on):
    """Adds a ball that refracts as a solid body; without `on`, a sheet that does not refract."""
    sky(scene)
    meshes.make_glass_solid = make_glass_solid if on else lambda glb: None
    shader = paint(bpy.data.objects["ball"], "glass", (1, 1, 1, 1))
    shader.inputs["Roughness"].default_value = 0.0
    socket(shader, "Specular IOR Level", "Specular").default_value = 0.5
    socket(shader, "Transmission Weight", "Transmission").default_value = 1.0
    bpy.data.objects["ball"].data.polygons.foreach_set("use_smooth", [True] * len(bpy.data.objects["ball"].data.polygons))


CASES = {
    "point": lambda scene: lamp("POINT", 300, shadow_soft_size=0.2),
    "point with nodes": lambda scene: lamp_with_nodes(),
    "spot": lambda scene: lamp("SPOT", 600, shadow_soft_size=0.2, spot_size=math.radians(60), spot_blend=0.0),
    "spot with a soft edge": lambda scene: lamp("SPOT", 600, shadow_soft_size=0.2, spot_size=math.radians(60), spot_blend=0.8),
    "sun": lambda scene: lamp("SUN", 3, angle=0.0),
    "area": lambda scene: lamp("AREA", 200, size=1.0, shape="SQUARE"),
    "area, scaled": lambda scene: scaled_area(),
    "ellipse": lambda scene: lamp("AREA", 200, size=1.5, size_y=0.5, shape="ELLIPSE"),
    "colour of the sky": sky,
    "image of the sky": sky_image,
    "image of the sky, turned": lambda scene: sky_image(scene, math.radians(70)),
}


def shining_ball(scene):
    bpy.data.objects["ball"].scale = (0.4, 0.4, 0.4)
    paint(bpy.data.objects["ball"], "lamp", (1, 1, 1, 1), light=20.0)


def depth_of_field(scene, on):
    shining_ball(scene)
    dof = scene.camera.data.dof
    dof.use_dof, dof.focus_distance, dof.aperture_fstop = on, 1.2, 0.06


def motion_blur(scene, on):
    """Moves the ball to the right while the camera turns."""
    shining_ball(scene)
    ball = bpy.data.objects["ball"]
    for frame, x, turn in ((0, -2, 0.1), (2, 2, -0.1)):
        ball.location.x = x
        ball.keyframe_insert("location", frame=frame)
        scene.camera.rotation_euler.z = turn
        scene.camera.keyframe_insert("rotation_euler", frame=frame)
    scene.frame_set(1)
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = on, 1.0


PLACES = {"glass": glass, "depth of field": depth_of_field, "motion blur": motion_blur}


def render_by_cycles(scene, folder):
    scene.render.engine = "CYCLES"
    scene.cycles.device, scene.cycles.samples, scene.cycles.use_adaptive_sampling = "CPU", 128, False
    scene.cycles.use_denoising = False
    return rendered(scene, folder / "cycles.exr")[..., :3]


def render_by_bdpt(scene, folder):
    scene.render.engine = "BDPT"
    scene.bdpt.samples = 128
    return rendered(scene, folder / "bdpt.exr")[..., :3]


def average_blocks(image, columns, rows):
    """Returns the means of columns x rows blocks."""
    height, width = image.shape[0] // rows, image.shape[1] // columns
    return image.mean(axis=-1).reshape(rows, height, columns, width).mean(axis=(1, 3))


def compare(name, light, folder):
    """Compares means of the whole image, and of its quarters, so that a rotated or mirrored image is detected."""
    scene = new_scene()
    light(scene)
    theirs, ours = render_by_cycles(scene, folder), render_by_bdpt(scene, folder)
    whole = float(ours.mean() / theirs.mean())
    ratios = (average_blocks(ours, 2, 2) / average_blocks(theirs, 2, 2).clip(1e-6)).ravel()
    print(f"{name}: bdpt / Cycles {whole:.4f}, quarters {', '.join(f'{ratio:.3f}' for ratio in ratios)}", flush=True)
    if abs(whole - 1) > CLOSE or abs(ratios - 1).max() > 3 * CLOSE:
        yield f"{name}: {whole}, {ratios}"


def compare_places(name, place, folder):
    """Compares where the light is, by blocks of 4 x 4 pixels; the tested feature moves it."""
    images = []
    for render, on in ((render_by_cycles, True), (render_by_bdpt, True), (render_by_bdpt, False)):
        scene = new_scene()
        place(scene, on)
        images.append(average_blocks(render(scene, folder), 12, 8))
    theirs, ours, sharp = images
    error, without = (abs(image - theirs).sum() / theirs.sum() for image in (ours, sharp))
    print(f"{name}: differs from Cycles by {error:.3f}, without it by {without:.3f}", flush=True)
    if error > 0.1 or without < 2 * error:
        yield f"{name}: {error}, {without}"


def main(program, archive=None):
    if bpy.app.version < (4, 0, 0):
        print("skipped: before Blender 4 diffuse surfaces and area lamps of Cycles are others")
        return SKIPPED
    faults = []
    with tempfile.TemporaryDirectory() as folder:
        for name, light in CASES.items():
            faults += compare(name, light, pathlib.Path(folder))
        for name, place in PLACES.items():
            faults += compare_places(name, place, pathlib.Path(folder))
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    run(main)
