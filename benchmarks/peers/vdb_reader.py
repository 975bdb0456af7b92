"""Reads the densities of OpenVDB files with OpenVDB's own Python module (Debian: python3-openvdb)."""

import pathlib

from scene import NotShared, Volume


def read(path, extinction, folder):
    """Reads the grid "density" as a Volume; writes its densities to a file in the folder."""
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
