"""Runs tests of the add-on in Blender, in its module bpy or else in the program; builds scenes for them."""

import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import traceback

ROOT = pathlib.Path(__file__).resolve().parents[2]
SKIPPED = 77
SIZE = (48, 32)
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "apps" / "blender"))

# Add-ons of tests are installed here, and those of the user are not loaded.
if "BDPT_TEST_USER" not in os.environ:
    os.environ["BDPT_TEST_USER"] = tempfile.mkdtemp(prefix="bdpt-blender-")
    for kind in ("CONFIG", "SCRIPTS", "EXTENSIONS", "DATAFILES"):
        os.environ[f"BLENDER_USER_{kind}"] = os.path.join(os.environ["BDPT_TEST_USER"], kind.lower())
        os.makedirs(os.environ[f"BLENDER_USER_{kind}"])

try:
    import bpy
except ImportError:
    bpy = None


def run(main):
    """Ends the process with the result of main(BDPT, ADDON). The script's arguments are the command and the archive."""
    if bpy is None:
        blender = shutil.which("blender")
        if blender is None:
            print("skipped: there is neither the Python module bpy nor the program blender")
            sys.exit(SKIPPED)
        script = [blender, "--background", "--factory-startup", "--python", sys.argv[0], "--", *sys.argv[1:]]
        # Debian's Blender takes the Python beside it, unless PATH has another one first.
        path = f"{pathlib.Path(blender).parent}{os.pathsep}{os.environ['PATH']}"
        code = subprocess.run(script, check=False, env={**os.environ, "PATH": path}).returncode
        shutil.rmtree(os.environ["BDPT_TEST_USER"], ignore_errors=True)
        sys.exit(code)
    import bdpt_render
    arguments = (sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else sys.argv[1:])
    os.environ["PATH"] = f"{pathlib.Path(arguments[0]).parent}{os.pathsep}{os.environ['PATH']}"
    try:
        bdpt_render.register()
        code = main(*arguments)
    except BaseException:
        traceback.print_exc()
        code = 1
    shutil.rmtree(os.environ["BDPT_TEST_USER"], ignore_errors=True)
    sys.stdout.flush()
    os._exit(code)  # the module may crash at exit after an operator that failed


def new_scene():
    """Makes a scene with a grey floor, a red ball and a camera, without light."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    bpy.ops.mesh.primitive_plane_add(size=8)
    bpy.context.object.name = "floor"
    paint(bpy.context.object, "grey", (0.5, 0.5, 0.5, 1))
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.7, location=(0, 0, 0.7))
    bpy.context.object.name = "ball"
    paint(bpy.context.object, "red", (0.8, 0.1, 0.1, 1))
    bpy.ops.object.camera_add(location=(0, -5, 2.5), rotation=(math.radians(68), 0, 0))
    scene.camera = bpy.context.object
    scene.render.engine = "BDPT"
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    scene.render.resolution_percentage = 100
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    background(scene).inputs["Strength"].default_value = 0.0
    return scene


def background(scene):
    return scene.world.node_tree.nodes["Background"]


def paint(thing, name, color, light=0.0):
    """Gives an object a diffuse material that emits that radiance."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    shader = material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = color
    shader.inputs["Roughness"].default_value = 1.0
    # Blender 4.0 renamed some inputs.
    socket(shader, "Specular IOR Level", "Specular").default_value = 0.0
    socket(shader, "Emission Color", "Emission").default_value = color
    shader.inputs["Emission Strength"].default_value = light
    thing.data.materials.clear()
    thing.data.materials.append(material)
    return shader


def socket(shader, *names):
    return next(shader.inputs[name] for name in names if name in shader.inputs)


def lamp(kind, energy, **more):
    bpy.ops.object.light_add(type=kind, location=(1.5, -1.5, 3.5), rotation=(math.radians(25), math.radians(20), 0))
    bpy.context.object.data.energy = energy
    for name, value in more.items():
        setattr(bpy.context.object.data, name, value)
    return bpy.context.object


def sky(scene, color=(0.2, 0.4, 0.8, 1), strength=0.7):
    background(scene).inputs["Color"].default_value = color
    background(scene).inputs["Strength"].default_value = strength


def rendered(scene, file):
    """Renders; returns the image [height, width, RGBA], row 0 on top, as Blender writes and reads it."""
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.image_settings.color_mode = "RGBA"
    scene.render.filepath = str(file)
    bpy.ops.render.render(write_still=True)
    return read(file)


def read(file):
    import numpy as np
    image = bpy.data.images.load(str(file))
    image.colorspace_settings.name = "Non-Color"
    image.alpha_mode = "CHANNEL_PACKED"
    values = np.empty(image.size[0] * image.size[1] * image.channels, np.float32)
    image.pixels.foreach_get(values)
    shape = (image.size[1], image.size[0], image.channels)
    bpy.data.images.remove(image)
    return values.reshape(shape)[::-1]
