#!/usr/bin/env python3
"""Tests the engine in Blender: engine_test.py BDPT ADDON.zip. Needs Blender (exits with 77 without it).

Tests that images equal those of the command to the bit, and compares passes, cameras, regions, animations, cancelling
and errors with Blender's own data about the scene.
"""

import contextlib
import io
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from in_blender import ROOT, SIZE, bpy, lamp, new_scene, paint, rendered, run, sky

if bpy:
    import bpy_extras.object_utils
    import mathutils
    import numpy as np
    import bdpt_render
    from bdpt_render import engine, passes
    from bdpt_render.exr import Exr
    from bdpt_render.live_image import LiveImage


def lit_scene(samples=4):
    scene = new_scene()
    lamp("SUN", 3, angle=0.0)
    scene.bdpt.samples = samples
    return scene


@contextlib.contextmanager
def record_passes():
    """Records the pixels of all passes by name, row 0 on top, as Blender's result holds them after each render."""
    found, fill = {}, passes.fill

    def record(result, scene, layer, exr):
        fill(result, scene, layer, exr)
        for item in result.layers[0].passes:
            values = np.array(item.rect, np.float32).reshape(result.resolution_y, result.resolution_x, item.channels)
            found[item.name] = values[::-1]

    passes.fill = record
    try:
        yield found
    finally:
        passes.fill = fill


@contextlib.contextmanager
def kept_image(folder):
    """Makes the command write its image to command.exr in the folder, too."""
    words = engine.denoiser_words
    engine.denoiser_words = lambda scene: [*words(scene), "-o", f"{folder}/command.exr"]
    try:
        yield folder / "command.exr"
    finally:
        engine.denoiser_words = words


def list_passes(scene, folder):
    with record_passes() as found:
        rendered(scene, folder / "passes.exr")
    return found


def catch_render_error(scene, **options):
    """Returns the message of a render that fails."""
    output = io.StringIO()
    try:
        with contextlib.redirect_stderr(output):
            bpy.ops.render.render(**options)
    except RuntimeError as error:
        assert "Traceback" not in str(error) + output.getvalue(), f"a traceback: {error}"
        lines = [line for line in str(error).splitlines() if line]
        assert len(lines) == 1, f"not one line: {lines}"
        return lines[0]
    raise AssertionError("no error")


def test_image_is_that_of_the_command(folder):
    scene = lit_scene()
    with kept_image(folder):
        ours = rendered(scene, folder / "blender.exr")
    import_of_blender = render_by_command(folder / "command.exr")
    assert ours.shape == (SIZE[1], SIZE[0], 4) and ours[..., :3].mean() > 0.1
    assert np.array_equal(ours[..., :3], import_of_blender[..., :3]) and (ours[..., 3] == 1).all()


def render_by_command(file):
    """Renders with the command; reads the image as Blender's own OpenEXR reader does."""
    from in_blender import read
    return read(file)


def test_options_reach_the_command(folder):
    scene = lit_scene()
    scene.bdpt.options = "--seed 7"
    scene.bdpt.integrator, scene.bdpt.max_depth, scene.bdpt.samples = "mis", 3, 5
    with kept_image(folder):
        rendered(scene, folder / "blender.exr")
    said = Exr(folder / "command.exr").texts["bdpt.settings"]
    for words in ('"integrator":"mis"', '"max_depth":3', '"spp":5', '"seed":7'):
        assert words in said, f"{words} is not in {said}"
    # These limits end a render that otherwise would not end.
    scene.bdpt.samples, scene.bdpt.time, scene.bdpt.options = 10**9, 0.3, ""
    rendered(scene, folder / "blender.exr")
    scene.bdpt.time, scene.bdpt.noise = 0.0, 50.0
    rendered(scene, folder / "blender.exr")


def test_passes(folder):
    scene, layer = lit_scene(), bpy.context.view_layer
    for name in ("z", "normal", "position", "cryptomatte_object", "cryptomatte_material"):
        setattr(layer, f"use_pass_{name}", True)
    layer.bdpt.use_pass_denoising_data = True
    with kept_image(folder):
        found = list_passes(scene, folder)
    y, x = 28, 24  # a pixel of the floor in front of the ball
    place = mathutils.Vector([float(value) for value in found["Position"][y, x]])
    assert abs(place.z) < 1e-5 and np.allclose(found["Normal"][y, x], (0, 0, 1), atol=1e-5)
    depth = -(scene.camera.matrix_world.inverted() @ place).z
    assert abs(found["Depth"][y, x, 0] - depth) < 1e-3 and found["Depth"][0, 0, 0] == np.float32(1e10)
    assert np.allclose(found["Denoising Albedo"][y, x], 0.5, atol=1e-5)
    assert np.allclose(found["Denoising Normal"], found["Normal"])
    for kind, names in (("Object", ("floor", "ball")), ("Material", ("grey", "red"))):
        texts = Exr(folder / "command.exr").texts
        key = next(key for key, text in texts.items() if text == f"Crypto{kind}").rpartition("/")[0]
        manifest = eval(texts[f"{key}/manifest"])
        for name, (row, column) in zip(names, ((28, 24), (18, 24))):
            shown = found[f"Crypto{kind}00"][row, column]
            assert shown.view(np.uint32)[0] == int(manifest[name], 16) and shown[1] == 1, f"{kind} {name}: {shown}"
    assert "Noisy Image" not in found


def test_multilayer_file(folder):
    scene, layer = lit_scene(1), bpy.context.view_layer
    layer.use_pass_z = layer.use_pass_cryptomatte_object = True
    if hasattr(scene.render.image_settings, "media_type"):  # since Blender 5.0
        scene.render.image_settings.media_type = "MULTI_LAYER_IMAGE"
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    scene.render.filepath = str(folder / "layers.exr")
    bpy.ops.render.render(write_still=True)
    data = (folder / "layers.exr").read_bytes()
    for words in ("Combined.R", "Depth.Z", "CryptoObject02.r", "MurmurHash3_32", '"ball":'):
        assert words.encode() in data, f"{words} is not in the file"
    assert re.search(f"{layer.name}[.]CryptoObject(?![0-9])".encode(), data), "the mattes have not the name of the layer"


def test_cryptomatte_node(folder):
    """Tests that Blender's own node finds an object by its name."""
    scene = lit_scene()
    if not (4, 0, 0) <= bpy.app.version < (5, 0, 0):
        print("  not tested: compositors of other versions of Blender are set up in other ways")
        return
    bpy.context.view_layer.use_pass_cryptomatte_object = True
    scene.use_nodes = True
    nodes = scene.node_tree.nodes
    nodes.clear()
    matte, output = nodes.new("CompositorNodeCryptomatteV2"), nodes.new("CompositorNodeComposite")
    matte.scene, matte.layer_name, matte.matte_id = scene, f"{bpy.context.view_layer.name}.CryptoObject", "ball"
    scene.node_tree.links.new(matte.outputs["Matte"], output.inputs["Image"])
    image = rendered(scene, folder / "matte.exr")
    assert image[18, 24, 0] == 1 and image[28, 24, 0] == 0


def test_denoising(folder):
    if engine.denoiser_of_blender() is None:
        print("  not tested: Blender has no Open Image Denoise 2")
        return
    scene = lit_scene(1)
    sky(scene)
    bpy.context.view_layer.bdpt.use_pass_denoising_data = scene.bdpt.denoise = True
    found = list_passes(scene, folder)
    rough = lambda image: np.abs(np.diff(image[24:, :, 1], axis=1)).mean()
    assert rough(found["Combined"]) < 0.5 * rough(found["Noisy Image"])


def assert_camera_agrees(scene, folder, name):
    """Tests that points that pixels show are where Blender projects them."""
    bpy.context.view_layer.use_pass_position = True
    scene.bdpt.samples = 1
    found = list_passes(scene, folder)["Position"]
    width, height = scene.render.resolution_x, scene.render.resolution_y
    left, top = 0, 0
    if scene.render.use_border:
        left = int(scene.render.border_min_x * width)
        top = height - int(scene.render.border_max_y * height)
    errors = []
    for y in range(found.shape[0]):
        for x in range(found.shape[1]):
            if np.any(found[y, x] != 0.0):
                place = bpy_extras.object_utils.world_to_camera_view(scene, scene.camera, mathutils.Vector(found[y, x]))
                errors.append((place.x * width - (x + left + 0.5), (1.0 - place.y) * height - (y + top + 0.5)))
    assert len(errors) > 100, f"{name}: {len(errors)} points"
    mean, worst = np.mean(errors, axis=0), np.abs(errors).max()
    # A sample lies anywhere in its pixel; shifts are rounded to pixels.
    assert np.abs(mean).max() < 0.1 and worst < 0.6, f"{name}: off by {mean}, at most {worst}"


def test_cameras(folder):
    def change(scene, **values):
        for name, value in values.items():
            setattr(scene.camera.data, name, value)

    for name, edit in {
            "perspective": lambda scene: None,
            "sensor, height": lambda scene: change(scene, sensor_fit="VERTICAL", sensor_height=20, lens=35),
            "upright": lambda scene: setattr(scene.render, "resolution_x", 20),
            "width of an upright image": lambda scene: (setattr(scene.render, "resolution_x", 20),
                                                        change(scene, sensor_fit="HORIZONTAL")),
            "orthographic": lambda scene: change(scene, type="ORTHO", ortho_scale=5.0),
            "shifted": lambda scene: change(scene, shift_x=0.25, shift_y=-0.125),
            "orthographic, shifted": lambda scene: change(scene, type="ORTHO", ortho_scale=5.0, shift_x=-0.25, shift_y=0.125),
            "scaled": lambda scene: setattr(scene.camera, "scale", (2, 2, 2)),
            "border": lambda scene: border(scene), "border, shifted": lambda scene: (border(scene), change(scene, shift_x=0.25)),
    }.items():
        scene = lit_scene()
        edit(scene)
        bpy.context.view_layer.update()
        assert_camera_agrees(scene, folder, name)


def border(scene):
    render = scene.render
    render.use_border = render.use_crop_to_border = True
    render.border_min_x, render.border_max_x, render.border_min_y, render.border_max_y = 0.21, 0.74, 0.13, 0.68


def test_regions(folder):
    scene = lit_scene()
    whole = rendered(scene, folder / "whole.exr")
    border(scene)
    region = rendered(scene, folder / "region.exr")
    rows, columns = slice(32 - 21, 32 - 4), slice(10, 35)
    assert np.array_equal(region, whole[rows, columns]), region.shape
    scene.render.use_crop_to_border = False
    framed = rendered(scene, folder / "framed.exr")
    assert framed.shape == whole.shape and np.array_equal(framed[rows, columns], region) and framed[0, 0, 0] == 0
    scene.render.use_border, scene.render.resolution_percentage = False, 55
    assert rendered(scene, folder / "small.exr").shape[:2] == (17, 26)


def test_transparent_film(folder):
    scene = lit_scene()
    sky(scene)
    assert (rendered(scene, folder / "opaque.exr")[..., 3] == 1).all()
    scene.render.film_transparent = True
    alpha = rendered(scene, folder / "film.exr")[..., 3]
    assert alpha[0].max() == 0 and alpha[18, 24] == 1


def find_shown_names(scene, folder):
    """Returns the names of visible objects, from their mattes."""
    bpy.context.view_layer.use_pass_cryptomatte_object = True
    with kept_image(folder):
        ids = list_passes(scene, folder)["CryptoObject00"].view(np.uint32)[..., 0]
    texts = Exr(folder / "command.exr").texts
    manifest = eval(next(text for key, text in texts.items() if key.endswith("/manifest")))
    return {name for name, value in manifest.items() if (ids == int(value, 16)).any()}


def test_what_is_shown(folder):
    """Tests objects that only renders show, and instances; and that the scene is unchanged afterwards."""
    scene = lit_scene()
    for number, name in enumerate(("hidden", "hidden in views", "excluded", "instanced")):
        bpy.ops.mesh.primitive_cube_add(size=0.5, location=(number - 1.5, -1.5, 0.25))
        bpy.context.object.name = name
    bpy.data.objects["hidden"].hide_render = True
    bpy.data.objects["hidden in views"].hide_viewport = True
    for name in ("excluded", "instanced"):
        collection = bpy.data.collections.new(name)
        collection.objects.link(bpy.data.objects[name])
        scene.collection.objects.unlink(bpy.data.objects[name])
        if name == "excluded":
            scene.collection.children.link(collection)
            bpy.context.view_layer.layer_collection.children[name].exclude = True
    empty = bpy.data.objects.new("empty", None)
    empty.instance_type, empty.instance_collection = "COLLECTION", bpy.data.collections["instanced"]
    scene.collection.objects.link(empty)
    kinds = ("objects", "meshes", "materials", "scenes", "images", "cameras", "lights", "collections")
    before = {kind: sorted(getattr(bpy.data, kind).keys()) for kind in kinds}
    shown = find_shown_names(scene, folder)
    assert shown == {"floor", "ball", "hidden in views", "instanced"}, shown
    after = {kind: sorted(getattr(bpy.data, kind).keys()) for kind in kinds}
    after["images"] = [name for name in after["images"] if name != "Render Result"]
    assert after == before, f"{before} became {after}"


def test_view_layers(folder):
    """Tests that each view layer has its own image: the second one lacks the ball."""
    scene = lit_scene()
    collection = bpy.data.collections.new("of the ball")
    scene.collection.children.link(collection)
    scene.collection.objects.unlink(bpy.data.objects["ball"])
    collection.objects.link(bpy.data.objects["ball"])
    scene.view_layers.new("second").layer_collection.children["of the ball"].exclude = True
    images, fill = {}, passes.fill

    def record(result, scene, layer, exr):
        fill(result, scene, layer, exr)
        images[layer.name] = exr.pixels("RGB")

    passes.fill = record
    try:
        rendered(scene, folder / "image.exr")
    finally:
        passes.fill = fill
    is_red = {name: bool((image[..., 0] > 2 * image[..., 1]).any()) for name, image in images.items()}
    assert is_red == {scene.view_layers[0].name: True, "second": False}, is_red


def test_modifiers_of_renders(folder):
    scene = lit_scene()
    array = bpy.data.objects["ball"].modifiers.new("array", "ARRAY")
    array.show_viewport, array.show_render, array.count = False, True, 2
    bpy.context.view_layer.use_pass_position = True
    # The image is twice as wide, though the viewport shows one ball.
    assert list_passes(scene, folder)["Position"][18, :, 0].max() > 1.5


def test_animation(folder):
    """Tests a moving ball that changes its colour; the scene stays at its frame."""
    scene = lit_scene()
    ball = bpy.data.objects["ball"]
    color = ball.active_material.node_tree.nodes["Principled BSDF"].inputs["Base Color"]
    for frame, x, green in ((1, -1, 0.0), (3, 1, 1.0)):
        ball.location.x, color.default_value = x, (0, green, 0, 1)
        ball.keyframe_insert("location", frame=frame)
        color.keyframe_insert("default_value", frame=frame)
    scene.frame_set(1)
    scene.frame_end = 3
    bpy.context.view_layer.use_pass_cryptomatte_object = True
    bpy.context.view_layer.bdpt.use_pass_denoising_data = True
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.filepath = str(folder / "frame.")
    found, all_found = {}, []
    with record_passes() as found:
        end = call_after_frames(scene, lambda: all_found.append(dict(found)))
        bpy.ops.render.render(animation=True)
        end()
    assert sorted(file.name for file in folder.glob("frame.*")) == [f"frame.{n:04d}.exr" for n in (1, 2, 3)]
    places, greens = [], []
    for frame in all_found:
        is_ball = frame["Denoising Albedo"][..., 0] == 0
        is_ball &= np.isfinite(frame["Denoising Albedo"][..., 1]) & (frame["CryptoObject00"][..., 1] == 1)
        places.append(np.nonzero(is_ball)[1].mean() + 0.5)
        greens.append(frame["Denoising Albedo"][is_ball][:, 1].mean())
    assert len(places) == 3 and places[0] < 18 and abs(places[1] - 24) < 0.6 and places[2] > 30, places
    assert np.allclose(greens, (0, 0.5, 1), atol=0.02), greens
    assert scene.frame_current == 1
    scene.render.use_motion_blur, scene.camera.data.type = True, "PANO"
    catch_render_error(scene)
    assert scene.frame_current == 1 and scene.frame_subframe == 0, "an error leaves the scene at another frame"


def call_after_frames(scene, function):
    """Calls function() after each frame, until the returned function is called."""
    handler = lambda *_: function()
    bpy.app.handlers.render_post.append(handler)
    return lambda: bpy.app.handlers.render_post.remove(handler)


def test_cancelling(folder):
    """Tests that an endless render ends when Blender reports that the user cancels, and keeps its image."""
    scene = lit_scene(10**9)
    asked = []
    cancelled = engine.BDPT_RenderEngine._cancelled
    engine.BDPT_RenderEngine._cancelled = lambda self: asked.append(True) or len(asked) > 5
    try:
        found = list_passes(scene, folder)
    finally:
        engine.BDPT_RenderEngine._cancelled = cancelled
    assert found["Combined"][..., :3].mean() > 0.1


def test_errors(folder):
    scene = lit_scene()
    scene.bdpt.options = "--spp nonsense"
    assert "nonsense" in catch_render_error(scene)
    scene.bdpt.options = "--seed '1"
    assert "Options" in catch_render_error(scene)
    for options in ("--denoise --denoiser-library evil.so", "--ktx-library evil.so", "--display localhost", f"--stats {folder}/x"):
        scene.bdpt.options = options
        assert "job" in catch_render_error(scene) and not (folder / "x").exists()
    scene.bdpt.options = ""
    scene.camera.data.type = "PANO"
    assert "panoramic" in catch_render_error(scene)
    scene.camera.data.type = "PERSP"
    path, os.environ["PATH"] = os.environ["PATH"], ""
    try:
        assert "not found" in catch_render_error(scene) and "Preferences" in catch_render_error(scene)
        scene.render.filepath, scene.frame_end = str(folder / "failed."), 3
        catch_render_error(scene, animation=True)
    finally:
        os.environ["PATH"] = path
    assert not list(folder.glob("failed.*")), "an image of a failed render"
    chosen, engine.settings.chosen_command = engine.settings.chosen_command, lambda: str(folder / "gone")
    try:
        assert f"{folder}/gone" in catch_render_error(scene)
    finally:
        engine.settings.chosen_command = chosen
    scene.camera = None
    assert "camera" in catch_render_error(scene)


def test_warnings(folder):
    """Tests that features that bdpt ignores are reported, once."""
    scene = lit_scene(1)
    said = []
    report = engine.BDPT_RenderEngine.report_to_user
    engine.BDPT_RenderEngine.report_to_user = lambda self, kind, text: said.append(text) if kind == "WARNING" else None
    ball = bpy.data.objects["ball"]
    ball.shape_key_add(name="Basis")
    key = ball.shape_key_add(name="wide")
    for point in key.data:
        point.co.x *= 2
    for frame, value in ((0, 0.0), (2, 1.0)):
        key.value = value
        key.keyframe_insert("value", frame=frame)
    bpy.ops.object.volume_add()
    bpy.context.object.name = "smoke"
    lamp("SUN", 1, angle=0.5).name = "wide sun"
    nodes, links = scene.world.node_tree.nodes, scene.world.node_tree.links
    texture, mapping = nodes.new("ShaderNodeTexEnvironment"), nodes.new("ShaderNodeMapping")
    texture.image = bpy.data.images.new("sky", 4, 2, float_buffer=True)
    mapping.inputs["Rotation"].default_value[0] = 0.5
    links.new(mapping.outputs["Vector"], texture.inputs["Vector"])
    links.new(texture.outputs["Color"], nodes["Background"].inputs["Color"])
    scene.render.use_motion_blur, scene.render.pixel_aspect_x = True, 2.0
    scene.frame_set(1)
    try:
        rendered(scene, folder / "image.exr")
    finally:
        engine.BDPT_RenderEngine.report_to_user = report
    for words in ('"ball": its motion', '"smoke"', "wide sun", "pixel aspect", "turned about z only"):
        assert len([text for text in said if words in text]) == 1, f"{words}: {said}"


def test_live_image(folder):
    """Tests that the last image shown is the one that is written."""
    live = LiveImage()
    try:
        subprocess.run(["bdpt", "render", "scenes/cornell-box.gltf", "--size", "40x30", "--crop", "5,2,33,21", "--spp", "16",
                        "-o", str(folder / "live.exr"), "--display", live.address, "--quiet"], check=True)
        exr = Exr(folder / "live.exr")
        written = exr.pixels(("R", "G", "B"))
        assert (exr.x, exr.y) == (5, 2)
        latest = time.monotonic() + 60
        while time.monotonic() < latest:
            shown = live.take()
            if shown is not None and np.array_equal(shown[2:21, 5:33], written):
                assert shown.shape == (30, 40, 3)
                return
            time.sleep(0.05)
        raise AssertionError("the last image never came")
    finally:
        live.close()


def test_half_files(folder):
    """Tests that the OpenEXR reader supports half floats and uncompressed chunks, as Blender's own does."""
    scene = lit_scene(1)
    scene.bdpt.options = "--half"
    with kept_image(folder):
        rendered(scene, folder / "blender.exr")
    ours = Exr(folder / "command.exr")
    assert ours.channels["R"].dtype == np.float16
    assert np.array_equal(ours.pixels("RGB"), render_by_command(folder / "command.exr")[..., :3])


def test_registration(folder):
    panel = bpy.types.EEVEE_MATERIAL_PT_surface
    for name in ("EEVEE_MATERIAL_PT_surface", "EEVEE_WORLD_PT_surface", "DATA_PT_EEVEE_light", "DATA_PT_lens", "RENDER_PT_output"):
        assert "BDPT" in getattr(bpy.types, name).COMPAT_ENGINES, name
    bdpt_render.unregister()
    assert "BDPT" not in panel.COMPAT_ENGINES and not hasattr(bpy.types.Scene, "bdpt")
    bdpt_render.register()


def install_addon(archive):
    """Installs and enables the add-on as users do; returns the name of its package."""
    if bpy.app.version < (4, 2, 0):
        bpy.ops.preferences.addon_install(filepath=archive)
        bpy.ops.preferences.addon_enable(module="bdpt_render")
        return "bdpt_render"
    bpy.ops.extensions.package_install_files(repo="user_default", filepath=archive, enable_on_install=True)
    return "bl_ext.user_default.bdpt_render"


def test_installation(folder):
    """Tests that the installed archive renders with the command in its preferences. Runs last, because it replaces the
    add-on."""
    scene = new_scene()  # first, because it resets preferences
    bdpt_render.unregister()
    for name in [name for name in sys.modules if name.startswith("bdpt_render")]:
        del sys.modules[name]
    sys.path.remove(str(ROOT / "apps" / "blender"))
    package = install_addon(archive)
    scene.render.engine = "BDPT"
    sky(scene)
    path, os.environ["PATH"] = os.environ["PATH"], ""
    try:
        assert "not found" in catch_render_error(scene)
        bpy.context.preferences.addons[package].preferences.command = program
        scene.bdpt.samples = 1
        assert rendered(scene, folder / "image.exr")[..., 2].mean() > 0.1
    finally:
        os.environ["PATH"] = path
    assert "/bdpt-blender-" in sys.modules[package].__file__, sys.modules[package].__file__


def main(command, addon):
    global program, archive
    program, archive = command, addon
    os.chdir(pathlib.Path(__file__).resolve().parents[2])
    faults = 0
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            with tempfile.TemporaryDirectory() as folder:
                start = time.monotonic()
                try:
                    test(pathlib.Path(folder))
                    fault = ""
                except Exception as error:
                    fault = f": {type(error).__name__} in line {error.__traceback__.tb_next.tb_lineno}: {error}"
                    faults += 1
            print(f"{'FAILED' if fault else 'passed'} {name} ({time.monotonic() - start:.1f} s){fault}", flush=True)
    return 1 if faults else 0


if __name__ == "__main__":
    run(main)
