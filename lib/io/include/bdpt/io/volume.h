#pragma once

/// @file
/// Reads smoke and clouds from OpenVDB files.
///
/// @code{.cpp}
/// bdpt::SceneDesc desc = bdpt::io::load_gltf("landscape.glb").scene;
/// const bdpt::io::VolumeOptions options = {.extinction = bdpt::Rgb(0.1f)};
/// desc.volumes.push_back(bdpt::io::load_volume("cloud.vdb", options).volume);
/// const bdpt::Scene scene(std::move(desc));
/// @endcode

#include <bdpt/export.h>
#include <bdpt/io/read_limits.h>
#include <bdpt/volume_desc.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace bdpt::io {

/// The axis of a file that points up. In a scene it is y.
enum class UpAxis : std::uint8_t {
    y,  ///< as in glTF and Houdini
    z,  ///< as in Blender: (x, y, z) becomes (x, z, -y)
};

/// The grid to read from a file of volumes, and the meaning of its densities.
struct VolumeOptions {
    /// Name of the grid; none: "density", else the only grid of floats.
    std::optional<std::string> grid{};
    Rgb extinction{1.0f};     ///< extinction coefficient [1/m] at density 1, >= 0
    Rgb albedo{1.0f};         ///< single-scattering albedo, in [0, 1]
    float anisotropy = 0.0f;  ///< g of Henyey and Greenstein, in (-1, 1); > 0: forward scattering
    UpAxis up = UpAxis::y;
    ReadLimits limits{};
    /// Budget that the volume's memory is taken from; null: only `limits` count.
    std::shared_ptr<MemoryBudget> memory{};
};

/// The result of `load_volume`.
struct LoadedVolume {
    VolumeDesc volume;
    /// Translation of the volume's transform in double precision [m]. In a scene with an origin of
    /// its own, the transform has that minus `SceneDesc::origin`.
    DVec3 translation{0.0};
    std::vector<std::string> warnings;  ///< one line each, without the file's name
};

/// Reads the densities of a grid of an OpenVDB file [Museth 2013, "VDB: High-Resolution Sparse
/// Volumes with Dynamic Topology"], as a dense box around its active voxels with one voxel more on
/// each side, so that densities between voxels equal those of OpenVDB's trilinear sampler. Inactive
/// voxels keep their stored values. A grid without active voxels gives a few voxels of density 0,
/// and negative and NaN densities become 0, with warnings. The transform of the grid is taken as
/// metres.
///
/// The program bdpt-read-vdb reads the file, in a separate process with limits of memory and time,
/// as OpenVDB is not hardened against untrusted files. Only this child process is waited for.
///
/// Throws `Error`, whose message starts with the file's path: not_found (missing or unreadable),
/// invalid_input (broken, over a limit, no such grid, a level set, a background other than 0, an
/// infinite density), unsupported (another format or a newer version of it, a grid without floats,
/// a perspective transform; any file without bdpt-read-vdb).
[[nodiscard]] BDPT_EXPORT LoadedVolume load_volume(const std::filesystem::path& file,
                                                   const VolumeOptions& options = {});

}  // namespace bdpt::io
