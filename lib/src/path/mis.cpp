#include "path/mis.h"

#include <cassert>

namespace bdpt {

namespace {

/// Weights of the heuristics that compare all strategies with the best one. The densities of all
/// are products in the same order whoever asks, so that ties are broken alike for all.
float compared_weight(const PathDensities& path, std::size_t used, Heuristic heuristic)
{
    const std::size_t n = path.from_light.size();
    const auto density = [&](std::size_t s) { return strategy_density(path, s); };
    long double greatest = 0.0L;
    std::size_t first_greatest = 0;
    for (std::size_t s = 0; s <= n; ++s) {
        if (const long double p = density(s); p > greatest) {
            greatest = p;
            first_greatest = s;
        }
    }
    if (heuristic == Heuristic::maximum) {
        return used == first_greatest ? 1.0f : 0.0f;
    }
    constexpr long double cutoff = 0.1L;  // alpha [Veach 1997, sec. 9.2.3.2]
    const auto share = [&](long double p) {
        if (heuristic == Heuristic::uniform) {
            return p > 0.0L ? 1.0L : 0.0L;
        }
        return p >= cutoff * greatest ? p / greatest : 0.0L;
    };
    long double sum = 0.0L;
    for (std::size_t s = 0; s <= n; ++s) {
        sum += share(density(s));
    }
    return sum > 0.0L ? static_cast<float>(share(density(used)) / sum) : 0.0f;
}

}  // namespace

long double strategy_density(const PathDensities& path, std::size_t s)
{
    auto product = static_cast<long double>(path.sample_counts[s]);
    for (std::size_t i = 0; i < path.from_light.size() && product > 0.0L; ++i) {
        const AreaPdf pdf = i >= s             ? path.from_camera[i]
                            : i == 0 && s == 1 ? path.next_event
                                               : path.from_light[i];
        product *= static_cast<long double>(pdf.value);
    }
    return product;
}

float mis_weight(const PathDensities& path, int s, Heuristic heuristic)
{
    if (heuristic != Heuristic::balance && heuristic != Heuristic::power) {
        return compared_weight(path, static_cast<std::size_t>(s), heuristic);
    }
    const auto& light = path.from_light;
    const auto& camera = path.from_camera;
    const auto& counts = path.sample_counts;
    const auto used = static_cast<std::size_t>(s);
    assert(camera.size() == light.size() && counts.size() == light.size() + 1);
    assert(counts[used] > 0.0f);

    // In double, for the products over a long path leave the range of float.
    double sum = 1.0;
    const auto add = [&](std::size_t other, double density_ratio) {
        const double ratio = density_ratio * static_cast<double>(counts[other] / counts[used]);
        sum += heuristic == Heuristic::power ? ratio * ratio : ratio;
    };
    const auto quotient = [](AreaPdf a, AreaPdf b) {
        return static_cast<double>(a.value) / static_cast<double>(b.value);
    };
    // Every divisor below is a density that strategy s really sampled, so it is never zero.

    // Hand vertices s, s+1, ... over to the light, one at a time.
    double ratio = used == 1 ? quotient(light[0], path.next_event) : 1.0;
    for (std::size_t i = used; i < light.size(); ++i) {
        if (i == 0 && counts[1] > 0.0f) {
            add(1, quotient(path.next_event, camera[0]));
        }
        ratio *= quotient(light[i], camera[i]);
        if (i > 0 && counts[i + 1] > 0.0f) {
            add(i + 1, ratio);
        }
    }

    // Hand vertices s-1, s-2, ... over to the camera.
    ratio = 1.0;
    for (std::size_t i = used; i-- > 1;) {
        ratio *= quotient(camera[i], light[i]);
        if (counts[i] > 0.0f) {
            add(i, i == 1 ? ratio * quotient(path.next_event, light[0]) : ratio);
        }
    }
    if (used > 0 && counts[0] > 0.0f) {
        add(0, ratio * quotient(camera[0], used == 1 ? path.next_event : light[0]));
    }
    return static_cast<float>(1.0 / sum);
}

}  // namespace bdpt
