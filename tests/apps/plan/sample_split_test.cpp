#include "plan/plan.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "catch.hpp"

namespace bdpt::job::sample_split_test {
namespace {

std::vector<std::int64_t> ends(const std::vector<SampleRange>& ranges)
{
    std::vector<std::int64_t> result;
    for (const SampleRange& range : ranges) {
        result.push_back(range.end);
    }
    return result;
}

TEST_CASE("samples are split into ranges of about one size that leave out none")
{
    for (const SampleRange samples : {SampleRange{0, 4096}, SampleRange{0, 1}, SampleRange{0, 300},
                                      SampleRange{100, 1001}, SampleRange{63, 65}}) {
        const std::int64_t count = samples.end - samples.begin;
        for (std::int64_t parts = 1; parts <= std::min<std::int64_t>(count, 70); ++parts) {
            const std::vector<SampleRange> ranges = split_samples(samples, parts);
            CAPTURE(samples.begin, samples.end, parts, ends(ranges));
            REQUIRE(ranges.size() == static_cast<std::size_t>(parts));
            std::int64_t end = samples.begin;
            for (const SampleRange& range : ranges) {
                CHECK(range.begin == end);
                CHECK(range.begin < range.end);
                end = range.end;
            }
            CHECK(end == samples.end);
        }
    }
}

TEST_CASE("ranges end at multiples of 64, or of smaller powers of two where there are too few")
{
    using Ends = std::vector<std::int64_t>;
    CHECK(ends(split_samples({0, 512}, 4)) == Ends{128, 256, 384, 512});
    CHECK(ends(split_samples({0, 300}, 3)) == Ends{64, 192, 300});
    CHECK(ends(split_samples({0, 300}, 5)) == Ends{64, 128, 192, 256, 300});
    CHECK(ends(split_samples({0, 300}, 6)) == Ends{32, 96, 160, 192, 256, 300});
    CHECK(ends(split_samples({100, 300}, 2)) == Ends{192, 300});
    CHECK(ends(split_samples({0, 5}, 5)) == Ends{1, 2, 3, 4, 5});
}

TEST_CASE("the number of parts is what fits into the time")
{
    CHECK(parts_of_time({0, 4096}, 128.0, 1.0, 0.0) == 32);
    CHECK(parts_of_time({0, 4096}, 191.0, 1.0, 0.0) == 32);
    CHECK(parts_of_time({0, 4096}, 130.0, 1.0, 3.0) == 64);  // starting counts
    CHECK(parts_of_time({0, 64}, 40.0, 1.0, 0.0) == 2);
    CHECK(parts_of_time({0, 64}, 1.0, 60.0, 100.0) == 64);  // at least one sample each
    CHECK(parts_of_time({0, 64}, 1e9, 1.0, 0.0) == 1);
    CHECK(parts_of_time({100, 164}, 32.0, 1.0, 0.0) == 2);
}

}  // namespace
}  // namespace bdpt::job::sample_split_test
