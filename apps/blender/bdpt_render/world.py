"""Converts the world of a scene to an environment of bdpt."""

import math
import pathlib
import struct

import bpy


def environment_words(world, folder):
    """Returns the options of `bdpt render` and warnings about what is lost."""
    if world is None:
        return ["--env", "none"], []
    if not world.use_nodes:
        return write_constant(world.color, 1.0, folder), []
    output = next((node for node in world.node_tree.nodes if node.type == "OUTPUT_WORLD" and node.is_active_output), None)
    links = output.inputs["Surface"].links if output else ()
    if not links:
        return ["--env", "none"], []
    background = links[0].from_node
    if background.type != "BACKGROUND":
        return ["--env", "none"], [f"the world is black: bdpt does not know its node {background.name}"]
    color, strength = background.inputs["Color"], background.inputs["Strength"]
    if strength.links:
        return ["--env", "none"], ["the world is black: its strength is not a number"]
    if not color.links:
        return write_constant(color.default_value[:3], strength.default_value, folder), []
    texture = color.links[0].from_node
    if texture.type != "TEX_ENVIRONMENT" or texture.image is None or texture.projection != "EQUIRECTANGULAR":
        return ["--env", "none"], [f"the world is black: its colour is no equirectangular image ({texture.name})"]
    file = save_image(texture.image, folder)
    # The centre of the image lies along +x in Blender and along -z in bdpt. A Mapping node rotates the lookup
    # direction, so the image turns the other way.
    rotation, warnings = find_rotation(texture)
    turn = -90.0 - math.degrees(rotation)
    intensity = strength.default_value * read_exposure(file)
    return ["--env", str(file), "--env-intensity", f"{intensity:.9g}", "--env-rotation", f"{turn:.9g}"], warnings


def find_rotation(texture):
    """Returns the rotation [rad] about the vertical axis by a Mapping node before the texture, and warnings."""
    links = texture.inputs["Vector"].links
    mapping = links[0].from_node if links else None
    if mapping is None or mapping.type == "TEX_COORD":
        return 0.0, []
    if mapping.type != "MAPPING":
        return 0.0, [f"the world is not turned: bdpt does not know the node {mapping.name} before its image"]
    x, y, z = mapping.inputs["Rotation"].default_value
    only_turned = x == y == 0.0 and tuple(mapping.inputs["Scale"].default_value) == (1.0, 1.0, 1.0)
    return z, [] if only_turned else [f"the world is turned about z only (node {mapping.name})"]


def read_exposure(file):
    """Returns the exposure factor of a Radiance HDR file: bdpt divides pixels by it, Cycles does not."""
    with file.open("rb") as stream:
        header = stream.read(1 << 16).partition(b"\n\n")[0]
    lines = header.split(b"\n") if header.startswith(b"#?") else []
    return math.prod(float(line[len(b"EXPOSURE="):]) for line in lines if line.startswith(b"EXPOSURE="))


def save_image(image, folder):
    """Returns the file of an image; writes images that are packed into the .blend file first."""
    file = pathlib.Path(bpy.path.abspath(image.filepath_from_user()))
    if file.is_file() and file.suffix.lower() in (".exr", ".hdr"):
        return file
    file = pathlib.Path(folder, "world.exr")
    copy = image.original.copy()
    copy.file_format = "OPEN_EXR"
    copy.filepath_raw = str(file)
    copy.save()
    bpy.data.images.remove(copy)
    return file


def write_constant(color, strength, folder):
    """Writes a 1 x 1 Radiance image: 8-bit mantissas with a shared exponent. Returns options of `bdpt render`."""
    radiance = [strength * channel for channel in color]
    greatest = max(radiance)
    if greatest <= 0.0:
        return ["--env", "none"]
    # The image holds the hue and the option the strength, so that the product is exact.
    relative = [channel / greatest for channel in radiance]
    mantissas = bytes(min(255, round(255 * channel)) for channel in relative)
    file = pathlib.Path(folder, "world.hdr")
    file.write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n" + mantissas + struct.pack("B", 128))
    return ["--env", str(file), "--env-intensity", f"{greatest * 256.0 / 255.0:.9g}"]
