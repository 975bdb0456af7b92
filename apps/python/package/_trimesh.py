"""Converts scenes of trimesh and pyrender, neither of which is imported: only their attributes are used."""

from __future__ import annotations

from typing import Any, Iterator, Sequence

import numpy as np

from ._bdpt import Camera, DirectionalLight, Material, Mesh, PointLight, Scene, SpotLight


def to_scene(source: Any, smooth: bool, lights: Sequence[Any], camera: Camera | None, size: tuple[int, int] | None) -> Scene:
    """Does what Scene.from_trimesh() says."""
    is_pyrender = hasattr(source, "mesh_nodes")
    if not is_pyrender and not hasattr(source, "vertices") and not hasattr(source, "geometry"):
        raise TypeError(f"from_trimesh() takes a scene or a mesh of trimesh or pyrender, not {type(source).__name__}")
    if is_pyrender:
        meshes, lights = list(convert_nodes(source)), list(lights) or list(convert_lights(source))
        camera = camera or convert_main_camera(source)
    else:
        meshes = list(convert_geometry(source, smooth))
        if camera is None and getattr(source, "has_camera", False):  # otherwise trimesh makes one
            lens = source.camera
            width, height = map(int, lens.resolution)
            camera = Camera.from_matrix(source.camera_transform, fx=lens.K[0, 0], fy=lens.K[1, 1], cx=lens.K[0, 2],
                                        cy=lens.K[1, 2], size=(width, height))
    return Scene(meshes, lights, camera, size)


# trimesh


def convert_geometry(source: Any, smooth: bool) -> Iterator[Mesh]:
    """Yields the meshes of a scene, each with the places of its nodes, or that of a mesh. Other geometry is left out."""
    if hasattr(source, "vertices"):
        yield convert_mesh(source, getattr(source, "metadata", {}).get("name") or "", [np.eye(4)], smooth)
        return
    places: dict[str, list[Any]] = {}
    for node in source.graph.nodes_geometry:
        transform, name = source.graph[node]
        places.setdefault(name, []).append(transform)
    for name, transforms in places.items():
        if len(getattr(source.geometry[name], "faces", ())) > 0:
            yield convert_mesh(source.geometry[name], name, transforms, smooth)


def convert_mesh(mesh: Any, name: str, transforms: list[Any], smooth: bool) -> Mesh:
    positions, triangles, visual = np.asarray(mesh.vertices), np.asarray(mesh.faces), mesh.visual
    has_normals = smooth or "vertex_normals" in mesh._cache.cache  # those of its file; others are made on demand
    vertices: dict[str, Any] = {"normals": mesh.vertex_normals if has_normals else None}
    material: dict[str, Any] = {"metallic": 0.0}
    uv = getattr(visual, "uv", None)
    if getattr(visual, "material", None) is not None:
        material = convert_material(visual.material)
    elif visual.kind == "face":  # each triangle gets vertices of its own
        vertices = {key: value if value is None else value[triangles].reshape(-1, 3) for key, value in vertices.items()}
        vertices["colors"] = np.repeat(to_factors(visual.face_colors), 3, axis=0)
        positions, triangles = positions[triangles].reshape(-1, 3), np.arange(triangles.size).reshape(-1, 3)
    elif visual.kind == "vertex":
        vertices["colors"] = to_factors(visual.vertex_colors)
    else:
        material["base_color"] = to_factors(visual.main_color)
    if uv is not None and len(uv) == len(positions):
        vertices["uvs"] = np.asarray(uv) * (1, -1) + (0, 1)  # its v points up
    return Mesh(positions, triangles, name=name, material=Material(**material), transforms=np.array(transforms), **vertices)


def convert_material(material: Any) -> dict[str, Any]:
    """Returns the attributes of a material of trimesh or pyrender: both have names of glTF."""
    is_simple = not hasattr(material, "baseColorFactor") and hasattr(material, "to_pbr")
    if is_simple:
        name, material = material.name, material.to_pbr()
        material.name, material.metallicFactor = name, 0.0
    names = {"name": "name", "base_color": "baseColorFactor", "metallic": "metallicFactor", "roughness": "roughnessFactor",
             "emission": "emissiveFactor", "alpha_mode": "alphaMode", "alpha_cutoff": "alphaCutoff", "double_sided": "doubleSided",
             "base_color_texture": "baseColorTexture", "metallic_roughness_texture": "metallicRoughnessTexture",
             "normal_texture": "normalTexture", "emission_texture": "emissiveTexture"}
    found: dict[str, Any] = {}
    for name, of_gltf in names.items():
        value = getattr(material, of_gltf, None)
        if value is None:
            continue
        found[name] = value
        if name.endswith("_texture"):
            found[name] = to_texels(value)
        elif name in ("base_color", "emission"):
            found[name] = to_factors(value)
        elif name == "alpha_mode":
            found[name] = str(value).lower()
        elif name in ("metallic", "roughness", "alpha_cutoff"):
            found[name] = float(value)
    return found


def to_factors(color: Any) -> Any:
    """Returns linear factors of 0 to 1: trimesh has those of glTF as bytes or floats."""
    color = np.asarray(color)
    return color / 255.0 if color.dtype == np.uint8 else color.astype(np.float64)


def to_texels(texture: Any) -> Any:
    """Returns an image of PIL, an array, or a texture of pyrender as an array of bytes or floats."""
    image = getattr(texture, "source", texture)
    if hasattr(image, "convert") and image.mode not in ("L", "RGB", "RGBA"):
        image = image.convert("RGBA" if "A" in image.mode or "transparency" in image.info else "RGB")
    texels = np.asarray(image)
    return texels.astype(np.float32) if texels.dtype == np.float64 else texels


# pyrender


def convert_nodes(source: Any) -> Iterator[Mesh]:
    """Yields the triangles of a scene of pyrender. Points and lines are left out."""
    triangles_mode = 4
    for node in source.mesh_nodes:
        place = np.asarray(source.get_pose(node))
        for primitive in node.mesh.primitives:
            if primitive.mode != triangles_mode:
                continue
            count = len(primitive.positions)
            indices = np.arange(count) if primitive.indices is None else np.asarray(primitive.indices, np.int64)  # floats there
            poses = [np.eye(4)] if primitive.poses is None else primitive.poses
            uvs = None if primitive.texcoord_0 is None else np.asarray(primitive.texcoord_0)[:, :2] * (1, -1) + (0, 1)
            material = convert_material(primitive.material) if primitive.material is not None else {"metallic": 0.0}
            yield Mesh(primitive.positions, indices.reshape(-1, 3), primitive.normals, uvs, Material(**material),
                       np.array([place @ pose for pose in poses]), node.mesh.name or node.name or "", primitive.color_0)


def convert_lights(source: Any) -> Iterator[Any]:
    for node in source.light_nodes:
        pose, light = np.asarray(source.get_pose(node)), node.light
        power, place, axis = np.asarray(light.color)[:3] * light.intensity, tuple(pose[:3, 3]), tuple(-pose[:3, 2])
        if hasattr(light, "innerConeAngle"):
            yield SpotLight(position=place, direction=axis, intensity=power, inner_cone_angle=light.innerConeAngle,
                            outer_cone_angle=light.outerConeAngle)
        elif hasattr(light, "range"):
            yield PointLight(position=place, intensity=power)
        else:
            yield DirectionalLight(direction=axis, illuminance=power)


def convert_main_camera(source: Any) -> Camera | None:
    """Returns the camera that pyrender renders with, if it is simple."""
    node = source.main_camera_node
    if node is None:
        return None
    pose, camera = source.get_pose(node), node.camera
    if hasattr(camera, "yfov"):
        return Camera.from_matrix(pose, fov=float(np.degrees(camera.yfov)))
    if hasattr(camera, "ymag"):
        return Camera.from_matrix(pose, vertical_extent=2 * camera.ymag)
    if hasattr(camera, "fx"):  # for an image whose middle is about that of its axis
        return Camera.from_matrix(pose, fx=camera.fx, fy=camera.fy, cx=camera.cx, cy=camera.cy,
                                  size=(max(1, round(2 * camera.cx)), max(1, round(2 * camera.cy))))
    return None
