#include "smoke_plume.h"

#include <bdpt/io/volume.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>

#include "catch.hpp"

namespace bdpt::test::smoke_plume_test {
namespace {

const auto file = std::filesystem::path(BDPT_SOURCE_DIR) / "scenes" / "smoke.vdb";

}  // namespace

// This runs only when it is asked for by its tag.
TEST_CASE("write scenes/smoke.vdb", "[.write-smoke]")
{
    openvdb::initialize();
    openvdb::io::File out(file.string());
    out.setCompression(openvdb::io::COMPRESS_ZIP | openvdb::io::COMPRESS_ACTIVE_MASK);
    out.write({smoke_plume()});
}

TEST_CASE("scenes/smoke.vdb is what this program writes", "[volume][long]")
{
    openvdb::initialize();
    CHECK(std::filesystem::file_size(file) < 150'000);
    const VolumeDesc volume = io::load_volume(file).volume;
    const auto grid = test::smoke_plume();
    const auto box = grid->evalActiveVoxelBoundingBox();
    const auto side = [&](std::size_t axis) {
        return static_cast<std::uint32_t>(box.dim()[axis] + 2);
    };
    REQUIRE(volume.size == UVec3(side(0), side(1), side(2)));
    std::size_t voxel = 0;
    for (int z = box.min().z() - 1; z <= box.max().z() + 1; ++z) {
        for (int y = box.min().y() - 1; y <= box.max().y() + 1; ++y) {
            for (int x = box.min().x() - 1; x <= box.max().x() + 1; ++x) {
                REQUIRE(volume.density[voxel++] == grid->tree().getValue({x, y, z}));
            }
        }
    }
    CHECK(*std::max_element(volume.density.begin(), volume.density.end()) > 0.5f);
}

}  // namespace bdpt::test::smoke_plume_test
