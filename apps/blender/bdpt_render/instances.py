"""Lists the meshes, lamps and the camera that a dependency graph places in the scene, with names and matrices."""

import dataclasses

import mathutils
import numpy as np

MESHES = ("MESH", "CURVE", "SURFACE", "FONT", "META")
NOT_SEEN = ("EMPTY", "ARMATURE", "LATTICE", "SPEAKER", "CAMERA", "LIGHT_PROBE", "GPENCIL", "GREASEPENCIL")


@dataclasses.dataclass
class Instance:
    key: tuple  # is the same at all times
    name: str
    matrix: mathutils.Matrix


def list_instances(depsgraph):
    """Yields pairs of an Instance and its evaluated object, which is valid until the next pair."""
    for item in depsgraph.object_instances:
        thing = item.object
        if not item.show_self or thing.type not in (*MESHES, "LIGHT"):
            continue
        key = (thing.name, item.parent.name if item.parent else "", tuple(item.persistent_id))
        yield Instance(key, thing.name, item.matrix_world.copy()), thing


def collect_matrices(depsgraph):
    """Returns the matrices of instances by key; None is the key of the camera."""
    matrices = {instance.key: instance.matrix for instance, _ in list_instances(depsgraph)}
    matrices[None] = depsgraph.scene.camera.evaluated_get(depsgraph).matrix_world.copy()
    return matrices


def hash_shapes(depsgraph):
    """Returns values by key that differ when a mesh deforms."""
    shapes = {}
    for instance, thing in list_instances(depsgraph):
        if thing.type == "MESH":
            places = np.empty(3 * len(thing.data.vertices), np.float32)
            thing.data.vertices.foreach_get("co", places)
            shapes[instance.key] = hash(places.tobytes())
    return shapes


def find_warnings(depsgraph):
    for thing in depsgraph.objects:
        if thing.type not in (*MESHES, *NOT_SEEN, "LIGHT"):
            yield f'object "{thing.name}": bdpt renders no objects of the type {thing.type}'
        if any(system.settings.type == "HAIR" and system.settings.render_type == "PATH" for system in thing.particle_systems):
            yield f'object "{thing.name}": bdpt renders no hair'
