#pragma once

#include "light/environment_light.h"
#include "render/ground/ground_occluders.h"
#include "scene/light_set.h"

#include <bdpt/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt {

/// Light of the environment on horizontal ground. Unblocked light is precomputed; only directions
/// that the scene may block are sampled (docs/decisions/0064).
class GroundSky {
public:
    /// Keeps references to both arguments, which must outlive it.
    GroundSky(const EnvironmentLight& sky, const GroundOccluders& occluders);

    /// Luminance of the irradiance [lx], split by whether the scene may block it.
    struct Shares {
        float open = 0.0f;
        float exposed = 0.0f;
    };
    [[nodiscard]] Shares shares(std::size_t place) const { return places_[place].shares; }
    /// Number of samples that estimate the exposed share of a place.
    struct Effort {
        std::uint32_t samples = 0;  ///< 0: nothing is exposed
        float chance = 0.0f;        ///< probability of taking the samples; below 1 for one sample
        float weight = 0.0f;        ///< of each sample
    };
    /// Returns more samples where more of the light may be blocked: only that part is noisy.
    [[nodiscard]] Effort effort(std::size_t place) const { return places_[place].effort; }
    /// Returns the irradiance of unblocked ground.
    [[nodiscard]] float irradiance() const { return irradiance_; }

    struct Sample {
        Vec3 to_light{0.0f};        ///< unit
        float over_density = 0.0f;  ///< cosine over the density, for solid angle
    };
    /// Samples a direction that the scene may block, approximately in proportion to its
    /// contribution. The place's share must be positive.
    [[nodiscard]] Sample sample(std::size_t place, Vec2 u) const;
    /// Returns the estimate of the exposed irradiance by a sample.
    [[nodiscard]] Rgb irradiance(const Sample& sample) const
    {
        return sample.over_density * sky_.radiance(sample.to_light);
    }

private:
    static constexpr std::size_t strips = GroundOccluders::strips;
    static constexpr std::size_t rows = GroundOccluders::rows;
    static constexpr std::size_t columns_of_strip = 8;
    static constexpr std::size_t columns = strips * columns_of_strip;
    /// Sums over the rows above each row; the last one over all.
    using RowSums = std::array<double, rows + 1>;
    struct Place {
        Shares shares;
        Effort effort;
        float weight = 0.0f;                  ///< weight of all directions that may be blocked
        std::array<float, strips> weights{};  ///< cumulative weights of strips, inclusive
    };
    /// A strip's distribution, in whole numbers so that all strips stay in the fastest cache.
    struct Strip {
        float scale = 0.0f;                          ///< weight of a unit of `sums`
        std::array<std::uint16_t, rows + 1> sums{};  ///< like `RowSums`
    };
    /// Cumulative shares of the cells of a strip in one row, exclusive, in 1/255.
    using Cells = std::array<std::uint8_t, columns_of_strip>;

    using Weights = std::vector<std::array<float, rows>>;  ///< by column
    void fill_cells();
    void fill_distribution(const Weights& weights);
    [[nodiscard]] float weight(std::size_t strip, GroundOccluders::Rows blocked) const
    {
        const auto& sums = strips_[strip].sums;
        return strips_[strip].scale * static_cast<float>(sums[blocked.end] - sums[blocked.begin]);
    }

    const EnvironmentLight& sky_;
    const GroundOccluders& occluders_;
    std::array<float, rows + 1> sines_squared_{};  ///< of the polar angle where rows begin
    std::array<float, rows> projected_{};          ///< projected solid angle of a cell by row [sr]
    std::vector<Strip> strips_;
    std::vector<Cells> cells_;          ///< by strip and row
    std::vector<RowSums> irradiances_;  ///< by strip
    float irradiance_ = 0.0f;
    std::vector<Place> places_;
};

/// Sampling probabilities of lights with a position on the ground: low where their contribution is
/// negligible (docs/decisions/0064).
class GroundLamps {
public:
    /// `elsewhere` is the luminance of the irradiance of all other lights [lx].
    GroundLamps(const LightSet& lights, const GroundOccluders& occluders, float height,
                float elsewhere);

    /// Returns the probability of taking a sample, in [1 / 128, 1].
    [[nodiscard]] float chance(std::size_t place) const
    {
        return chances_.empty() ? 1.0f : chances_[place];
    }

private:
    std::vector<float> chances_;  ///< one per place; empty: 1 everywhere
};

}  // namespace bdpt
