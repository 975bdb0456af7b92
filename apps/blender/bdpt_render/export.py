"""Exports the scene of a render as a GLB file, and the remaining settings as options of `bdpt render`."""

import math
import pathlib

import mathutils
import numpy as np

from . import camera, lamps, meshes, world

# Rotates Blender's z-up coordinates to the y-up coordinates of glTF.
Y_UP = mathutils.Matrix(((1, 0, 0, 0), (0, 0, 1, 0), (0, -1, 0, 0), (0, 0, 0, 1)))
SHUTTER_MOMENTS = 3


class Export:
    """Exports a scene at one moment or, for motion blur, at several."""

    def __init__(self, depsgraph, folder):
        """Exports shapes and positions at the first moment. Must run in the main thread."""
        self.file = pathlib.Path(folder, "scene.glb")
        self.warnings = []
        scene = depsgraph.scene
        thing = scene.camera.evaluated_get(depsgraph)
        made = meshes.Meshes(depsgraph, folder)
        self._glb, of_instances = made.glb, made.of_instances()
        self._nodes, self._moments = {}, []
        self._y_up = of_instances.keys()  # the exporter has already rotated their vertices
        for instance, shown in meshes.list_instances(depsgraph):
            if shown.type == "LIGHT":
                holds, lost = lamps.add_lamp(self._glb, shown.data, instance.name, instance.matrix.to_scale())
                self.warnings += lost
            elif instance.key in of_instances:
                holds = {"mesh": of_instances[instance.key]}
            else:
                continue
            self._nodes[instance.key] = {"name": instance.name, **holds}
        index = self._glb.add("cameras", camera.gltf_camera(scene, thing.data, thing.matrix_world))
        self._nodes[None] = {"name": scene.camera.name, "camera": index}
        self._environment, lost = world.environment_words(scene.world, folder)
        self.warnings += [*lost, *camera.find_warnings(scene, thing.data), *meshes.find_warnings(depsgraph)]
        self.film = camera.make_film(scene, thing.data)
        self._shapes = meshes.hash_shapes(depsgraph) if scene.render.use_motion_blur else {}
        self.place(depsgraph)

    def place(self, depsgraph):
        """Records the transforms at one more moment. Shapes stay those of the first moment."""
        self._moments.append(meshes.collect_matrices(depsgraph))
        if len(self._moments) == 1:
            return
        for key, shape in meshes.hash_shapes(depsgraph).items():
            if key in self._nodes and self._shapes.get(key) != shape:
                self.warnings.append(f'object "{key[0]}": its motion is blurred, its deformation is not')

    def write(self):
        document = self._glb.document
        document["nodes"], channels, samplers = [], [], []
        times = None
        for key, node in self._nodes.items():
            # Instances that appear or disappear while the shutter is open do not move.
            matrices = [self._in_gltf(key, moment.get(key, self._moments[0][key])) for moment in self._moments]
            index = self._glb.add("nodes", node)
            if all(matrix == matrices[0] for matrix in matrices):
                node["matrix"] = [value for column in matrices[0].transposed() for value in column]
                continue
            if times is None:
                times = self._glb.add_accessor(np.linspace(0, 1, len(matrices), dtype=np.float32))
            for path, values in transforms(matrices).items():
                node[path] = values[0].tolist()
                samplers.append({"input": times, "output": self._glb.add_accessor(values)})
                channels.append({"sampler": len(samplers) - 1, "target": {"node": index, "path": path}})
        document["scenes"], document["scene"] = [{"nodes": list(range(len(document["nodes"])))}], 0
        if channels:
            document["animations"] = [{"channels": channels, "samplers": samplers}]
        self._glb.write(self.file)

    def _in_gltf(self, key, matrix):
        """Converts a world matrix to glTF. Lamps and cameras look along -z in Blender, too, and lose their scale."""
        if key in self._y_up:
            return Y_UP @ matrix @ Y_UP.transposed()
        place, turn, _ = matrix.decompose()
        return Y_UP @ mathutils.Matrix.LocRotScale(place, turn, None)

    def words(self):
        words = [*self.film.words(), *self._environment]
        moving = "animations" in self._glb.document
        return words + (["--frame-time", "0", "--shutter", "1"] if moving else [])


def transforms(matrices):
    """Returns translations, rotations and scales as arrays. Quaternions are (x, y, z, w), with signs that keep each
    near the one before."""
    parts = [matrix.decompose() for matrix in matrices]
    turns = [turn for _, turn, _ in parts]
    for before, turn in zip(turns, turns[1:]):
        turn.make_compatible(before)
    return {"translation": np.array([place for place, _, _ in parts], np.float32),
            "rotation": np.array([(turn.x, turn.y, turn.z, turn.w) for turn in turns], np.float32),
            "scale": np.array([scale for _, _, scale in parts], np.float32)}


def shutter_times(render):
    """Returns the moments [frames] at which the shutter is open, relative to the frame; (0,) without motion blur."""
    if not render.use_motion_blur:
        return (0.0,)
    open_for = render.motion_blur_shutter
    position = getattr(render, "motion_blur_position", "CENTER")
    start = {"START": 0.0, "CENTER": -open_for / 2.0, "END": -open_for}[position]
    return tuple(start + open_for * i / (SHUTTER_MOMENTS - 1) for i in range(SHUTTER_MOMENTS))
