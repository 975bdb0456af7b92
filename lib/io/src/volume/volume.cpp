#include <bdpt/error.h>
#include <bdpt/io/volume.h>

#include "file/named_errors.h"
#include "volume/vdb_file.h"

#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <utility>

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
Mat4 world_from_grid(const VdbReply& header, UpAxis up)
{
    const glm::dvec3 first(header.first[0], header.first[1], header.first[2]);
    const Mat4 matrix = turned_up(up) * glm::make_mat4(header.world_from_index.data()) *
                        glm::translate(glm::dmat4(1.0), first - 0.5);
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
    return matrix;
}

VolumeDesc load(const std::filesystem::path& file, const VolumeOptions& options)
{
    VdbGrid grid = read_vdb(file, options);
    VolumeDesc volume;
    volume.name = grid.header.name.data();
    volume.size = {grid.header.size[0], grid.header.size[1], grid.header.size[2]};
    volume.world_from_grid = world_from_grid(grid.header, options.up);
    volume.density = std::move(grid.density);
    volume.extinction = options.extinction;
    volume.albedo = options.albedo;
    volume.anisotropy = options.anisotropy;
    return volume;
}

}  // namespace

VolumeDesc load_volume(const std::filesystem::path& file, const VolumeOptions& options)
{
    return with_named_errors(file, [&] { return load(file, options); });
}

}  // namespace bdpt::io
