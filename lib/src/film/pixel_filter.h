#pragma once

#include <bdpt/options/filter_options.h>
#include <bdpt/types.h>

#include <vector>

namespace bdpt {

/// Where a splat goes and what it counts there.
struct SplatTarget {
    Vec2 raster{0.0f};  ///< within the pixel [pixels]
    float weight = 1.0f;
};

/// A pixel filter h with integral one, sampled and evaluated as the same step function. A pixel
/// with centre c measures the integral of h(p - c) L(p) over raster positions p, whether p is found
/// by a camera path of that pixel or by a light path of any.
class PixelFilter {
public:
    /// `options` have been checked.
    explicit PixelFilter(const FilterOptions& options);

    [[nodiscard]] float radius() const { return radius_; }
    /// Does each raster position count for the pixel that it lies in, and no other?
    [[nodiscard]] bool is_pixel() const { return is_pixel_; }
    /// Raster position of a camera sample of pixel (x, y), by the density h. It can lie beside the
    /// image. `u` is uniform in [0, 1)^2.
    [[nodiscard]] Vec2 sample_raster(int x, int y, Vec2 u) const noexcept;
    /// One of the pixels that `raster` counts for, with a probability in proportion to h; the
    /// weight makes up for the sum of h over those pixels, which is near one.
    [[nodiscard]] SplatTarget choose_pixel(Vec2 raster, Vec2 u) const noexcept;
    /// One factor of h at `offset` from the centre [1/pixel].
    [[nodiscard]] float density(float offset) const noexcept;

private:
    struct Choice {
        float center;
        float weight;
    };
    [[nodiscard]] float sample_offset(float u) const noexcept;
    [[nodiscard]] Choice choose_center(float position, float u) const noexcept;

    float radius_;
    bool is_pixel_;           // a box of one pixel: each position counts for one pixel only
    std::vector<float> cdf_;  // of |offset|, at the borders of equal cells of [0, radius]
};

}  // namespace bdpt
