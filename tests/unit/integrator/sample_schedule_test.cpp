#include "integrator/sample_schedule.h"

#include "catch.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

namespace bdpt::test::sample_schedule_test {
namespace {

/// A row of pixels, one of each rate.
RenderOptions options_with_rates()
{
    RenderOptions options;
    options.sampling.rates =
        std::make_shared<const SampleRates>(5, 1, std::vector<std::int8_t>{-2, -1, 0, 1, 2});
    return options;
}

std::vector<ScheduledSample> samples_of(const SampleSchedule& schedule, int x, SampleRange rounds)
{
    std::vector<ScheduledSample> result;
    schedule.for_each(x, 0, rounds, [&](const ScheduledSample& one) { result.push_back(one); });
    return result;
}

}  // namespace

TEST_CASE("each group of rounds takes the next samples of both halves", "[rates]")
{
    const RenderOptions options = options_with_rates();
    const SampleSchedule schedule(options);
    for (int x = 0; x < 5; ++x) {
        const float rate = options.sampling.rates->rate(x, 0);
        std::vector<std::int64_t> indices;
        for (std::int64_t begin = 0; begin < 32; begin += SampleRates::group) {
            float weight_of_halves[2] = {0.0f, 0.0f};
            for (const ScheduledSample& one :
                 samples_of(schedule, x, {.begin = begin, .end = begin + SampleRates::group})) {
                indices.push_back(one.index);
                CHECK((one.index & 1) == (one.round & 1));
                CHECK(one.round >= begin);
                CHECK(one.round < begin + SampleRates::group);
                CHECK(one.scale.camera == 1.0f / rate);
                CHECK(one.scale.splat == Approx(1.0 / 1.55).epsilon(1e-6));
                weight_of_halves[one.index & 1] += one.scale.camera;
            }
            // The sums are those of so many rounds, in each half.
            CHECK(weight_of_halves[0] == 4.0f);
            CHECK(weight_of_halves[1] == 4.0f);
            // No sample is left out, none is taken twice.
            std::sort(indices.begin(), indices.end());
            CHECK(indices.size() ==
                  static_cast<std::size_t>(rate * static_cast<float>(begin + SampleRates::group)));
            for (std::size_t i = 0; i < indices.size(); ++i) {
                CHECK(indices[i] == static_cast<std::int64_t>(i));
            }
        }
    }
}

TEST_CASE("samples of a round have different turns", "[rates]")
{
    const RenderOptions options = options_with_rates();
    const auto four = samples_of(SampleSchedule(options), 4, {.begin = 3, .end = 4});
    REQUIRE(four.size() == 4);
    for (std::uint32_t i = 0; i < 4; ++i) {
        CHECK(four[i].sub_index == i << 30U);
    }
}

TEST_CASE("samples are counted in any rounds", "[rates]")
{
    const RenderOptions options = options_with_rates();
    const SampleSchedule schedule(options);
    for (int x = 0; x < 5; ++x) {
        for (std::int64_t begin = 0; begin < 18; ++begin) {
            for (std::int64_t end = begin; end < 20; ++end) {
                const SampleRange rounds{.begin = begin, .end = end};
                CHECK(schedule.count(x, 0, rounds) ==
                      static_cast<std::int64_t>(samples_of(schedule, x, rounds).size()));
            }
        }
    }
}

TEST_CASE("without rates each round is one sample", "[rates]")
{
    const RenderOptions options;
    const SampleSchedule schedule(options);
    const auto samples = samples_of(schedule, 0, {.begin = 5, .end = 9});
    REQUIRE(samples.size() == 4);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        CHECK(samples[i].index == static_cast<std::int64_t>(5 + i));
        CHECK(samples[i].round == samples[i].index);
        CHECK(samples[i].sub_index == 0);
        CHECK(samples[i].scale.camera == 1.0f);
        CHECK(samples[i].scale.splat == 1.0f);
    }
    CHECK(schedule.count(7, 7, {.begin = 5, .end = 9}) == 4);
}

}  // namespace bdpt::test::sample_schedule_test
