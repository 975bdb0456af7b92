#include <bdpt/error.h>
#include <bdpt/io/volume.h>

#include "file/named_errors.h"
#include "volume/vdb_file.h"

#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace bdpt::io {

namespace {

/// Converts from the axes of the file to those of scenes.
glm::dmat4 turned_up(UpAxis up)
{
    glm::dmat4 turn(1.0);
    if (up == UpAxis::z) {
        turn[1] = {0, 0, -1, 0};
        turn[2] = {0, 1, 0, 0};
    }
    return turn;
}

/// Maps grid indices to the world, with voxel `first` at (0, 0, 0). Indices of OpenVDB are centres
/// of voxels, ours their lower corners.
glm::dmat4 world_from_grid(const VdbReply& header, UpAxis up)
{
    const glm::dvec3 first(header.first[0], header.first[1], header.first[2]);
    const glm::dmat4 precise = turned_up(up) * glm::make_mat4(header.world_from_index.data()) *
                               glm::translate(glm::dmat4(1.0), first - 0.5);
    const Mat4 matrix(precise);
    const float determinant = glm::determinant(glm::mat3(matrix));
    bool finite = std::isnormal(determinant);
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            finite = finite && std::isfinite(matrix[column][row]);
        }
    }
    if (!finite) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("grid \"{}\": its transform cannot be inverted in single "
                                "precision (determinant {})",
                                header.name.data(), determinant));
    }
    return precise;
}

std::string voxel_label(const VdbReply& header, std::size_t index)
{
    const std::size_t width = header.size[0];
    const std::size_t height = header.size[1];
    const std::array place{index % width, index / width % height, index / (width * height)};
    std::array<std::int64_t, 3> voxel{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        voxel[axis] = header.first[axis] + static_cast<std::int64_t>(place[axis]);
    }
    return fmt::format("grid \"{}\": voxel ({}, {}, {})", header.name.data(), voxel[0], voxel[1],
                       voxel[2]);
}

/// Makes densities finite and non-negative; returns the warnings about them.
std::vector<std::string> mend(VdbGrid& grid)
{
    std::string first;
    std::size_t count = 0;
    for (std::size_t i = 0; i < grid.density.size(); ++i) {
        float& value = grid.density[i];
        if (value >= 0.0f && std::isfinite(value)) {
            continue;
        }
        if (value > 0.0f) {
            throw Error(ErrorCode::invalid_input,
                        voxel_label(grid.header, i) + ": an infinite density");
        }
        if (count == 0) {
            first = fmt::format("{}: {}", voxel_label(grid.header, i), value);
        }
        ++count;
        value = 0.0f;
    }
    std::vector<std::string> warnings;
    if (count > 0) {
        warnings.push_back(
            fmt::format("{}: negative and NaN densities are treated as 0{}", first,
                        count > 1 ? fmt::format(" (and {} more of this kind)", count - 1) : ""));
    }
    if (grid.header.empty != 0) {
        std::fill(grid.density.begin(), grid.density.end(), 0.0f);
        warnings.push_back(fmt::format("grid \"{}\": it has no active voxels, so nothing is there",
                                       grid.header.name.data()));
    }
    return warnings;
}

LoadedVolume load(const std::filesystem::path& file, const VolumeOptions& options)
{
    VdbGrid grid = read_vdb(file, options);
    LoadedVolume loaded;
    loaded.warnings = mend(grid);
    VolumeDesc& volume = loaded.volume;
    volume.name = grid.header.name.data();
    volume.size = {grid.header.size[0], grid.header.size[1], grid.header.size[2]};
    const glm::dmat4 transform = world_from_grid(grid.header, options.up);
    volume.world_from_grid = Mat4(transform);
    loaded.translation = DVec3(transform[3]);
    volume.density = std::move(grid.density);
    volume.extinction = options.extinction;
    volume.albedo = options.albedo;
    volume.anisotropy = options.anisotropy;
    return loaded;
}

}  // namespace

LoadedVolume load_volume(const std::filesystem::path& file, const VolumeOptions& options)
{
    return with_named_errors(file, [&] { return load(file, options); });
}

}  // namespace bdpt::io
