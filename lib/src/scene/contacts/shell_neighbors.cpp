#include "scene/contacts/shell_neighbors.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace bdpt {
namespace {

struct ShellExtent {
    Bounds box = empty_bounds();
    Vec3 apex{0.0f};      // of the tetrahedra whose signed volumes are summed
    double volume = 0.0;  // [m^3], of a closed shell
    double area = 0.0;    // [m^2]
};

std::vector<ShellExtent> measure(const PlacedMesh& placed, const Shells& shells)
{
    std::vector<ShellExtent> extents(shells.are_closed.size());
    for (std::uint32_t t = 0; t < placed.triangle_count(); ++t) {
        ShellExtent& extent = extents[shells.of_triangles[t]];
        const auto corners = placed.corners(t, 0.0f);
        if (extent.box.min.x > extent.box.max.x) {
            extent.apex = corners[0];
        }
        const Vec3 area = cross(corners[1] - corners[0], corners[2] - corners[0]);
        extent.box = joined(extent.box, box_around(corners, 0.0f));
        extent.area += 0.5 * double{length(area)};
        extent.volume += double{dot(area, corners[0] - extent.apex)} / 6.0;
    }
    return extents;
}

bool may_be_thin(const ShellExtent& shell, bool is_closed)
{
    constexpr float max_exact = 1e-5f;     // error in sizes of a shell
    constexpr double max_errors = 1000.0;  // in its mean thickness
    const float error = error_in(shell.box);
    const double mean_thickness = 2.0 * std::abs(shell.volume) / shell.area;
    return error > max_exact * distance(shell.box.min, shell.box.max) &&
           !(is_closed && mean_thickness > max_errors * double{error});
}

}  // namespace

float error_in(const Bounds& box)
{
    const Vec3 farthest = max(abs(box.min), abs(box.max));
    return position_error(std::max({farthest.x, farthest.y, farthest.z}));
}

ShellNeighbors::ShellNeighbors(const PlacedMesh& placed, const Shells& shells, float margin)
    : margin_(margin)
{
    std::vector<Bounds> boxes;
    for (const ShellExtent& extent : measure(placed, shells)) {
        may_be_thin_.push_back(may_be_thin(extent, shells.are_closed[boxes.size()]));
        any_ = any_ || may_be_thin_.back();
        boxes.push_back(extent.box);
    }
    boxes_ = BoxTree(std::move(boxes));
    for (const Bounds& box : boxes_.boxes()) {
        const float far = margin * error_in(box);
        const auto shell = static_cast<std::uint32_t>(has_near_.size());
        has_near_.push_back(overlaps_other({.min = box.min - far, .max = box.max + far}, shell));
        any_ = any_ || has_near_.back();
    }
}

bool ShellNeighbors::overlaps_other(const Bounds& box, std::uint32_t shell) const
{
    bool overlaps = false;
    boxes_.find(box, [&](std::uint32_t other) {
        overlaps = other != shell;
        return !overlaps;
    });
    return overlaps;
}

}  // namespace bdpt
