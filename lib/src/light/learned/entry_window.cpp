#include "light/learned/entry_window.h"

#include "math/frame.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace bdpt {
namespace {

constexpr float max_offset = 0x1.fffffep-1f;

/// Adds a quarter of each number to its two neighbours in a row and keeps half; numbers at the ends
/// keep more. Consecutive numbers are `step` apart, rows `stride`.
template <std::size_t side>
std::array<double, side * side> blur_rows(const std::array<double, side * side>& numbers,
                                          std::size_t step, std::size_t stride)
{
    std::array<double, side * side> result{};
    for (std::size_t row = 0; row < side; ++row) {
        for (std::size_t i = 0; i < side; ++i) {
            const std::size_t at = row * stride + i * step;
            const double before = numbers[i > 0 ? at - step : at];
            const double after = numbers[i + 1 < side ? at + step : at];
            result[at] = 0.25 * before + 0.5 * numbers[at] + 0.25 * after;
        }
    }
    return result;
}

}  // namespace

EntryWindow::EntryWindow(std::span<const Escape> escapes, Vec3 origin, float margin)
    : origin_(origin)
{
    glm::dvec3 sum(0.0);
    for (const Escape& escape : escapes) {
        sum += static_cast<double>(escape.throughput) * glm::dvec3(escape.direction);
    }
    if (!(dot(sum, sum) > 0.0)) {
        return;
    }
    const Frame frame = Frame::from_normal(Vec3(normalize(sum)));
    x_ = frame.x;
    y_ = frame.y;
    normal_ = frame.z;
    size_ = Vec2(margin);  // it admits directions from now on
    constexpr float infinity = std::numeric_limits<float>::infinity();
    corner_ = Vec2(infinity);
    Vec2 opposite(-infinity);
    for (const Escape& escape : escapes) {
        if (admits(-escape.direction)) {
            const Vec2 at = project(escape.p, escape.direction);
            corner_ = min(corner_, at);
            opposite = max(opposite, at);
        }
    }
    const Vec2 around = 0.1f * (opposite - corner_) + margin;
    corner_ -= around;
    size_ = opposite + around - corner_;
    Cells throughputs{};
    for (const Escape& escape : escapes) {
        if (admits(-escape.direction)) {
            const Vec2 at = (project(escape.p, escape.direction) - corner_) / size_;
            const auto cell = [](float t) {
                return std::min(static_cast<std::size_t>(std::max(t, 0.0f) * side), side - 1);
            };
            throughputs[cell(at.y) * side + cell(at.x)] += static_cast<double>(escape.throughput);
        }
    }
    fill(throughputs);
}

void EntryWindow::fill(const Cells& throughputs)
{
    Cells roots = blur_rows<side>(blur_rows<side>(throughputs, 1, side), side, 1);
    double sum = 0.0;
    for (double& cell : roots) {
        cell = std::sqrt(cell);
        sum += cell;
    }
    if (!(sum > 0.0)) {
        size_ = Vec2(0.0f);
        return;
    }
    double before = 0.0;
    for (std::size_t i = 0; i < roots.size(); ++i) {
        sums_[i] = static_cast<float>(before / sum);
        before += roots[i];
    }
    sums_.back() = 1.0f;
    const double area_of_cell = static_cast<double>(size_.x) * static_cast<double>(size_.y) /
                                static_cast<double>(roots.size());
    root_of_throughput_ = sum * std::sqrt(area_of_cell);
}

Vec2 EntryWindow::project(Vec3 p, Vec3 direction) const noexcept
{
    const Vec3 from_origin = p - origin_;
    const Vec3 on_plane =
        from_origin - dot(from_origin, normal_) / dot(direction, normal_) * direction;
    return {dot(on_plane, x_), dot(on_plane, y_)};
}

Vec3 EntryWindow::sample(Vec2 u) const noexcept
{
    const auto next = std::upper_bound(sums_.begin(), sums_.end(), u.x);
    const auto cell = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
        next - sums_.begin() - 1, 0, static_cast<std::ptrdiff_t>(sums_.size()) - 2));
    const float width = sums_[cell + 1] - sums_[cell];
    const Vec2 in_cell{std::min((u.x - sums_[cell]) / width, max_offset), u.y};
    const Vec2 at =
        corner_ + size_ * ((Vec2(cell % side, cell / side) + in_cell) / static_cast<float>(side));
    return origin_ + at.x * x_ + at.y * y_;
}

PlanarPdf EntryWindow::pdf(Vec3 p, Vec3 direction) const noexcept
{
    constexpr auto end = static_cast<float>(side);
    const Vec2 at = (project(p, direction) - corner_) / size_ * end;
    if (!(at.x >= 0.0f && at.y >= 0.0f && at.x < end && at.y < end)) {
        return {};
    }
    const auto cell = static_cast<std::size_t>(at.y) * side + static_cast<std::size_t>(at.x);
    const float area = size_.x * size_.y / (end * end);
    return {(sums_[cell + 1] - sums_[cell]) / (area * std::abs(dot(direction, normal_)))};
}

}  // namespace bdpt
