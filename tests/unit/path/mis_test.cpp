#include "path/path_weigher.h"

#include "catch.hpp"

#include <cmath>
#include <random>
#include <vector>

namespace bdpt::mis_test {
namespace {

/// A path with random densities, and strategies that exist or not.
struct RandomPath {
    std::vector<AreaPdf> from_light;
    std::vector<AreaPdf> from_camera;
    AreaPdf next_event;
    std::vector<float> sample_counts;
    std::vector<float> merge_weights;  ///< of some paths

    explicit RandomPath(std::mt19937& engine)
    {
        std::lognormal_distribution<float> density(0.0f, 2.0f);
        const std::size_t vertices = 2 + engine() % 9U;
        for (std::size_t i = 0; i < vertices; ++i) {
            from_light.push_back({density(engine)});
            from_camera.push_back({density(engine)});
        }
        next_event = {density(engine)};
        for (std::size_t s = 0; s <= vertices; ++s) {
            constexpr float counts[] = {0.0f, 1.0f, 1.0f, 4.0f};
            sample_counts.push_back(counts[engine() % 4U]);
        }
        sample_counts[engine() % sample_counts.size()] = 1.0f;
        if (engine() % 2U == 0) {
            return;
        }
        merge_weights.assign(vertices, 0.0f);
        for (std::size_t i = 1; i + 1 < vertices; ++i) {
            merge_weights[i] = engine() % 3U == 0 ? 0.0f : density(engine);
        }
    }

    [[nodiscard]] PathDensities densities() const
    {
        return {from_light, from_camera, next_event, sample_counts, merge_weights};
    }

    /// N_s p_s from the definition.
    [[nodiscard]] double density(std::size_t s) const
    {
        auto product = static_cast<double>(sample_counts[s]);
        for (std::size_t i = 0; i < from_light.size(); ++i) {
            const AreaPdf pdf = i >= s             ? from_camera[i]
                                : i == 0 && s == 1 ? next_event
                                                   : from_light[i];
            product *= static_cast<double>(pdf.value);
        }
        return product;
    }

    /// That of merging at x_i, which both walks sample.
    [[nodiscard]] double merge_density(std::size_t i) const
    {
        auto product = static_cast<double>(merge_weights[i]);
        for (std::size_t j = 0; j < from_light.size(); ++j) {
            product *= j <= i ? static_cast<double>(from_light[j].value) : 1.0;
            product *= j >= i ? static_cast<double>(from_camera[j].value) : 1.0;
        }
        return product;
    }
};

}  // namespace

TEST_CASE("MIS weights equal brute force and sum to one", "[mis]")
{
    std::mt19937 engine(1);
    for (int trial = 0; trial < 10000; ++trial) {
        const RandomPath path(engine);
        for (const auto heuristic : {Heuristic::balance, Heuristic::power}) {
            const auto share = [&](double p) { return heuristic == Heuristic::power ? p * p : p; };
            double total = 0.0;
            for (std::size_t s = 0; s < path.sample_counts.size(); ++s) {
                total += share(path.density(s));
            }
            for (std::size_t i = 0; i < path.merge_weights.size(); ++i) {
                total += share(path.merge_density(i));
            }
            double sum = 0.0;
            for (std::size_t i = 0; i < path.merge_weights.size(); ++i) {
                if (path.merge_weights[i] == 0.0f) {
                    continue;
                }
                const float weight = merge_weight(path.densities(), static_cast<int>(i), heuristic);
                sum += static_cast<double>(weight);
                REQUIRE(std::abs(static_cast<double>(weight) -
                                 share(path.merge_density(i)) / total) < 1e-6);
            }
            for (std::size_t s = 0; s < path.sample_counts.size(); ++s) {
                if (path.sample_counts[s] == 0.0f) {
                    continue;
                }
                const float weight = mis_weight(path.densities(), static_cast<int>(s), heuristic);
                sum += static_cast<double>(weight);
                REQUIRE(std::abs(static_cast<double>(weight) - share(path.density(s)) / total) <
                        1e-6);
            }
            REQUIRE(std::abs(sum - 1.0) < 1e-6);
        }
    }
}

TEST_CASE("the densities of all strategies at once are those of each", "[mis]")
{
    std::mt19937 engine(2);
    for (int trial = 0; trial < 10000; ++trial) {
        const RandomPath path(engine);
        std::vector<long double> densities(path.sample_counts.size());
        const long double all_merges = strategy_densities(path.densities(), densities);
        for (std::size_t s = 0; s < densities.size(); ++s) {
            REQUIRE(static_cast<double>(densities[s]) == Approx(path.density(s)).epsilon(1e-12));
            REQUIRE(static_cast<double>(strategy_density(path.densities(), s)) ==
                    Approx(path.density(s)).epsilon(1e-12));
        }
        double merges = 0.0;
        for (std::size_t i = 0; i < path.merge_weights.size(); ++i) {
            merges += path.merge_density(i);
        }
        REQUIRE(static_cast<double>(all_merges) == Approx(merges).epsilon(1e-12));
    }
}

TEST_CASE("MIS weights of long paths neither overflow nor vanish", "[mis]")
{
    constexpr std::size_t vertices = 60;
    std::vector<AreaPdf> from_light(vertices, {1e6f});
    std::vector<AreaPdf> from_camera(vertices, {1e-4f});
    std::vector<float> counts(vertices + 1, 1.0f);
    const PathDensities path{from_light, from_camera, {1.0f}, counts};
    CHECK(mis_weight(path, static_cast<int>(vertices), Heuristic::power) == Approx(1.0));
    CHECK(mis_weight(path, 5, Heuristic::power) == 0.0f);
    CHECK(mis_weight(path, 0, Heuristic::balance) == 0.0f);
}

}  // namespace bdpt::mis_test
