#include "path/mis.h"

#include <cassert>

namespace bdpt {

namespace {

/// Returns the weight of the heuristics that compare all strategies with the best one. The
/// densities of all are products in the same order for every caller, so that ties are broken
/// consistently.
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

/// Sum over strategies in the balance and power heuristics, relative to the strategy in use. Every
/// divisor is a density with which it sampled, so it is never zero.
class RelativeSum {
public:
    /// `own` is the number of samples of the strategy in use, if it is not in the ratios.
    RelativeSum(const PathDensities& path, Heuristic heuristic, float own)
        : path_(path), squares_(heuristic == Heuristic::power), own_(own)
    {}

    /// Moves vertices from, from + 1, ... to the light subpath, one at a time; `ratio` is that of
    /// the vertices already moved.
    void hand_to_light(std::size_t from, double ratio)
    {
        const auto& light = path_.from_light;
        const auto& camera = path_.from_camera;
        for (std::size_t i = from; i < light.size(); ++i) {
            if (i == 0 && path_.sample_counts[1] > 0.0f) {
                add(path_.sample_counts[1], quotient(path_.next_event, camera[0]));
            }
            add_merge(i, ratio, light[i]);
            ratio *= quotient(light[i], camera[i]);
            if (i > 0 && path_.sample_counts[i + 1] > 0.0f) {
                add(path_.sample_counts[i + 1], ratio);
            }
        }
    }
    /// Moves vertices from - 1, from - 2, ... to the camera subpath; x_0 is sampled with density
    /// `start`.
    void hand_to_camera(std::size_t from, double ratio, AreaPdf start)
    {
        const auto& light = path_.from_light;
        const auto& camera = path_.from_camera;
        for (std::size_t i = from; i-- > 1;) {
            add_merge(i, ratio, camera[i]);
            ratio *= quotient(camera[i], light[i]);
            if (path_.sample_counts[i] > 0.0f) {
                add(path_.sample_counts[i],
                    i == 1 ? ratio * quotient(path_.next_event, light[0]) : ratio);
            }
        }
        if (from > 0 && path_.sample_counts[0] > 0.0f) {
            add(path_.sample_counts[0], ratio * quotient(camera[0], start));
        }
    }
    void add(float count, double density_ratio)
    {
        const double ratio = density_ratio * static_cast<double>(count / own_);
        sum_ += squares_ ? ratio * ratio : ratio;
    }
    [[nodiscard]] float weight() const { return static_cast<float>(1.0 / sum_); }

    static double quotient(AreaPdf a, AreaPdf b)
    {
        return static_cast<double>(a.value) / static_cast<double>(b.value);
    }

private:
    /// Adds the term of sampling x_i from both sides: `other` is the density of the side that did
    /// not sample it.
    void add_merge(std::size_t i, double ratio, AreaPdf other)
    {
        if (!path_.merge_weights.empty() && path_.merge_weights[i] > 0.0f) {
            add(path_.merge_weights[i], ratio * static_cast<double>(other.value));
        }
    }

    const PathDensities& path_;
    bool squares_;
    float own_;
    double sum_ = 1.0;  // in double, because the products over a long path exceed the range of
                        // float
};

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

long double strategy_densities(const PathDensities& path, std::span<long double> densities)
{
    const std::size_t n = path.from_light.size();
    long double from_camera = 1.0L;
    densities[n] = 1.0L;
    for (std::size_t i = n; i-- > 0;) {
        from_camera *= static_cast<long double>(path.from_camera[i].value);
        densities[i] = from_camera;
    }
    long double from_light = 1.0L;
    long double merges = 0.0L;
    for (std::size_t s = 0; s <= n; ++s) {
        const long double start =
            s == 1 ? static_cast<long double>(path.next_event.value) : from_light;
        const long double rest = densities[s];
        const float count = path.sample_counts[s];
        densities[s] = count > 0.0f ? static_cast<long double>(count) * start * rest : 0.0L;
        if (s < n) {
            from_light *= static_cast<long double>(path.from_light[s].value);
            if (!path.merge_weights.empty() && path.merge_weights[s] > 0.0f) {
                merges += static_cast<long double>(path.merge_weights[s]) * from_light * rest;
            }
        }
    }
    return merges;
}

float mis_weight(const PathDensities& path, int s, Heuristic heuristic)
{
    if (heuristic != Heuristic::balance && heuristic != Heuristic::power) {
        return compared_weight(path, static_cast<std::size_t>(s), heuristic);
    }
    const auto used = static_cast<std::size_t>(s);
    assert(path.from_camera.size() == path.from_light.size() &&
           path.sample_counts.size() == path.from_light.size() + 1);
    assert(path.sample_counts[used] > 0.0f);
    const AreaPdf start = used == 1 ? path.next_event : path.from_light[0];
    RelativeSum sum(path, heuristic, path.sample_counts[used]);
    sum.hand_to_light(used, used == 1 ? RelativeSum::quotient(path.from_light[0], start) : 1.0);
    sum.hand_to_camera(used, 1.0, start);
    return sum.weight();
}

float merge_weight(const PathDensities& path, int i, Heuristic heuristic)
{
    const auto merged = static_cast<std::size_t>(i);
    const auto& counts = path.sample_counts;
    const double count = static_cast<double>(path.merge_weights[merged]);
    assert(count > 0.0 && merged > 0 && merged + 1 < path.from_light.size());
    RelativeSum sum(path, heuristic, 1.0f);
    // Without sampling x_i from the camera, or from the light.
    const double by_light = 1.0 / (count * static_cast<double>(path.from_camera[merged].value));
    const double by_camera = 1.0 / (count * static_cast<double>(path.from_light[merged].value));
    sum.add(counts[merged + 1], by_light);
    sum.hand_to_light(merged + 1, by_light);
    sum.add(counts[merged],
            merged == 1 ? by_camera * RelativeSum::quotient(path.next_event, path.from_light[0])
                        : by_camera);
    sum.hand_to_camera(merged, by_camera, path.from_light[0]);
    return sum.weight();
}

}  // namespace bdpt
