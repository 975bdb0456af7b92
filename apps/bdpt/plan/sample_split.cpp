#include "plan/sample_split.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace bdpt::app {
namespace {

constexpr std::int64_t best_unit = 64;  // samples

std::int64_t divided_up(std::int64_t a, std::int64_t b)
{
    return a / b + (a % b != 0 ? 1 : 0);
}

}  // namespace

std::vector<SampleRange> split_samples(SampleRange samples, std::int64_t parts, std::int64_t least)
{
    std::int64_t unit = best_unit;
    const auto blocks = [&] { return divided_up(samples.end, unit) - samples.begin / unit; };
    while (blocks() < parts && unit > least) {
        unit /= 2;
    }
    const std::int64_t first = samples.begin / unit;
    const auto boundary = [&](std::int64_t part) {
        return std::clamp((first + part * blocks() / parts) * unit, samples.begin, samples.end);
    };
    std::vector<SampleRange> result;
    for (std::int64_t part = 0; part < parts; ++part) {
        result.push_back({.begin = boundary(part), .end = boundary(part + 1)});
    }
    return result;
}

std::int64_t parts_of_time(SampleRange samples, double seconds, double seconds_per_sample,
                           double seconds_to_start, std::int64_t least)
{
    const std::int64_t total = samples.end - samples.begin;
    const double fitting = std::floor((seconds - seconds_to_start) / seconds_per_sample);
    auto count = static_cast<std::int64_t>(std::clamp(fitting, 1.0, static_cast<double>(total)));
    count = std::clamp(count, std::min(least, total), total);
    if (count < total) {
        count = count >= best_unit
                    ? count / best_unit * best_unit
                    : static_cast<std::int64_t>(std::bit_floor(static_cast<std::uint64_t>(count)));
    }
    return divided_up(total, count);
}

}  // namespace bdpt::app
