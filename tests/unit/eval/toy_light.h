#pragma once

#include "verify/evidence.h"

#include <bdpt/path_contribution.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "statistics.h"

namespace bdpt::test {

/// How a toy renderer is wrong; as it stands it is right.
struct ToyFault {
    std::array<double, 4> factors{1.0, 1.0, 1.0, 1.0};      ///< of what the strategies find, by s
    std::array<double, 4> integrators{1.0, 1.0, 1.0, 1.0};  ///< of pt, nee, mis, lt
    double weights = 1.0;                                   ///< of all weights
    double own_density = 1.0;  ///< of strategy 1, as the others think of it
    bool claims_all = false;   ///< strategy 2 is thought to see all that it is blind for
    bool only_left = false;    ///< the factors hold in the left half of the image only
    Rgb tint{1.0f};            ///< of what strategy 0 finds
    Rgb tint_of_mis{1.0f};
};

/// A renderer whose paths of two edges are points x of [0, 1), all of them as bright: 1 nit.
/// Strategy 0 samples x uniformly; 1 with density 2 x, which has no finite variance; 2 sees x >=
/// 0.3 only; 3 finds x < 0.01 only.
class ToyLight {
public:
    static constexpr double blind = 0.3;
    static constexpr double rare = 0.01;

    ToyLight(std::uint64_t seed, ToyFault fault) : random_(seed), fault_(fault) {}

    /// A batch of an image of 4 x 4 pixels.
    eval::Batch batch(const eval::TileGrid& grid)
    {
        using namespace eval;
        Batch result = empty(grid, Measure::mean);
        for (const Measure channel : channel_measures) {
            result.channels.push_back(empty(TileGrid(4, 4, 1), channel));
        }
        for (int pixel = 0; pixel < 16; ++pixel) {
            const Vec2 raster(static_cast<float>(pixel % 4) + 0.5f,
                              static_cast<float>(pixel / 4) + 0.5f);
            for (int i = 0; i < bdpt_samples; ++i) {
                for (std::size_t s = 0; s < 4; ++s) {
                    add_bdpt(result, s, raster);
                }
            }
            for (std::size_t other = 0; other < result.others.size(); ++other) {
                for (int i = 0; i < count_samples(other_integrators[other], 2); ++i) {
                    add_other(result, other, raster);
                }
            }
        }
        return result;
    }

private:
    [[nodiscard]] static eval::Batch empty(const eval::TileGrid& grid, eval::Measure measure)
    {
        return {.bdpt = eval::PathSums(grid, 2, {}, measure),
                .others = {4, eval::RadianceSums(grid, 2, measure)},
                .images = {}};
    }
    /// As the path `x` that strategy `finder` has found is weighed.
    std::array<double, 4> densities(double x, std::size_t finder) const
    {
        const double own = finder == 1 ? 1.0 : fault_.own_density;
        return {1.0, 2.0 * x * own, x >= blind || fault_.claims_all ? 1.0 / (1.0 - blind) : 0.0,
                x < rare ? 1.0 / rare : 0.0};
    }
    double sample(std::size_t s)
    {
        const auto u = static_cast<double>(random_.next());
        switch (s) {
            case 0:
                return u;
            case 1:
                return std::sqrt(1.0 - u);
            case 2:
                return blind + (1.0 - blind) * u;
            default:
                return rare * u;
        }
    }
    double factor(std::size_t s, Vec2 raster) const
    {
        return fault_.only_left && raster.x > 2.0f ? 1.0 : fault_.factors[s];
    }

    void add_bdpt(eval::Batch& batch, std::size_t s, Vec2 raster)
    {
        const double x = sample(s);
        const std::array<double, 4> p = densities(x, s);
        const double sum = p[0] + p[1] + p[2] + p[3];
        std::array<float, 4> shares{};
        double squares = 0.0;
        for (std::size_t i = 0; i < 4; ++i) {
            shares[i] = static_cast<float>(p[i] / sum);
            squares += p[i] * p[i];
        }
        const double value = factor(s, raster) / p[s];
        const PathContribution path{
            .strategy = {.s = static_cast<int>(s), .t = 3 - static_cast<int>(s)},
            .raster = raster,
            .unweighted = static_cast<float>(value) * (s == 0 ? fault_.tint : Rgb(1.0f)),
            .weight = static_cast<float>(fault_.weights * p[s] * p[s] / squares),
            .shares = shares};
        batch.bdpt.add(path);
        for (eval::Batch& channel : batch.channels) {
            channel.bdpt.add(path);
        }
    }

    /// pt by strategy 0, nee by 1, mis by both, lt by 2 and 3.
    void add_other(eval::Batch& batch, std::size_t integrator, Vec2 raster)
    {
        const auto tell = [&](double value) {
            const PathContribution path{
                .strategy = {.s = 0, .t = 3},
                .raster = raster,
                .unweighted = static_cast<float>(fault_.integrators[integrator] * value) *
                              (integrator == 2 ? fault_.tint_of_mis : Rgb(1.0f))};
            batch.others[integrator].add(path);
            for (eval::Batch& channel : batch.channels) {
                channel.others[integrator].add(path);
            }
        };
        const auto pair = [&](std::size_t a, std::size_t b) {
            for (const std::size_t s : {a, b}) {
                const double x = sample(s);
                const std::array<double, 4> p = densities(x, s);
                tell(p[s] / (p[a] * p[a] + p[b] * p[b]));
            }
        };
        switch (integrator) {
            case 0:
                tell(1.0);
                break;
            case 1:
                tell(1.0 / (2.0 * sample(1)));
                break;
            case 2:
                pair(0, 1);
                break;
            default:
                pair(2, 3);
        }
    }

    Random random_;
    ToyFault fault_;
};

}  // namespace bdpt::test
