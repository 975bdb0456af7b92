#pragma once

#include <bdpt/io/volume.h>

#include <openvdb/openvdb.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "scratch_folder.h"

namespace bdpt::test {

/// Files of volumes that tests make.
class VdbFiles {
public:
    VdbFiles() { openvdb::initialize(); }

    /// Writes `grids` to a new file.
    std::filesystem::path write(const std::vector<openvdb::GridBase::Ptr>& grids);
    /// The same of bytes.
    std::filesystem::path write(const std::string& bytes);

private:
    ScratchFolder folder_;
    int count_ = 0;
};

/// A grid of the name "density" with a density in each voxel of the box from `first` to `last`.
openvdb::FloatGrid::Ptr density_grid(openvdb::Coord first, openvdb::Coord last,
                                     const std::function<float(openvdb::Coord)>& density);

/// Of 7 x 5 x 3 voxels, all different, about the index (-2, 3, 9); placed askew.
openvdb::FloatGrid::Ptr askew_grid();

/// Density 2 in 4 x 4 x 4 voxels.
openvdb::FloatGrid::Ptr small_grid();

}  // namespace bdpt::test
