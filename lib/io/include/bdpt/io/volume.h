#pragma once

/// @file
/// Reads smoke and clouds from OpenVDB files.
///
/// @code{.cpp}
/// bdpt::SceneDesc desc = bdpt::io::load_gltf("landscape.glb").scene;
/// const bdpt::io::VolumeOptions options = {.extinction = bdpt::Rgb(0.1f)};
/// desc.volumes.push_back(bdpt::io::load_volume("cloud.vdb", options));
/// const bdpt::Scene scene(std::move(desc));
/// @endcode

#include <bdpt/export.h>
#include <bdpt/io/memory_budget.h>
#include <bdpt/io/read_limits.h>
#include <bdpt/volume_desc.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace bdpt::io {

/// Which axis of a file points up. In a scene it is y.
enum class UpAxis : std::uint8_t {
    y,  ///< as in glTF and Houdini
    z,  ///< as in Blender: (x, y, z) becomes (x, z, -y)
};

/// The grid to read from a file of volumes, and the meaning of its densities.
struct VolumeOptions {
    /// Name of the grid; none: "density", else the only one of floats.
    std::optional<std::string> grid{};
    Rgb extinction{1.0f};     ///< [1/m] where the density is 1, >= 0
    Rgb albedo{1.0f};         ///< [0, 1]: the share of it that scatters
    float anisotropy = 0.0f;  ///< g of Henyey and Greenstein, in (-1, 1): > 0 forwards
    UpAxis up = UpAxis::y;
    ReadLimits limits{};
    /// What the volume takes is taken from it; null: only `limits` count.
    std::shared_ptr<MemoryBudget> memory{};
};

/// Reads the densities of a grid of an OpenVDB file [Museth 2013, "VDB: High-Resolution Sparse
/// Volumes with Dynamic Topology"], as a dense box around its active voxels with a voxel more on
/// each side: so densities between voxels are what OpenVDB's trilinear sampler gives. Inactive
/// voxels count as they are stored. The transform of the grid is taken as metres.
///
/// The file is read by the program bdpt-read-vdb, in a process of its own with limits of memory and
/// time, as OpenVDB is not made for files that nobody trusts. It is waited for, and no other child
/// process is.
///
/// Throws `Error`, whose message starts with the file's path: not_found (missing or unreadable),
/// invalid_input (broken, over a limit, no such grid, a level set, no active voxels, a background
/// other than 0, a density that is negative, infinite or NaN), unsupported (another format or a
/// newer version of it, a grid that has no floats, a perspective transform; any file where there is
/// no bdpt-read-vdb).
[[nodiscard]] BDPT_EXPORT VolumeDesc load_volume(const std::filesystem::path& file,
                                                 const VolumeOptions& options = {});

}  // namespace bdpt::io
