#pragma once

#include "math/sampler.h"

#include <array>
#include <cstdint>
#include <vector>

namespace bdpt::test {

/// All that a set of random numbers depends on.
struct SetKey {
    SamplerKind kind = SamplerKind::sobol;
    std::uint64_t seed = 0;
    int x = 0;
    int y = 0;
    SampleUse use = SampleUse::camera_walk;
    std::uint32_t vertex = 2;
    int log_samples = Sampler::open_ended;
};

/// The first four dimensions of a use at a vertex.
using SetNumbers = std::array<float, 4>;

[[nodiscard]] inline SetNumbers numbers(const SetKey& key, std::int64_t sample_index)
{
    Sampler sampler(key.kind, key.seed, key.x, key.y, sample_index, key.log_samples);
    sampler.start(key.use, key.vertex);
    const Vec2 a = sampler.next_2d();
    const Vec2 b = sampler.next_2d();
    return {a.x, a.y, b.x, b.y};
}

/// Returns points `first` to `first + count` of one half of the film: 0 for even and 1 for odd
/// samples.
[[nodiscard]] inline std::vector<SetNumbers> half_points(const SetKey& key, std::int64_t half,
                                                         std::int64_t first, std::int64_t count)
{
    std::vector<SetNumbers> points;
    for (std::int64_t i = first; i < first + count; ++i) {
        points.push_back(numbers(key, 2 * i + half));
    }
    return points;
}

}  // namespace bdpt::test
