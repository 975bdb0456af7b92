"""The scene as a GLB file, and the options of bdpt render that say the rest."""

import contextlib
import math
import pathlib

import bpy

from . import world


def export_scene(context, folder):
    """Words for bdpt render, and what the image will lack. Writes into `folder`."""
    scene = context.scene
    if scene.camera is None:
        raise RuntimeError("the scene has no camera")
    file = pathlib.Path(folder, "scene.glb")
    environment, warnings = world.environment_words(scene.world, folder)
    with lamps_as_meshes(context):
        bpy.ops.export_scene.gltf(
            filepath=str(file), export_format="GLB", use_renderable=True, use_active_scene=True, export_cameras=True,
            export_lights=True, export_apply=True, export_animations=False, export_yup=True,
            # Radiometric, as emission and the world are: no factor of 683 lm/W on lamps alone.
            export_import_convert_lighting_mode="COMPAT")
    render = scene.render
    scale = render.resolution_percentage / 100
    size = f"{max(1, round(render.resolution_x * scale))}x{max(1, round(render.resolution_y * scale))}"
    camera = scene.camera.data
    words = [str(file), "--camera", scene.camera.name, "--size", size, *environment]
    if camera.type == "PERSP":
        words += ["--fov", f"{math.degrees(vertical_fov(camera, render)):.9g}"]
        if camera.dof.use_dof:
            # f-number and focal length [mm] to the radius of the lens [m].
            words += ["--lens-radius", f"{camera.lens / camera.dof.aperture_fstop / 2000:.9g}",
                      "--focus-distance", f"{focus_distance(scene.camera):.9g}"]
    elif camera.type == "PANO":
        raise RuntimeError("bdpt has no panoramic cameras")
    return words, warnings


def vertical_fov(camera, render):
    """[rad] Sensors fit the longer side unless the camera says which."""
    width, height = render.resolution_x * render.pixel_aspect_x, render.resolution_y * render.pixel_aspect_y
    horizontal = camera.sensor_fit == "HORIZONTAL" or (camera.sensor_fit == "AUTO" and width >= height)
    sensor = camera.sensor_height if camera.sensor_fit == "VERTICAL" else camera.sensor_width
    side = sensor * (height / width if horizontal else 1.0)
    return 2.0 * math.atan(side / 2.0 / camera.lens)


def focus_distance(camera):
    target = camera.data.dof.focus_object
    if target is None:
        return camera.data.dof.focus_distance
    to_target = camera.matrix_world.inverted() @ target.matrix_world.translation
    return -to_target.z


@contextlib.contextmanager
def lamps_as_meshes(context):
    """glTF has no area lamps: while this lasts, each has a mesh that shines as it does."""
    added = [shining_mesh(context, lamp) for lamp in context.scene.objects
             if lamp.type == "LIGHT" and lamp.data.type == "AREA" and not lamp.hide_render]
    try:
        yield
    finally:
        for thing in added:
            mesh, material = thing.data, thing.data.materials[0]
            bpy.data.objects.remove(thing)
            bpy.data.meshes.remove(mesh)
            bpy.data.materials.remove(material)


def shining_mesh(context, lamp):
    light = lamp.data
    width = light.size
    height = light.size_y if light.shape in ("RECTANGLE", "ELLIPSE") else width
    round_ = light.shape in ("DISK", "ELLIPSE")
    count = 64 if round_ else 4
    start = 0.0 if round_ else math.pi / 4.0
    reach = 0.5 if round_ else math.sqrt(0.5)
    # Clockwise as seen from +z: it shines along -z, as lamps do.
    angles = [start - 2.0 * math.pi * i / count for i in range(count)]
    points = [(reach * width * math.cos(a), reach * height * math.sin(a), 0.0) for a in angles]
    mesh = bpy.data.meshes.new(lamp.name)
    mesh.from_pydata(points, [], [list(range(count))])
    area = width * height * (math.pi / 4.0 if round_ else 1.0)
    mesh.materials.append(shining_material(lamp.name, light.color, light.energy / math.pi / area))
    thing = bpy.data.objects.new(lamp.name, mesh)
    thing.matrix_world = lamp.matrix_world
    context.scene.collection.objects.link(thing)
    return thing


def shining_material(name, color, strength):
    """Black, one-sided, of that radiance [W/(m^2 sr)]."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    material.use_backface_culling = True
    shader = material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (0.0, 0.0, 0.0, 1.0)
    shader.inputs["Specular IOR Level"].default_value = 0.0
    shader.inputs["Emission Color"].default_value = (*color, 1.0)
    shader.inputs["Emission Strength"].default_value = strength
    return material
