// The part of the shared light paths that each pixel takes its own from.

#include "integrator/bidirectional/pixel_groups.h"

#include "catch.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

namespace bdpt::test::pixel_groups_test {
namespace {

constexpr std::uint32_t seed = 0x9e3779b9U;

/// Returns the bundle of that place.
std::int64_t bundle_at(std::uint32_t place, std::int64_t bundles)
{
    return static_cast<std::int64_t>((std::uint64_t{place} * static_cast<std::uint64_t>(bundles)) >>
                                     32U);
}

}  // namespace

TEST_CASE("groups have light paths for each pixel of a block, and blocks of their own",
          "[light-paths]")
{
    constexpr std::int64_t block = 256;  // pixels
    CHECK(PixelGroups(1 << 20, 0).groups() == 1);
    CHECK(PixelGroups(1 << 20, 2 * block - 1).groups() == 1);
    CHECK(PixelGroups(1 << 20, 2 * block).groups() == 2);
    CHECK(PixelGroups(1 << 20, 9 * block).groups() == 8);
    CHECK(PixelGroups(31 * block, 1 << 20).groups() == 1);
    CHECK(PixelGroups(64 * block, 1 << 20).groups() == 4);
    CHECK(PixelGroups(std::int64_t{65536} * 65536, std::int64_t{65536} * 65536).groups() ==
          1 << 20);
}

TEST_CASE("the blocks of a group are spread over the image", "[light-paths]")
{
    const PixelGroups groups(512 * 512, 2048);
    REQUIRE(groups.groups() == 8);  // in turn: four along x, two along y
    for (int y = 0; y < 512; y += 7) {
        for (int x = 0; x < 512; x += 5) {
            REQUIRE(groups.group(x, y) < groups.groups());
            REQUIRE(groups.group(x, y) == groups.group(x / 16 * 16, y / 16 * 16));
            REQUIRE(groups.group(x, y) == groups.group(x + 64, y));
            REQUIRE(groups.group(x, y) == groups.group(x, y + 32));
            REQUIRE(groups.group(x, y) != groups.group(x + 16, y));
            REQUIRE(groups.group(x, y) != groups.group(x + 32, y));
            REQUIRE(groups.group(x, y) != groups.group(x, y + 16));
        }
    }
}

TEST_CASE("each group takes light paths from a part of its own", "[light-paths]")
{
    constexpr int side = 256;
    constexpr std::int64_t bundles = 4096;
    const PixelGroups groups(side * side, bundles);
    REQUIRE(groups.groups() == 16);
    std::map<std::uint32_t, std::set<std::int64_t>> parts;
    std::vector<int> uses(bundles);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const std::int64_t bundle = bundle_at(groups.place(x, y, seed, 0), bundles);
            ++uses[static_cast<std::size_t>(bundle)];
            for (const std::uint32_t offset : {0U, 1U << 30U, 1U << 31U, 3U << 30U}) {
                parts[groups.group(x, y)].insert(
                    bundle_at(groups.place(x, y, seed, offset), bundles) * 16 / bundles);
            }
        }
    }
    std::set<std::int64_t> all;
    for (const auto& [group, part] : parts) {
        CHECK(part.size() == 1);
        all.insert(part.begin(), part.end());
    }
    CHECK(all.size() == 16);
    // All light paths are used equally often.
    CHECK(std::ranges::count(uses, side * side / static_cast<int>(bundles)) == bundles);
}

TEST_CASE("pixels of a block, and samples of a pixel, take different light paths", "[light-paths]")
{
    constexpr int side = 512;
    constexpr std::int64_t bundles = 2048;
    const PixelGroups groups(side * side, bundles);
    for (const auto& [x0, y0] : {std::array{0, 0}, std::array{48, 160}, std::array{496, 496}}) {
        std::set<std::int64_t> of_block;
        for (int y = y0; y < y0 + 16; ++y) {
            for (int x = x0; x < x0 + 16; ++x) {
                of_block.insert(bundle_at(groups.place(x, y, seed, 0), bundles));
            }
        }
        CHECK(of_block.size() == 256);
        std::set<std::int64_t> of_pixel;
        for (std::uint32_t i = 0; i < 8; ++i) {
            of_pixel.insert(bundle_at(groups.place(x0, y0, seed, i << 29U), bundles));
        }
        CHECK(of_pixel.size() == 8);
    }
}

}  // namespace bdpt::test::pixel_groups_test
