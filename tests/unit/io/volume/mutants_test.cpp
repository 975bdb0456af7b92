#include <bdpt/error.h>
#include <bdpt/io/volume.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>

#include "catch.hpp"
#include "vdb_fixture.h"

namespace bdpt::test::mutants_test {
namespace {

std::string mutant(std::string bytes, std::mt19937& random)
{
    const auto below = [&random](std::size_t end) { return random() % end; };
    if (below(8) == 0) {
        return bytes.substr(0, below(bytes.size()));
    }
    const std::size_t count = 1 + below(4);
    for (std::size_t i = 0; i < count; ++i) {
        // Heads are where most goes wrong.
        const std::size_t place = below(2) == 0 ? 8 + below(400) : below(bytes.size());
        bytes[place] = static_cast<char>(below(3) == 0 ? 0xff : below(256));
    }
    return bytes;
}

/// The most that a process had that this one has waited for [bytes].
std::uint64_t peak_of_children()
{
    rusage usage{};
    REQUIRE(getrusage(RUSAGE_CHILDREN, &usage) == 0);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace

TEST_CASE("broken OpenVDB files are refused or read, and do no harm", "[volume][long]")
{
    VdbFiles files;
    auto other = small_grid();
    other->setName("heat");
    std::string whole = read_text(files.write({askew_grid(), other}));
    std::mt19937 random(7);  // the same numbers everywhere
    io::VolumeOptions options;
    options.limits.volume_bytes = 64 << 20;
    options.limits.volume_seconds = 1;
    int read = 0;
    int refused = 0;
    for (int i = 0; i < 200; ++i) {
        const auto file = files.write(mutant(whole, random));
        try {
            const VolumeDesc volume = io::load_volume(file, options).volume;
            REQUIRE(volume.density.size() ==
                    std::size_t{volume.size.x} * volume.size.y * volume.size.z);
            REQUIRE(std::all_of(volume.density.begin(), volume.density.end(), [](float density) {
                return density >= 0.0f && std::isfinite(density);
            }));
            ++read;
        } catch (const Error& error) {
            CAPTURE(i, error.what());
            REQUIRE((error.code() == ErrorCode::invalid_input ||
                     error.code() == ErrorCode::unsupported));
            REQUIRE(std::string(error.what()).find('\n') == std::string::npos);
            UNSCOPED_INFO(error.what());
            ++refused;
        }
    }
    INFO(read << " read, " << refused << " refused");
    CHECK(read > 0);
    CHECK(refused > 50);
#ifndef BDPT_SANITIZED
    // Of readers; a length of a broken head may say anything.
    CHECK(peak_of_children() < std::uint64_t{320} << 20U);
#endif
}

}  // namespace bdpt::test::mutants_test
