#include "film/pixel_filter.h"

#include "math/elementary.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace bdpt {
namespace {

constexpr int cells = 1024;

/// Returns the filter's curve at `t` = offset / radius in [0, 1], not normalised.
float curve(FilterKind kind, float t)
{
    switch (kind) {
        case FilterKind::tent:
            return 1.0f - t;
        case FilterKind::gaussian:
            return exp_exact(-4.5f * t * t) - exp_exact(-4.5f);
        case FilterKind::blackman_harris:
            return 0.35875f + 0.48829f * sin_cos(pi * t).cos + 0.14128f * sin_cos(2 * pi * t).cos +
                   0.01168f * sin_cos(3 * pi * t).cos;
        case FilterKind::box:
            break;
    }
    return 1.0f;
}

}  // namespace

PixelFilter::PixelFilter(const FilterOptions& options)
    : radius_(options.radius.value_or(default_radius(options.kind))),
      is_pixel_(options.kind == FilterKind::box && radius_ == 0.5f),
      cdf_(cells + 1)
{
    std::vector<double> sums{0.0};
    for (int cell = 0; cell < cells; ++cell) {
        const float middle = (static_cast<float>(cell) + 0.5f) / cells;
        sums.push_back(sums.back() + static_cast<double>(curve(options.kind, middle)));
    }
    for (std::size_t i = 0; i < cdf_.size(); ++i) {
        cdf_[i] = static_cast<float>(sums[i] / sums.back());
    }
}

float PixelFilter::sample_offset(float u) const noexcept
{
    const float v = std::abs(2.0f * u - 1.0f);
    // The cell in which the distribution passes v; for u = 0 the last that is not empty.
    auto above = std::upper_bound(cdf_.begin(), cdf_.end(), v);
    above = above == cdf_.end() ? std::lower_bound(cdf_.begin(), cdf_.end(), 1.0f) : above;
    const float low = *(above - 1);
    const auto cell = static_cast<float>(above - 1 - cdf_.begin());
    const float offset = (cell + (v - low) / (*above - low)) * (radius_ / cells);
    return u < 0.5f ? -offset : offset;
}

float PixelFilter::density(float offset) const noexcept
{
    const float position = std::abs(offset) * (cells / radius_);
    if (!(position < cells)) {
        return 0.0f;
    }
    const auto cell = static_cast<std::size_t>(position);
    return (cdf_[cell + 1] - cdf_[cell]) * (0.5f * cells / radius_);
}

Vec2 PixelFilter::sample_raster(int x, int y, Vec2 u) const noexcept
{
    if (is_pixel_) {
        return Vec2(x, y) + u;
    }
    return Vec2(x, y) + 0.5f + Vec2(sample_offset(u.x), sample_offset(u.y));
}

PixelFilter::Choice PixelFilter::choose_center(float position, float u) const noexcept
{
    const float first = std::ceil(position - radius_ - 0.5f) + 0.5f;
    const float last = position + radius_;
    float sum = 0.0f;
    for (float center = first; center <= last; center += 1.0f) {
        sum += density(position - center);
    }
    Choice choice{.center = first, .weight = sum};
    float left = u * sum;
    for (float center = first; center <= last; center += 1.0f) {
        const float h = density(position - center);
        if (h > 0.0f) {
            choice.center = center;
            left -= h;
        }
        if (left < 0.0f) {
            break;
        }
    }
    return choice;
}

SplatTarget PixelFilter::choose_pixel(Vec2 raster, Vec2 u) const noexcept
{
    if (is_pixel_) {
        return {.raster = raster, .weight = 1.0f};
    }
    const Choice x = choose_center(raster.x, u.x);
    const Choice y = choose_center(raster.y, u.y);
    return {.raster = {x.center, y.center}, .weight = x.weight * y.weight};
}

}  // namespace bdpt
