#pragma once

#include <bdpt/options/filter_options.h>
#include <bdpt/types.h>

#include <vector>

namespace bdpt {

/// Pixel that receives a splat, and its weight.
struct SplatTarget {
    Vec2 raster{0.0f};  ///< within the pixel [pixels]
    float weight = 1.0f;
};

/// A pixel filter h with integral one, sampled and evaluated as the same step function. A pixel
/// with centre c measures the integral of h(p - c) L(p) over raster positions p, whether p is
/// sampled by a camera path of that pixel or by any light path.
class PixelFilter {
public:
    /// `options` have been checked.
    explicit PixelFilter(const FilterOptions& options);

    [[nodiscard]] float radius() const { return radius_; }
    /// Tests whether each raster position contributes only to the pixel that contains it.
    [[nodiscard]] bool is_pixel() const { return is_pixel_; }
    /// Samples the raster position of a camera sample of pixel (x, y) with density h. It can lie
    /// outside of the image. `u` is uniform in [0, 1)^2.
    [[nodiscard]] Vec2 sample_raster(int x, int y, Vec2 u) const noexcept;
    /// Chooses one of the pixels that `raster` contributes to, with probability proportional to h;
    /// the weight compensates for the sum of h over those pixels, which is near one.
    [[nodiscard]] SplatTarget choose_pixel(Vec2 raster, Vec2 u) const noexcept;
    /// Returns one factor of h at `offset` from the centre [1/pixel].
    [[nodiscard]] float density(float offset) const noexcept;

private:
    struct Choice {
        float center;
        float weight;
    };
    [[nodiscard]] float sample_offset(float u) const noexcept;
    [[nodiscard]] Choice choose_center(float position, float u) const noexcept;

    float radius_;
    bool is_pixel_;           // a box of one pixel: each position contributes to one pixel only
    std::vector<float> cdf_;  // of |offset|, at the boundaries of equal cells of [0, radius]
};

}  // namespace bdpt
