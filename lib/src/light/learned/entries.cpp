#include "light/learned/entries.h"

#include "math/frame.h"
#include "math/warp.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace bdpt {
namespace {

constexpr std::size_t side = 16;  // cells
using Cells = std::array<double, side * side>;

/// Blurs along rows: a quarter of each number goes to each of its two neighbours. At the ends of a
/// row that quarter stays. Consecutive numbers are `step` apart, rows `stride`.
Cells blur_rows(const Cells& numbers, std::size_t step, std::size_t stride)
{
    Cells result{};
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

/// Samples the entry point of a ray of direction `direction` into the scene: uniform on the disk in
/// front of it.
Vec3 sample_entry(const BoundingSphere& bounds, Vec3 direction, Vec2 u)
{
    const Vec2 on_disk = bounds.radius * square_to_disk(u);
    const Frame frame = Frame::from_normal(direction);
    return bounds.center + on_disk.x * frame.x + on_disk.y * frame.y - bounds.radius * direction;
}

/// Tests whether a point is in [0, 1)^2.
bool is_in_grid(Vec2 at)
{
    return at.x >= 0.0f && at.y >= 0.0f && at.x < 1.0f && at.y < 1.0f;
}

}  // namespace

EntryWindow::EntryWindow(std::span<const Escape> escapes, Vec3 origin, const BoundingSphere& bounds)
    : bounds_(bounds), origin_(origin)
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
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Vec2 corner(infinity);
    Vec2 opposite(-infinity);
    for (const Escape& escape : escapes) {
        if (is_steep(escape.direction)) {
            const Vec2 at = project(escape.p, escape.direction);  // [m]: corner 0, size 1
            corner = min(corner, at);
            opposite = max(opposite, at);
        }
    }
    const Vec2 around = 0.1f * (opposite - corner) + 1e-3f * bounds.radius;
    corner_ = corner - around;
    size_ = opposite + around - corner_;
    Cells throughputs{};
    for (const Escape& escape : escapes) {
        const Vec2 at = project(escape.p, escape.direction);
        if (is_steep(escape.direction) && is_in_grid(at)) {
            const auto cell = glm::vec<2, std::size_t>(at * static_cast<float>(side));
            throughputs[cell.y * side + cell.x] += static_cast<double>(escape.throughput);
        }
    }
    std::vector<float> roots;
    double total = 0.0;
    for (const double cell : blur_rows(blur_rows(throughputs, 1, side), side, 1)) {
        roots.push_back(static_cast<float>(std::sqrt(cell)));
        total += std::sqrt(cell);
    }
    if (total > 0.0) {
        cells_.emplace(roots, static_cast<int>(side), static_cast<int>(side));
        const double area_of_cell = static_cast<double>(size_.x) * static_cast<double>(size_.y) /
                                    static_cast<double>(side * side);
        root_of_throughput_ = total * std::sqrt(area_of_cell);
    }
}

Vec2 EntryWindow::project(Vec3 p, Vec3 direction) const noexcept
{
    const Vec3 from_origin = p - origin_;
    const Vec3 on_plane =
        from_origin - dot(from_origin, normal_) / dot(direction, normal_) * direction;
    return (Vec2(dot(on_plane, x_), dot(on_plane, y_)) - corner_) / size_;
}

EntryWindow::Entry EntryWindow::sample(Vec3 direction, Vec2 u) const noexcept
{
    constexpr float below_one = 0x1.fffffep-1f;
    const float uniform = admits(direction) ? uniform_part : 1.0f;
    Vec3 p;
    if (u.x < uniform) {
        p = sample_entry(bounds_, direction, {std::min(u.x / uniform, below_one), u.y});
    } else {
        const float rest = std::min((u.x - uniform) / (1.0f - uniform), below_one);
        const Vec2 at = corner_ + size_ * cells_->sample({rest, u.y}).point;
        p = origin_ + at.x * x_ + at.y * y_;
        p -= (dot(p - bounds_.center, direction) + bounds_.radius) * direction;
    }
    return {.p = p, .pdf = pdf(p, direction)};
}

PlanarPdf EntryWindow::pdf(Vec3 p, Vec3 direction) const noexcept
{
    const float uniform = bounds_.pdf_disk().value;
    if (!admits(direction)) {
        return {uniform};
    }
    const Vec2 at = project(p, direction);
    const float in_grid =
        is_in_grid(at) ? cells_->pdf(at) / (size_.x * size_.y * std::abs(dot(direction, normal_)))
                       : 0.0f;
    return {uniform_part * uniform + (1.0f - uniform_part) * in_grid};
}

namespace {

/// Returns the mean of the last vertices: planes through it are near the openings of a room.
Vec3 center_of(std::span<const Escape> escapes, const BoundingSphere& bounds)
{
    glm::dvec3 sum(0.0);
    double throughput = 0.0;
    for (const Escape& escape : escapes) {
        sum += static_cast<double>(escape.throughput) * glm::dvec3(escape.p);
        throughput += static_cast<double>(escape.throughput);
    }
    return throughput > 0.0 ? Vec3(sum / throughput) : bounds.center;
}

}  // namespace

EnvironmentEntries::EnvironmentEntries(std::vector<Escape> escapes, const EnvironmentTiles& tiles,
                                       const BoundingSphere& bounds)
    : windows_(EnvironmentTiles::tile_count, EntryWindow(bounds))
{
    const Vec3 center = center_of(escapes, bounds);
    std::stable_sort(escapes.begin(), escapes.end(),
                     [](const Escape& a, const Escape& b) { return a.tile < b.tile; });
    std::vector<double> importance(windows_.size(), 0.0);
    for (auto begin = escapes.begin(); begin != escapes.end();) {
        const std::size_t tile = begin->tile;
        const auto end =
            std::find_if(begin, escapes.end(), [tile](const Escape& e) { return e.tile != tile; });
        windows_[tile] = EntryWindow(std::span(begin, end), center, bounds);
        // Per solid angle, as the weights of tiles are integrals over it.
        importance[tile] = windows_[tile].root_of_throughput() / std::sqrt(tiles.solid_angle(tile));
        begin = end;
    }
    const double most = *std::max_element(importance.begin(), importance.end());
    for (std::size_t tile = 0; tile < windows_.size(); ++tile) {
        const double factor = most > 0.0 ? importance[tile] / most : 1.0;
        factors_.of[tile] = std::max(min_factor, static_cast<float>(factor));
    }
    worth_ = tiles.worth(factors_, EnvironmentSampling::plain);
}

}  // namespace bdpt
