#include <bdpt/error.h>
#include <bdpt/io/volume.h>

#include <openvdb/points/PointDataGrid.h>

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "catch.hpp"
#include "vdb_fixture.h"

namespace bdpt::test::refusals_test {
namespace {

/// Loads what must be refused with `code`, in one line that names the file and holds `parts`.
void refuse(const std::filesystem::path& file, ErrorCode code,
            const std::vector<std::string>& parts, const io::VolumeOptions& options = {})
{
    try {
        static_cast<void>(io::load_volume(file, options));
        FAIL("was not refused");
    } catch (const Error& error) {
        const std::string message = error.what();
        CAPTURE(message);
        CHECK(error.code() == code);
        CHECK(message.starts_with(file.string() + ": "));
        CHECK(message.find('\n') == std::string::npos);
        for (const std::string& part : parts) {
            CAPTURE(part);
            CHECK(message.find(part) != std::string::npos);
        }
    }
}

std::string bytes_of(const std::filesystem::path& file)
{
    return read_text(file);
}

constexpr ErrorCode invalid = ErrorCode::invalid_input;
constexpr ErrorCode unsupported = ErrorCode::unsupported;

}  // namespace

TEST_CASE("what is no whole OpenVDB file is refused", "[volume]")
{
    VdbFiles files;
    refuse("/nowhere/smoke.vdb", ErrorCode::not_found, {"no such file"});
    refuse("/dev/null", ErrorCode::not_found, {"not a regular file"});
    refuse(files.write(""), invalid, {"not an OpenVDB file", "empty"});
    refuse(files.write("\x89PNG\r\n\x1a\n and more"), unsupported, {"not an OpenVDB file", "PNG"});
    refuse(files.write("{\"asset\": {}}"), unsupported, {"not an OpenVDB file"});
    const std::string whole = bytes_of(files.write({small_grid()}));
    for (std::size_t size = 8; size < whole.size(); size += 1 + size / 3) {
        CAPTURE(size);
        refuse(files.write(whole.substr(0, size)), invalid, {"broken: "});
    }
    // OpenVDB takes what is missing for zeros.
    const std::string smoke = bytes_of(std::filesystem::path(BDPT_SOURCE_DIR) / "scenes/smoke.vdb");
    refuse(files.write(smoke.substr(0, smoke.size() - 1)), invalid,
           {"broken: grid 0 ends at byte"});
    std::string newer = whole;
    newer[8] = '\xe7';  // 999
    newer[9] = '\x03';
    refuse(files.write(newer), unsupported, {"version 999", "224"});
}

TEST_CASE("grids of OpenVDB files that have no densities are refused", "[volume]")
{
    VdbFiles files;
    const auto density = small_grid();
    auto vectors = openvdb::Vec3SGrid::create();
    vectors->setName("v");
    auto flags = openvdb::BoolGrid::create();
    flags->setName("flags");
    auto numbers = openvdb::Int32Grid::create();
    numbers->setName("density");
    auto points = openvdb::points::PointDataGrid::create();
    points->setName("points");

    refuse(files.write({density, vectors}), invalid,
           {"no grid \"smoke\"", "density (float)", "v (vec3s)"}, {.grid = "smoke"});
    refuse(files.write({density, vectors}), unsupported, {"grid \"v\"", "vec3s"}, {.grid = "v"});
    refuse(files.write({flags, points}), unsupported, {"grid \"points\"", "ptdataidx32"},
           {.grid = "points"});
    refuse(files.write({flags}), unsupported, {"grid \"flags\"", "bool"}, {.grid = "flags"});
    refuse(files.write({flags, vectors}), unsupported,
           {"no float grid", "flags (bool)", "v (vec3s)"});
    refuse(files.write({numbers}), unsupported, {"grid \"density\"", "int32"});
    refuse(files.write(std::vector<openvdb::GridBase::Ptr>{}), invalid, {"no grids"});

    auto smoke = small_grid();
    smoke->setName("smoke\n2");
    auto heat = small_grid();
    heat->setName("heat");
    refuse(files.write({smoke, heat}), invalid,
           {"several float grids", "smoke?2 (float)", "heat (float)"});

    // Two of one name, with or without asking for it.
    const auto twins = files.write({density, density->deepCopy()});
    for (const std::optional<std::string>& name : {std::optional<std::string>(), {"density"}}) {
        refuse(twins, invalid,
               {"2 grids are called \"density\"", "--volume-grid \"density[0]\"",
                "density[0] (float), density[1] (float)"},
               {.grid = name});
    }
    refuse(twins, invalid, {"no grid \"dens\""}, {.grid = "dens"});

    auto surface = small_grid();
    surface->setGridClass(openvdb::GRID_LEVEL_SET);
    refuse(files.write({surface}), invalid, {"grid \"density\"", "level set"});
    auto staggered = small_grid();
    staggered->setGridClass(openvdb::GRID_STAGGERED);
    refuse(files.write({staggered}), invalid, {"grid \"density\"", "staggered"});

    auto frustum = small_grid();
    frustum->setTransform(openvdb::math::Transform::createFrustumTransform(
        openvdb::BBoxd({0, 0, 0}, {9, 9, 9}), 0.5, 10.0));
    refuse(files.write({frustum}), unsupported, {"grid \"density\"", "NonlinearFrustumMap"});
    auto vast = small_grid();
    vast->setTransform(openvdb::math::Transform::createLinearTransform(1e13));
    refuse(files.write({vast}), invalid, {"grid \"density\"", "inverted"});
}

TEST_CASE("densities of OpenVDB files that make no medium are refused", "[volume]")
{
    VdbFiles files;
    auto overflowed = small_grid();
    overflowed->tree().setValue({1, 2, 3}, std::numeric_limits<float>::infinity());
    refuse(files.write({overflowed}), invalid, {"grid \"density\": voxel (1, 2, 3)", "infinite"});
    auto doubles = openvdb::DoubleGrid::create(0.0);
    doubles->setName("density");
    doubles->tree().setValue({0, 0, 9}, 1e300);
    refuse(files.write({doubles}), invalid, {"voxel (0, 0, 9)", "infinite"});

    auto endless = openvdb::FloatGrid::create(0.5f);
    endless->setName("density");
    endless->tree().setValue({0, 0, 0}, 1.0f);
    refuse(files.write({endless}), invalid, {"grid \"density\"", "background is 0.5"});
}

TEST_CASE("OpenVDB files that stand for too much are refused", "[volume]")
{
    VdbFiles files;
    auto wide = small_grid();
    wide->tree().setValue({3000, 2000, 1000}, 1.0f);
    refuse(files.write({wide}), invalid,
           {"grid \"density\"", "3003 x 2003 x 1003", "4294967296 bytes"});
    auto longest = small_grid();
    longest->tree().setValue({2000000000, 0, 0}, 1.0f);
    longest->tree().setValue({-2000000000, 0, 0}, 1.0f);
    refuse(files.write({longest}), invalid, {"4000000003 x 6 x 6", "32768"});
    auto last = small_grid();
    last->tree().setValue({0, 0, std::numeric_limits<int>::max()}, 1.0f);
    refuse(files.write({last}), invalid, {"too large"});
    // Tiles of a few bytes.
    auto full = openvdb::FloatGrid::create(0.0f);
    full->setName("density");
    full->tree().addTile(2, {0, 0, 0}, 1.0f, true);
    full->tree().addTile(3, {4096, 0, 0}, 1.0f, true);
    refuse(files.write({full}), invalid, {"too large"});

    const auto file = files.write({small_grid()});
    io::VolumeOptions options;
    options.limits.volume_bytes = 6 * 6 * 6 * 4;
    CHECK(io::load_volume(file, options).volume.size == UVec3(6));
    options.limits.volume_bytes -= 1;
    refuse(file, invalid, {"6 x 6 x 6", "863 bytes"}, options);
    options.limits = {};
    options.limits.file_bytes = 100;
    refuse(file, invalid, {"the limit is 100"}, options);
}

}  // namespace bdpt::test::refusals_test
