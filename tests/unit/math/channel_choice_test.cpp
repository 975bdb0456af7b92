#include "math/rgb.h"

#include "catch.hpp"

#include <array>
#include <limits>

namespace bdpt::channel_choice_test {
namespace {

constexpr int count = 4096;

/// Returns how often each channel is chosen by evenly spaced numbers.
std::array<double, 3> shares(Rgb beta)
{
    const ChannelChoice choice(beta);
    std::array<double, 3> chosen{};
    for (int i = 0; i < count; ++i) {
        const float u = (static_cast<float>(i) + 0.5f) / count;
        chosen.at(static_cast<std::size_t>(choice.sample(u))) += 1.0 / count;
    }
    return chosen;
}

}  // namespace

TEST_CASE("each channel is as probable as its share of the throughput", "[media]")
{
    constexpr float largest = std::numeric_limits<float>::max();
    constexpr float least = std::numeric_limits<float>::denorm_min();
    const std::array<std::pair<Rgb, Rgb>, 8> cases{{{Rgb(1.0f), Rgb(1.0f / 3.0f)},
                                                    {{6.0f, 3.0f, 1.0f}, {0.6f, 0.3f, 0.1f}},
                                                    {{2e-30f, 0.0f, 6e-30f}, {0.25f, 0.0f, 0.75f}},
                                                    {{0.0f, 1.0f, 0.0f}, {0.0f, 1.0f, 0.0f}},
                                                    {{0.0f, 0.0f, 7.0f}, {0.0f, 0.0f, 1.0f}},
                                                    // No shares can be computed of these.
                                                    {Rgb(0.0f), Rgb(1.0f / 3.0f)},
                                                    {Rgb(least), Rgb(1.0f / 3.0f)},
                                                    {Rgb(largest), Rgb(1.0f / 3.0f)}}};
    for (const auto& [beta, expected] : cases) {
        CAPTURE(beta.r, beta.g, beta.b);
        const auto chosen = shares(beta);
        const ChannelChoice choice(beta);
        for (int channel = 0; channel < 3; ++channel) {
            const auto share = static_cast<double>(expected[channel]);
            CHECK(chosen.at(static_cast<std::size_t>(channel)) ==
                  Approx(share).margin(1.0 / count));
            Rgb one(0.0f);
            one[channel] = 1.0f;
            CHECK(choice.mean(one) == Approx(share));
        }
    }
}

TEST_CASE("no number chooses a channel without throughput", "[media]")
{
    constexpr float last = 1.0f - 0x1p-24f;
    for (int i = 1; i < 1000; ++i) {
        const auto red = static_cast<float>(i);
        REQUIRE(ChannelChoice({red, 1.0f, 0.0f}).sample(last) == 1);
        REQUIRE(ChannelChoice({red, 0.0f, 0.0f}).sample(last) == 0);
        REQUIRE(ChannelChoice({0.0f, red, 1.0f}).sample(0.0f) == 1);
    }
}

}  // namespace bdpt::channel_choice_test
