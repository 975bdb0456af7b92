#include "vdb_reader/dense_densities.h"

#include <bdpt/error.h>

#include "vdb_reader/grid_choice.h"

#include <openvdb/tools/Dense.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

namespace bdpt::vdb {

namespace {

using openvdb::Coord;
using openvdb::CoordBBox;

/// Slices written at a time: the depth of the tree's leaves.
constexpr int slab_depth = 8;

/// Calls `visit` with the grid as its actual type.
template <typename Visit>
void with_values(const openvdb::GridBase& grid, const Visit& visit)
{
    if (const auto* floats = dynamic_cast<const openvdb::FloatGrid*>(&grid)) {
        visit(*floats);
    } else {
        visit(dynamic_cast<const openvdb::DoubleGrid&>(grid));
    }
}

template <typename... Parts>
[[noreturn]] void fail(const openvdb::GridBase& grid, const Parts&... parts)
{
    std::ostringstream text;
    text << label(grid);
    (text << ... << parts);
    throw Error(ErrorCode::invalid_input, text.str());
}

void check_background(const openvdb::GridBase& grid)
{
    with_values(grid, [](const auto& values) {
        if (!(values.background() == 0)) {
            fail(values, "its background is ", values.background(),
                 ", but must be 0: infinite volumes are not supported");
        }
    });
}

}  // namespace

io::VdbReply make_header(const openvdb::GridBase& grid, std::uint64_t max_bytes)
{
    check_background(grid);
    CoordBBox box = grid.evalActiveVoxelBoundingBox();
    io::VdbReply header;
    if (box.empty()) {
        header.empty = 1;
        box = CoordBBox({0, 0, 0}, {0, 0, 0});
    }
    std::array<std::uint64_t, 3> sides{};
    std::uint64_t most = max_bytes / sizeof(float);
    constexpr std::uint64_t longest = 32768;
    bool fits = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t low = box.min()[axis];
        const std::int64_t high = box.max()[axis];
        sides[axis] = static_cast<std::uint64_t>(high - low + 3);  // one more on each side
        most /= sides[axis];
        fits = fits && sides[axis] <= longest && low > INT32_MIN && high < INT32_MAX;
        header.first[axis] = static_cast<std::int32_t>(low - 1);
        header.size[axis] = static_cast<std::uint32_t>(sides[axis]);
    }
    if (!fits || most == 0) {
        fail(grid, "its box of ", sides[0], " x ", sides[1], " x ", sides[2],
             " voxels is too large: the limit is ", max_bytes, " bytes, at 4 for each voxel, and ",
             longest, " voxels along a side");
    }
    // Row-major for row vectors is column-major for column vectors.
    const openvdb::Mat4d matrix = grid.transform().baseMap()->getAffineMap()->getMat4();
    std::copy_n(matrix.asPointer(), header.world_from_index.size(),
                header.world_from_index.begin());
    header.tree_bytes = grid.memUsage();
    const std::string name = plain(grid.getName());
    std::copy_n(name.begin(), std::min(name.size(), header.name.size() - 1), header.name.begin());
    return header;
}

std::uint64_t density_bytes(const io::VdbReply& header)
{
    return std::uint64_t{header.size[0]} * header.size[1] * header.size[2] * sizeof(float);
}

std::uint64_t slab_bytes(const io::VdbReply& header)
{
    return std::uint64_t{header.size[0]} * header.size[1] * slab_depth * sizeof(float);
}

void write_densities(const openvdb::GridBase& grid, const io::VdbReply& header,
                     const std::function<void(std::span<const float>)>& write)
{
    const Coord first(header.first[0], header.first[1], header.first[2]);
    const auto side = [&](int axis) {
        return static_cast<int>(header.size[static_cast<std::size_t>(axis)]);
    };
    const std::size_t slice = static_cast<std::size_t>(side(0)) * static_cast<std::size_t>(side(1));
    std::vector<float> values;
    for (int z = 0; z < side(2); z += slab_depth) {
        const int count = std::min(slab_depth, side(2) - z);
        const CoordBBox box(first.offsetBy(0, 0, z),
                            first.offsetBy(side(0) - 1, side(1) - 1, z + count - 1));
        values.resize(slice * static_cast<std::size_t>(count));
        openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(box, values.data());
        with_values(grid, [&](const auto& tree) {
            openvdb::tools::copyToDense(tree, dense, /*serial=*/true);
        });
        write(values);
    }
}

}  // namespace bdpt::vdb
