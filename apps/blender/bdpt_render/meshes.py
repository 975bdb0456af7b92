"""Lists the meshes, lamps and the camera that a dependency graph places in the scene, with names and matrices, and
exports meshes and materials as a GLB file with Blender's own exporter."""

import contextlib
import dataclasses
import pathlib

import bpy
import mathutils
import numpy as np

from .glb import Glb

EXPORTER = "io_scene_gltf2"
# Options that the installed exporter does not know are dropped.
OPTIONS = {
    "export_format": "GLB", "use_active_scene": True, "export_cameras": False, "export_lights": False,
    "export_apply": False, "export_animations": False, "export_skins": False, "export_morph": False,
    "export_yup": True, "export_extras": False, "will_save_settings": False}
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


class Meshes:
    """Exports each mesh that a dependency graph shows once. Runs in the main thread only, as it creates temporary
    data."""

    def __init__(self, depsgraph, folder):
        self._made, self._names = contextlib.ExitStack(), {}
        self._meshes = {}  # names of temporary objects, by mesh and materials
        self._nodes = {}   # names of temporary objects, by keys of instances
        with self._made:
            scene = bpy.data.scenes.new("bdpt export")
            self._made.callback(bpy.data.scenes.remove, scene)
            for instance, thing in list_instances(depsgraph):
                if thing.type != "LIGHT":
                    shown = self._shown(depsgraph, scene, thing)
                    if shown:
                        self._nodes[instance.key] = shown
            self.glb = exported(scene, folder) if self._nodes else Glb.empty()
        self._rename()
        make_glass_solid(self.glb)

    def of_instances(self):
        """Returns the indices of meshes in the GLB by keys of instances."""
        nodes = {node["name"]: node["mesh"] for node in self.glb.document.get("nodes", ()) if "mesh" in node}
        return {key: nodes[name] for key, name in self._nodes.items() if name in nodes}

    def _shown(self, depsgraph, scene, thing):
        """Returns the name of a temporary object with the mesh of `thing`; None if it has no faces."""
        materials = tuple(slot.material for slot in thing.material_slots)
        key = (thing.data.as_pointer(), tuple(material and material.name_full for material in materials))
        if key not in self._meshes:
            self._meshes[key] = self._made_object(depsgraph, scene, thing, materials)
        return self._meshes[key]

    def _made_object(self, depsgraph, scene, thing, materials):
        mesh = bpy.data.meshes.new_from_object(thing, preserve_all_data_layers=True, depsgraph=depsgraph)
        if mesh is None:
            return None
        self._made.callback(bpy.data.meshes.remove, mesh)
        if not mesh.polygons:
            return None
        mesh.materials.clear()
        for material in materials:
            mesh.materials.append(material and self._material(material))
        made = bpy.data.objects.new("bdpt", mesh)
        self._made.callback(bpy.data.objects.remove, made)
        scene.collection.objects.link(made)
        return made.name

    def _material(self, material):
        """Returns the original material or, if it is animated, a copy with the values of this frame."""
        original = material.original
        tree = original.node_tree
        if not (original.animation_data or (tree and tree.animation_data)):
            return original
        if original.name not in self._names.values():
            copy = original.copy()
            self._made.callback(bpy.data.materials.remove, copy)
            for change in (copy, copy.node_tree):
                if change is not None:
                    change.animation_data_clear()
            take_values(material, copy)
            self._names[copy.name] = original.name
        return bpy.data.materials[next(name for name, of in self._names.items() if of == original.name)]

    def _rename(self):
        for material in self.glb.document.get("materials", ()):
            material["name"] = self._names.get(material.get("name"), material.get("name"))


def make_glass_solid(glb):
    """Gives transmissive materials a thickness: Blender refracts at every such surface, glTF only in solid bodies."""
    for material in glb.document.get("materials", ()):
        extensions = material.get("extensions", {})
        if extensions.get("KHR_materials_transmission", {}).get("transmissionFactor", 0.0) > 0.0:
            volume = extensions.setdefault("KHR_materials_volume", {})
            volume["thicknessFactor"] = volume.get("thicknessFactor") or 1.0
            glb.use("KHR_materials_volume")


def take_values(source, target):
    """Copies the values of sockets, except inside groups."""
    if source.node_tree is None or target.node_tree is None:
        return
    for node in source.node_tree.nodes:
        sockets = zip((*node.inputs, *node.outputs), (*target.node_tree.nodes[node.name].inputs,
                                                      *target.node_tree.nodes[node.name].outputs))
        for from_, to in sockets:
            if hasattr(from_, "default_value") and hasattr(to, "default_value") and from_.type != "STRING":
                to.default_value = from_.default_value


def exported(scene, folder):
    if not hasattr(bpy.types, "EXPORT_SCENE_OT_gltf"):
        import addon_utils
        addon_utils.enable(EXPORTER)
    if not hasattr(bpy.types, "EXPORT_SCENE_OT_gltf"):
        raise RuntimeError(f"the add-on {EXPORTER}, Blender's exporter of glTF, cannot be enabled")
    file = pathlib.Path(folder, "meshes.glb")
    known = bpy.ops.export_scene.gltf.get_rna_type().properties.keys()
    options = {name: value for name, value in OPTIONS.items() if name in known}
    with bpy.context.temp_override(scene=scene, view_layer=scene.view_layers[0], collection=scene.collection,
                                   active_object=None, object=None, selected_objects=[]):
        try:
            bpy.ops.export_scene.gltf(filepath=str(file), **options)
        except RuntimeError as error:
            lines = [line for line in str(error).splitlines() if line.strip() and not line.startswith("Location:")]
            raise RuntimeError(f"Blender's exporter of glTF failed: {lines[-1].strip()}") from None
    glb = Glb(file)
    file.unlink()
    return glb
