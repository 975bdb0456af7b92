#pragma once

#include <bdpt/render_options.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace bdpt::eval {

/// Russian roulette as configured by `verify`. Densities do not include it: survivors are rarer,
/// and each counts for more, than the shares of a path imply. So survival has a lower limit that
/// keeps each contribution at most `max_roulette_weight` times that without roulette, however dark
/// the scene is.
class Roulette {
public:
    /// Edges after which roulette may end a walk, the default of renders.
    static constexpr int start = 3;
    static constexpr double max_roulette_weight = 4.0;

    /// Computes the weights for paths of up to `max_depth` edges.
    explicit Roulette(int max_depth) : weights_(static_cast<std::size_t>(max_depth + 2), 1.0)
    {
        if (max_depth > start) {
            min_survival_ = std::pow(max_roulette_weight, -1.0 / (max_depth - start));
        }
        for (int vertices = 0; vertices < max_depth + 2; ++vertices) {
            weights_[static_cast<std::size_t>(vertices)] =
                std::pow(min_survival_, -std::max(0, vertices - 1 - start));
        }
    }

    /// Returns the value of `TransportOptions::rr_survival`.
    [[nodiscard]] float min_survival() const { return static_cast<float>(min_survival_); }

    /// Returns the greatest factor that roulette applies to contributions of `strategy`; 1 where it
    /// ends no walk. For paths of up to `max_depth` edges.
    [[nodiscard]] double max_weight(Strategy strategy) const
    {
        return weights_[static_cast<std::size_t>(strategy.s)] *
               weights_[static_cast<std::size_t>(strategy.t)];
    }

private:
    double min_survival_ = 1.0;    // per edge
    std::vector<double> weights_;  // maximum weight of a subpath, by its number of vertices
};

}  // namespace bdpt::eval
