#include "geometry/ray_passage.h"

#include "math/elementary.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace bdpt {
namespace {

// Sums of whole numbers do not depend on the order.
constexpr float log_one = 0x1p32f;
constexpr float log_of_nothing = -90.0f;  // e^x is 0 there

float log_of(float factor)
{
    return factor > 1e-37f ? log_exact(factor) : log_of_nothing;
}

}  // namespace

bool RayPassage::passes(const AnyHitFilter& filter, const AnyHit& surface, float t) noexcept
{
    const auto tint = [&] { return filter.tint(filter.owner, surface); };
    Crossing crossing{.t = t,
                      .instance = surface.instance,
                      .triangle = surface.triangle,
                      .opacity = 0.0f,
                      .factor = Rgb(1.0f)};
    if (rule_ == PassageRule::tint) {
        crossing.factor = tint();
        add(crossing);
        return true;
    }
    crossing.opacity = filter.opacity(filter.owner, surface);
    if (rule_ == PassageRule::chance) {
        const bool passes =
            surface.segment.at_surface(surface.instance, surface.triangle) >= crossing.opacity;
        is_tinted_ = is_tinted_ || (passes && looks_for_tints_ && tint() != Rgb(1.0f));
        return passes;
    }
    if (crossing.opacity >= 1.0f) {
        return false;
    }
    if (crossing.opacity > 0.0f) {
        if (rule_ == PassageRule::expectation) {
            crossing.factor = (1.0f - crossing.opacity) * tint();
        }
        add(crossing);
    }
    return true;
}

Rgb RayPassage::factor() noexcept
{
    sort();
    Rgb product(1.0f);
    for (std::size_t i = 0; i < count_; ++i) {
        product *= crossings_[i].factor;
    }
    if (nearest_dropped_ < std::numeric_limits<float>::infinity()) [[unlikely]] {
        for (int c = 0; c < 3; ++c) {
            product[c] *=
                exp_exact(static_cast<float>(dropped_logs_[static_cast<std::size_t>(c)]) / log_one);
        }
    }
    return product;
}

std::span<const Crossing> RayPassage::crossings() noexcept
{
    sort();
    const auto end =
        std::find_if(crossings_.begin(), crossings_.begin() + static_cast<std::ptrdiff_t>(count_),
                     [&](const Crossing& c) { return !(c.t < end_); });
    return {crossings_.begin(), end};
}

void RayPassage::add(const Crossing& crossing) noexcept
{
    const auto end = crossings_.begin() + static_cast<std::ptrdiff_t>(count_);
    const auto is_same = [&](const Crossing& other) {
        return other.instance == crossing.instance && other.triangle == crossing.triangle;
    };
    if (std::any_of(crossings_.begin(), end, is_same)) {
        return;
    }
    if (count_ < room) {
        crossings_[count_++] = crossing;
        return;
    }
    Crossing& farthest = *std::max_element(
        crossings_.begin(), end, [](const Crossing& a, const Crossing& b) { return a.t < b.t; });
    if (crossing.t < farthest.t) {
        drop(farthest);
        farthest = crossing;
    } else {
        drop(crossing);
    }
}

void RayPassage::drop(const Crossing& crossing) noexcept
{
    nearest_dropped_ = std::min(nearest_dropped_, crossing.t);
    for (int c = 0; c < 3; ++c) {
        dropped_logs_[static_cast<std::size_t>(c)] +=
            std::llround(log_of(crossing.factor[c]) * log_one);
    }
}

void RayPassage::sort() noexcept
{
    std::sort(crossings_.begin(), crossings_.begin() + static_cast<std::ptrdiff_t>(count_),
              [](const Crossing& a, const Crossing& b) {
                  return std::tie(a.t, a.instance, a.triangle) <
                         std::tie(b.t, b.instance, b.triangle);
              });
}

}  // namespace bdpt
