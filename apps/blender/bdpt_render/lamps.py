"""Converts lamps to glTF. bdpt reads glTF intensities as radiometric: candela as W/sr, lux as W/m^2."""

import math

import numpy as np

EXTENSION = "KHR_lights_punctual"
SOFT_SUN = math.radians(1.0)


def add_lamp(glb, lamp, name, scale):
    """Adds a lamp; returns the properties of its node, and warnings. The node has no scale: only area lamps use it, as
    `scale`."""
    power, warnings = compute_power(lamp)
    if lamp.type == "AREA":
        return {"mesh": add_emissive_mesh(glb, lamp, power, name, scale)}, warnings
    strongest = max(power) or 1.0
    item = {"name": name, "color": [channel / strongest for channel in power]}
    if lamp.type == "SUN":
        item.update(type="directional", intensity=strongest)
        if lamp.angle > SOFT_SUN:
            warnings.append(f'sun "{name}": it has no size in bdpt, its shadows are sharp')
    else:
        item.update(type="point", intensity=strongest / (4.0 * math.pi))
        if lamp.shadow_soft_size > 0.0:
            item["extras"] = {"radius": lamp.shadow_soft_size}
    if lamp.type == "SPOT":
        item.update(type="spot", spot=convert_cone(lamp))
    glb.use(EXTENSION)
    lights = glb.document.setdefault("extensions", {}).setdefault(EXTENSION, {"lights": []})["lights"]
    lights.append(item)
    return {"extensions": {EXTENSION: {"light": len(lights) - 1}}}, warnings


def compute_power(lamp):
    """Returns the power [W] of each colour channel (of suns: irradiance [W/m^2]), and warnings."""
    factor = lamp.energy * 2.0 ** getattr(lamp, "exposure", 0.0)
    color = np.array(lamp.color) * factor
    if getattr(lamp, "use_temperature", False):
        color *= lamp.temperature_color
    if not lamp.use_nodes or lamp.node_tree is None:
        return color.tolist(), []
    output = next((node for node in lamp.node_tree.nodes if node.type == "OUTPUT_LIGHT" and node.is_active_output), None)
    links = output.inputs["Surface"].links if output else ()
    emission = links[0].from_node if links else None
    if emission is None:
        return [0.0, 0.0, 0.0], []
    inputs = emission.inputs
    if emission.type != "EMISSION" or inputs["Color"].links or inputs["Strength"].links:
        return color.tolist(), [f'lamp "{lamp.name}": its nodes are ignored; bdpt knows an Emission node without links']
    return (color * inputs["Color"].default_value[:3] * inputs["Strength"].default_value).tolist(), []


def convert_cone(lamp):
    """Returns the cone angles of a spot. Blender smooths its edge with smoothstep of the cosine, glTF with a square:
    the inner cone is chosen so that both emit as much light."""
    outer = lamp.spot_size / 2.0
    edge = 0.75 * lamp.spot_blend * (1.0 - math.cos(outer))  # mean over the edge: Blender 1/2, glTF 2/3
    inner = math.acos(min(1.0, math.cos(outer) + edge))
    return {"innerConeAngle": min(inner, 0.9999 * outer), "outerConeAngle": min(outer, math.pi / 2.0)}


def add_emissive_mesh(glb, lamp, power, name, scale):
    """Adds an area light, which glTF lacks, as a black one-sided mesh with the same emission."""
    width = lamp.size * scale[0]
    height = (lamp.size_y if lamp.shape in ("RECTANGLE", "ELLIPSE") else lamp.size) * scale[1]
    is_round = lamp.shape in ("DISK", "ELLIPSE")
    count = 64 if is_round else 4
    # Takes a polygon of the circle's area, or the rectangle.
    reach = 0.5 * math.sqrt(2.0 * math.pi / count / math.sin(2.0 * math.pi / count)) if is_round else math.sqrt(0.5)
    # Vertices run clockwise as seen from +z: the mesh emits along -z, as lamps do.
    angles = -2.0 * math.pi * (np.arange(count) + 0.5) / count
    points = np.stack([reach * width * np.cos(angles), reach * height * np.sin(angles), np.zeros(count)], axis=1)
    triangles = np.array([[0, i, i + 1] for i in range(1, count - 1)], np.uint32)
    area = width * height * (math.pi / 4.0 if is_round else 1.0)
    radiance = np.array(power) / math.pi / (area if getattr(lamp, "normalize", True) else 1.0)
    strongest = float(radiance.max()) or 1.0
    glb.use("KHR_materials_emissive_strength")
    glb.use("KHR_materials_specular")
    material = glb.add("materials", {
        "name": name, "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0},
        "emissiveFactor": (radiance / strongest).tolist(),
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": strongest},
                       "KHR_materials_specular": {"specularFactor": 0}}})
    return glb.add("meshes", {"name": name, "primitives": [{
        "attributes": {"POSITION": glb.add_accessor(points.astype(np.float32))},
        "indices": glb.add_accessor(triangles.ravel()), "material": material}]})
