#pragma once

#include "light/environment_light.h"
#include "render/ground/ground_occluders.h"

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
        Vec3 to_light{0.0f};   ///< unit
        Rgb irradiance{0.0f};  ///< radiance times cosine over the density
    };
    /// Samples a direction that the scene may block, approximately in proportion to its
    /// contribution. The place's share must be positive.
    [[nodiscard]] Sample sample(std::size_t place, Vec2 u) const;

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

    void fill_cells();
    /// The weights in sampling of the cells of a strip in one row.
    using Cells = std::array<float, columns_of_strip>;
    [[nodiscard]] Cells& cells(std::size_t strip, std::size_t row)
    {
        return cells_[strip * rows + row];
    }
    [[nodiscard]] const Cells& cells(std::size_t strip, std::size_t row) const
    {
        return cells_[strip * rows + row];
    }

    const EnvironmentLight& sky_;
    const GroundOccluders& occluders_;
    std::array<float, rows + 1> sines_squared_{};  ///< of the polar angle where rows begin
    std::array<float, rows> projected_{};          ///< projected solid angle of a cell by row [sr]
    std::vector<Cells> cells_;
    std::vector<RowSums> weights_;      ///< of the cells, by strip
    std::vector<RowSums> irradiances_;  ///< by strip
    float irradiance_ = 0.0f;
    std::vector<Place> places_;
};

}  // namespace bdpt
