#include "scene/enclosing_volumes.h"

#include "geometry/length.h"
#include "geometry/rounding.h"

#include <tbb/parallel_for.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace bdpt {
namespace {

/// No plane of a usual model holds one of them.
const std::array<Vec3, 3> probe_directions{normalize(Vec3{0.4231f, 0.8317f, -0.3589f}),
                                           normalize(Vec3{-0.7411f, 0.2203f, 0.6342f}),
                                           normalize(Vec3{0.1873f, -0.6011f, 0.7769f})};
/// Triangles that are asked where their mesh lies.
constexpr std::size_t most_probes = 16;
/// Surfaces along one ray, beyond which nobody wants to know: files that nobody trusts can have any
/// number of them.
constexpr int most_crossings = 1024;

Bounds bounds_of(const PlacedMesh& placed)
{
    Bounds bounds{.min = Vec3(std::numeric_limits<float>::infinity()),
                  .max = Vec3(-std::numeric_limits<float>::infinity())};
    for (std::uint32_t triangle = 0; triangle < placed.triangle_count(); ++triangle) {
        for (const Vec3& p : placed.corners(triangle, 0.0f)) {
            bounds.min = min(bounds.min, p);
            bounds.max = max(bounds.max, p);
        }
    }
    return bounds;
}

bool is_within(const Bounds& bounds, Vec3 p)
{
    return p.x >= bounds.min.x && p.y >= bounds.min.y && p.z >= bounds.min.z &&
           p.x <= bounds.max.x && p.y <= bounds.max.y && p.z <= bounds.max.z;
}

float volume(const Bounds& bounds)
{
    const Vec3 size = bounds.max - bounds.min;
    return size.x * size.y * size.z;
}

/// Behind a sphere in the way.
Vec3 beyond(const Sphere& sphere, Ray ray)
{
    constexpr float further = 1.00001f;
    for (int crossing = 0; crossing < 2; ++crossing) {
        const auto hit = intersect(sphere, ray, 0.0f);
        if (!hit) {
            break;
        }
        const float error = sphere.point(hit->normal).error;
        ray.origin += (hit->t * further + error) * ray.direction;
    }
    return ray.origin;
}

/// A point just before the middle of a triangle; none where it has no area.
std::optional<Vec3> before(const PlacedMesh& placed, std::uint32_t triangle)
{
    const Vec3 normal = placed.area_normal(triangle, 0.0f);
    const float length = length_of(normal);
    if (!(length > 0.0f)) {
        return std::nullopt;
    }
    const BoundedPoint middle = placed.point(triangle, Vec2(1.0f / 3.0f), 0.0f);
    return offset_origin(middle.p, middle.error, normal / length, normal);
}

/// One of `count` triangles: each of a small mesh, else triangles that follow no pattern of the
/// mesh. Equal steps would meet the same ring of a turned one all the time.
std::uint32_t probed(std::size_t probe, std::uint32_t count)
{
    if (count <= most_probes) {
        return static_cast<std::uint32_t>(probe) % count;
    }
    constexpr std::uint32_t golden_ratio_32 = 0x9e3779b9U;
    const std::uint32_t place = static_cast<std::uint32_t>(probe) * golden_ratio_32;
    return static_cast<std::uint32_t>(std::uint64_t{place} * count >> 32U);
}

}  // namespace

EnclosingVolumes::EnclosingVolumes(std::span<const PlacedMesh> placed,
                                   std::vector<std::uint32_t> instances,
                                   std::span<const Sphere> spheres, const EmbreeScene& embree)
    : placed_(placed),
      spheres_(spheres),
      embree_(embree),
      instances_(std::move(instances)),
      volume_of_instance_(placed.size()),
      bounds_(instances_.size()),
      depth_(instances_.size(), 0)
{
    for (std::size_t body = 0; body < instances_.size(); ++body) {
        volume_of_instance_[instances_[body]] = body;
    }
    tbb::parallel_for(std::size_t{0}, instances_.size(), [&](std::size_t body) {
        bounds_[body] = bounds_of(placed_[instances_[body]]);
    });
    tbb::parallel_for(std::size_t{0}, instances_.size(), [&](std::size_t body) {
        depth_[body] = containing(instances_[body]).size();
    });
}

/// The bodies that a ray leaves more often than it enters.
EnclosingVolumes::Set EnclosingVolumes::left_by(Vec3 origin, Vec3 direction) const
{
    std::vector<std::pair<std::size_t, int>> crossings;  // and +1 where the ray leaves the body
    Ray ray{.origin = origin, .direction = direction};
    for (int crossing = 0; crossing < most_crossings; ++crossing) {
        const auto hit = embree_.intersect(ray);
        if (!hit) {
            break;
        }
        if (hit->sphere != no_sphere) {
            ray.origin = beyond(spheres_[hit->sphere], ray);
            continue;
        }
        const Vec3 normal = hit->at.ng;
        if (const auto body = volume_of_instance_[hit->instance]) {
            crossings.emplace_back(*body, dot(normal, direction) > 0.0f ? 1 : -1);
        }
        ray.origin = offset_origin(hit->at.point.p, hit->at.point.error, normal, direction);
    }
    std::sort(crossings.begin(), crossings.end());
    Set result;
    for (std::size_t i = 0; i < crossings.size();) {
        const std::size_t body = crossings[i].first;
        int balance = 0;
        for (; i < crossings.size() && crossings[i].first == body; ++i) {
            balance += crossings[i].second;
        }
        if (balance > 0 && is_within(bounds_[body], origin)) {
            result.push_back(body);
        }
    }
    return result;
}

EnclosingVolumes::Set EnclosingVolumes::containing(Vec3 p) const
{
    constexpr std::size_t few = 256;  // enough that asking the bounds of all saves rays
    const auto may_contain = [&](const Bounds& bounds) { return is_within(bounds, p); };
    if (bounds_.size() <= few && std::none_of(bounds_.begin(), bounds_.end(), may_contain)) {
        return {};
    }
    Set votes;
    for (const Vec3 direction : probe_directions) {
        const Set left = left_by(p, direction);
        votes.insert(votes.end(), left.begin(), left.end());
    }
    std::sort(votes.begin(), votes.end());
    Set result;
    for (std::size_t i = 1; i < votes.size(); ++i) {
        if (votes[i] == votes[i - 1] && (result.empty() || result.back() != votes[i])) {
            result.push_back(votes[i]);
        }
    }
    return result;
}

EnclosingVolumes::Set EnclosingVolumes::containing(std::uint32_t instance) const
{
    const PlacedMesh& mesh = placed_[instance];
    const std::uint32_t count = mesh.triangle_count();
    std::optional<Set> common;
    for (std::size_t probe = 0; probe < most_probes && count > 0; ++probe) {
        const std::uint32_t triangle = probed(probe, count);
        const std::optional<Vec3> p = before(mesh, triangle);
        if (!p) {
            continue;
        }
        Set here = containing(*p);
        std::erase_if(here, [&](std::size_t body) { return instances_[body] == instance; });
        if (common) {
            Set both;
            std::set_intersection(common->begin(), common->end(), here.begin(), here.end(),
                                  std::back_inserter(both));
            here = std::move(both);
        }
        if (here.empty()) {
            return {};
        }
        common = std::move(here);
    }
    return common.value_or(Set{});
}

/// That which lies in most others; of two the smaller one.
std::optional<std::uint32_t> EnclosingVolumes::innermost(const Set& bodies) const
{
    if (bodies.empty()) {
        return std::nullopt;
    }
    const auto deeper = [&](std::size_t a, std::size_t b) {
        return depth_[a] != depth_[b] ? depth_[a] > depth_[b]
                                      : volume(bounds_[a]) < volume(bounds_[b]);
    };
    return instances_[*std::min_element(bodies.begin(), bodies.end(), deeper)];
}

std::vector<std::optional<std::uint32_t>> EnclosingVolumes::around_all() const
{
    std::vector<std::optional<std::uint32_t>> result(placed_.size());
    tbb::parallel_for(std::size_t{0}, placed_.size(), [&](std::size_t instance) {
        result[instance] = innermost(containing(static_cast<std::uint32_t>(instance)));
    });
    return result;
}

std::optional<std::uint32_t> EnclosingVolumes::at(Vec3 p) const
{
    return innermost(containing(p));
}

}  // namespace bdpt
