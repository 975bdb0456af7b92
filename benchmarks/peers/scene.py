"""Describes a scene that all renderers share: triangles, diffuse, metal and glass surfaces, point lights, a pinhole
camera; and media, which some support. Uses linear Rec. 709; metres, nit and candela; right-handed, y up; a triangle's
front is where its corners run anticlockwise."""

import dataclasses
import json
import math
import pathlib


class NotShared(Exception):
    """Raised when a scene needs a feature that not all renderers have."""


@dataclasses.dataclass(frozen=True)
class Medium:
    """A homogeneous medium with the Henyey-Greenstein phase function."""

    extinction: tuple  # absorption and scattering together [1/m]
    albedo: tuple  # single-scattering albedo
    anisotropy: float = 0.0  # g of the phase function; above 0 is forwards


@dataclasses.dataclass(frozen=True)
class Volume:
    """White smoke of varying density, in addition to other media."""

    file: str  # OpenVDB file
    densities: str  # the same densities as a NumPy file, by x, y, z
    size: tuple  # number of voxels
    world_from_grid: tuple  # rows of a matrix; voxel (0, 0, 0) fills the unit cube
    extinction: tuple  # [1/m] at density 1


@dataclasses.dataclass(frozen=True)
class Material:
    name: str
    kind: str  # "diffuse"; "metal" with reflectance 1 at all angles and colours; "glass", which is clear
    color: tuple = (1.0, 1.0, 1.0)  # reflectance of diffuse surfaces
    alpha: float = 0.0  # roughness of the GGX distribution; 0 is perfectly smooth
    ior: float = 1.5  # index of refraction of glass
    emission: tuple = None  # [nit], from the front only
    inside: Medium = None  # medium inside of glass; None is clear


@dataclasses.dataclass(frozen=True)
class Mesh:
    """Flat triangles; the outside of glass is their front."""

    name: str
    material: int
    positions: tuple  # (x, y, z) each
    triangles: tuple  # three indices each


@dataclasses.dataclass(frozen=True)
class PointLight:
    name: str
    position: tuple
    intensity: tuple  # [cd] for each colour channel


@dataclasses.dataclass(frozen=True)
class Camera:
    position: tuple
    direction: tuple  # unit vector
    up: tuple  # unit vector perpendicular to `direction`
    vertical_fov: float  # [rad]
    aspect_ratio: float


@dataclasses.dataclass(frozen=True)
class Scene:
    title: str
    materials: tuple
    meshes: tuple
    points: tuple
    camera: Camera
    changes: tuple  # differences from the original file, one sentence each
    fog: Medium = None  # fills the sphere around all meshes, except inside bodies
    volume: Volume = None

    def kinds(self):
        """Returns the kinds of its surfaces, like "diffuse" and "rough glass", and "media" if it has some."""
        materials = [self.materials[mesh.material] for mesh in self.meshes]
        surfaces = {("rough " if material.alpha > 0 else "") + material.kind for material in materials}
        return surfaces | ({"media"} if self.fog or self.volume or any(material.inside for material in materials) else set())

    def sphere(self):
        """Returns centre and radius of the sphere around the bounding box of all meshes."""
        low, high = ([pick(p[i] for mesh in self.meshes for p in mesh.positions) for i in range(3)] for pick in (min, max))
        return tuple((a + b) / 2 for a, b in zip(low, high)), math.dist(low, high) / 2


def to_json(scene):
    return json.dumps(dataclasses.asdict(scene))


def _tuples(value):
    return tuple(_tuples(item) for item in value) if isinstance(value, list) else value


def _medium(item):
    return Medium(**{key: _tuples(value) for key, value in item.items()}) if item else None


def from_json(text):
    """Returns the scene that `to_json` wrote."""
    data = {key: _tuples(value) for key, value in json.loads(text).items()}
    data["materials"] = tuple(Material(**{**{k: _tuples(v) for k, v in item.items()}, "inside": _medium(item["inside"])})
                              for item in data["materials"])
    data["fog"] = _medium(data["fog"])
    data["volume"] = Volume(**{k: _tuples(v) for k, v in data["volume"].items()}) if data["volume"] else None
    data["meshes"] = tuple(Mesh(**{k: _tuples(v) for k, v in item.items()}) for item in data["meshes"])
    data["points"] = tuple(PointLight(**{k: _tuples(v) for k, v in item.items()}) for item in data["points"])
    data["camera"] = Camera(**{k: _tuples(v) for k, v in data["camera"].items()})
    return Scene(**data)


def read_volume(path, extinction, folder):
    """Reads the grid "density" of an OpenVDB file as a Volume, with OpenVDB's own Python module (Debian:
    python3-openvdb); writes its densities to a file in the folder."""
    try:
        import numpy
        import pyopenvdb
    except ImportError as error:
        raise SystemExit(f"--volume: {error}") from error
    grid = pyopenvdb.read(str(path), "density")
    low, high = grid.evalActiveVoxelBoundingBox()
    low, high = [i - 1 for i in low], [i + 1 for i in high]  # densities fall to zero beyond the last voxels
    densities = numpy.zeros([b - a + 1 for a, b in zip(low, high)], dtype=numpy.float32)
    grid.copyToArray(densities, ijk=low)
    if grid.background != 0:
        raise NotShared(f"{path}: the background is {grid.background}")
    # Grid indices refer to voxel centres.
    origin = grid.transform.indexToWorld(tuple(i - 0.5 for i in low))
    columns = [[b - a for a, b in zip(origin, grid.transform.indexToWorld(
        tuple(i - 0.5 + (axis == j) for j, i in enumerate(low))))] for axis in range(3)]
    rows = tuple(tuple(column[i] for column in columns) + (origin[i],) for i in range(3)) + ((0.0, 0.0, 0.0, 1.0),)
    file = pathlib.Path(folder) / "densities.npy"
    numpy.save(file, densities)
    return Volume(str(path), str(file), densities.shape, rows, extinction)
