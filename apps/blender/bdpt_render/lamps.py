"""Lamps as glTF has them: its units are taken for watts, so W/sr is candela and W/m^2 is lux."""

import math

import numpy as np

EXTENSION = "KHR_lights_punctual"
SOFT_SUN = math.radians(1.0)


def add_lamp(glb, lamp, name, scale):
    """What a node of the lamp holds, and what gets lost. The node has no scale: only area lamps have, by `scale`."""
    power, warnings = power_of(lamp)
    if lamp.type == "AREA":
        return {"mesh": add_shining_mesh(glb, lamp, power, name, scale)}, warnings
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
        item.update(type="spot", spot=cone_of(lamp))
    glb.use(EXTENSION)
    lights = glb.document.setdefault("extensions", {}).setdefault(EXTENSION, {"lights": []})["lights"]
    lights.append(item)
    return {"extensions": {EXTENSION: {"light": len(lights) - 1}}}, warnings


def power_of(lamp):
    """[W] by colour, of suns [W/m^2], and what gets lost."""
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


def cone_of(lamp):
    """Blender's edge is a smooth step of the cosine, that of glTF a square: an inner cone with as much light."""
    outer = lamp.spot_size / 2.0
    edge = 0.75 * lamp.spot_blend * (1.0 - math.cos(outer))  # 1/2 of one edge's width is 2/3 of the other's
    inner = math.acos(min(1.0, math.cos(outer) + edge))
    return {"innerConeAngle": min(inner, 0.9999 * outer), "outerConeAngle": min(outer, math.pi / 2.0)}


def add_shining_mesh(glb, lamp, power, name, scale):
    """glTF has no area lamps: a black, one-sided face that shines as the lamp does."""
    width = lamp.size * scale[0]
    height = (lamp.size_y if lamp.shape in ("RECTANGLE", "ELLIPSE") else lamp.size) * scale[1]
    is_round = lamp.shape in ("DISK", "ELLIPSE")
    count = 64 if is_round else 4
    # A polygon of the circle's area, or the rectangle.
    reach = 0.5 * math.sqrt(2.0 * math.pi / count / math.sin(2.0 * math.pi / count)) if is_round else math.sqrt(0.5)
    # Clockwise as seen from +z: it shines along -z, as lamps do.
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
