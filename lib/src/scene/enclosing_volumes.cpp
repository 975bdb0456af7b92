#include "scene/enclosing_volumes.h"

#include "geometry/placed_mesh.h"
#include "geometry/ray.h"

#include <bdpt/error.h>

#include <tbb/parallel_for.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

namespace bdpt {
namespace {

/// Directions that lie in no plane of usual models.
const std::array<Vec3, 3> probe_directions{normalize(Vec3{0.4231f, 0.8317f, -0.3589f}),
                                           normalize(Vec3{-0.7411f, 0.2203f, 0.6342f}),
                                           normalize(Vec3{0.1873f, -0.6011f, 0.7769f})};
/// Number of triangles that are tested for where their mesh lies.
constexpr std::size_t max_probes = 16;
/// Maximum number of surfaces along one ray: untrusted files can have any number of them.
constexpr int max_crossings = 1024;

Bounds compute_bounds(const PlacedMesh& placed)
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

/// Returns the bounds of all bodies, slightly enlarged for rounding.
Bounds around(std::span<const std::size_t> bodies, std::span<const Bounds> bounds)
{
    Bounds all = bounds[bodies.front()];
    for (const std::size_t body : bodies) {
        all.min = min(all.min, bounds[body].min);
        all.max = max(all.max, bounds[body].max);
    }
    const Vec3 margin = 1e-3f * (all.max - all.min) + 1e-5f * max(abs(all.min), abs(all.max));
    return {.min = all.min - margin, .max = all.max + margin};
}

float volume(const Bounds& bounds)
{
    const Vec3 size = bounds.max - bounds.min;
    return size.x * size.y * size.z;
}

/// Returns a point behind a sphere on the ray.
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

/// Returns a point just in front of the centre of a triangle; nullopt if it has no area.
std::optional<Vec3> before(const PlacedMesh& placed, std::uint32_t triangle)
{
    const Vec3 normal = placed.area_normal(triangle, 0.0f);
    const float length = compute_length(normal);
    if (!(length > 0.0f)) {
        return std::nullopt;
    }
    const BoundedPoint middle = placed.point(triangle, Vec2(1.0f / 3.0f), 0.0f);
    return offset_origin(middle.p, middle.error, normal / length, normal);
}

/// Returns one of `count` triangles: each of a small mesh, else triangles in a pattern unrelated to
/// the mesh. Equal steps would always hit the same ring of a surface of revolution.
std::uint32_t probed(std::size_t probe, std::uint32_t count)
{
    if (count <= max_probes) {
        return static_cast<std::uint32_t>(probe) % count;
    }
    constexpr std::uint32_t golden_ratio_32 = 0x9e3779b9U;
    const std::uint32_t place = static_cast<std::uint32_t>(probe) * golden_ratio_32;
    return static_cast<std::uint32_t>(std::uint64_t{place} * count >> 32U);
}

}  // namespace

EnclosingVolumes::EnclosingVolumes(std::span<const PlacedMesh> placed,
                                   std::vector<std::uint32_t> instances,
                                   std::span<const Sphere> spheres, const EmbreeScene& embree,
                                   std::span<const Bond> bonds)
    : placed_(placed),
      spheres_(spheres),
      embree_(embree, embree.filter()),
      bonds_(bonds),
      instances_(std::move(instances)),
      volume_of_instance_(placed.size()),
      all_(instances_.size()),
      bounds_(instances_.size()),
      around_(instances_.size())
{
    std::iota(all_.begin(), all_.end(), std::size_t{0});
    for (std::size_t body = 0; body < instances_.size(); ++body) {
        volume_of_instance_[instances_[body]] = body;
    }
    tbb::parallel_for(std::size_t{0}, instances_.size(), [&](std::size_t body) {
        bounds_[body] = compute_bounds(placed_[instances_[body]]);
    });
    tbb::parallel_for(std::size_t{0}, instances_.size(),
                      [&](std::size_t body) { around_[body] = containing(instances_[body]); });
}

/// Returns those of `bodies` that a ray leaves more often than it enters.
EnclosingVolumes::Set EnclosingVolumes::left_by(Vec3 origin, Vec3 direction,
                                                const Set& bodies) const
{
    const Bounds region = around(bodies, bounds_);
    std::vector<int> balance(bodies.size(), 0);  // +1 for each time the ray leaves the body
    Ray ray{.origin = origin, .direction = direction};
    for (int crossing = 0; crossing < max_crossings && is_within(region, ray.origin); ++crossing) {
        const auto hit = embree_.intersect(ray);
        if (!hit) {
            break;
        }
        if (hit->sphere != no_sphere) {
            ray.origin = beyond(spheres_[hit->sphere], ray);
            continue;
        }
        const Vec3 normal = hit->at.ng;
        const auto leave = [&](std::uint32_t instance, int times) {
            if (const auto body = volume_of_instance_[instance]) {
                const auto place = std::lower_bound(bodies.begin(), bodies.end(), *body);
                if (place != bodies.end() && *place == *body) {
                    balance[static_cast<std::size_t>(place - bodies.begin())] += times;
                }
            }
        };
        const int times = dot(normal, direction) > 0.0f ? 1 : -1;
        leave(hit->instance, times);
        if (const Bond* bond = find_bond(bonds_, hit->instance, hit->triangle)) {
            leave(bond->partner, -times);
        }
        ray.origin = offset_origin(hit->at.point.p, hit->at.point.error, normal, direction);
    }
    Set result;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (balance[i] > 0) {
            result.push_back(bodies[i]);
        }
    }
    return result;
}

/// Returns those of `bodies` that contain the point, by vote.
EnclosingVolumes::Set EnclosingVolumes::voted(Vec3 p, const Set& bodies) const
{
    const Set first = left_by(p, probe_directions[0], bodies);
    const Set second = left_by(p, probe_directions[1], bodies);
    if (first == second) {
        return first;
    }
    Set votes = left_by(p, probe_directions[2], bodies);
    votes.insert(votes.end(), first.begin(), first.end());
    votes.insert(votes.end(), second.begin(), second.end());
    std::sort(votes.begin(), votes.end());
    Set result;
    for (std::size_t i = 1; i < votes.size(); ++i) {
        if (votes[i] == votes[i - 1] && (result.empty() || result.back() != votes[i])) {
            result.push_back(votes[i]);
        }
    }
    return result;
}

/// Returns those of `bodies` that contain the point.
EnclosingVolumes::Set EnclosingVolumes::containing(Vec3 p, Set bodies) const
{
    std::erase_if(bodies, [&](std::size_t body) { return !is_within(bounds_[body], p); });
    if (bodies.empty()) {
        return {};
    }
    Set result = voted(p, bodies);
    if (result.size() > max_depth) {
        throw Error(ErrorCode::invalid_input,
                    std::to_string(result.size()) + " transmissive bodies are nested at (" +
                        std::to_string(p.x) + ", " + std::to_string(p.y) + ", " +
                        std::to_string(p.z) + "), but the limit is " + std::to_string(max_depth));
    }
    return result;
}

/// Returns the other bodies that contain all of the instance.
EnclosingVolumes::Set EnclosingVolumes::containing(std::uint32_t instance) const
{
    const PlacedMesh& mesh = placed_[instance];
    const std::uint32_t count = mesh.triangle_count();
    Set common = all_;
    std::erase_if(common, [&](std::size_t body) { return instances_[body] == instance; });
    bool asked = false;
    for (std::size_t probe = 0; probe < max_probes && count > 0 && !common.empty(); ++probe) {
        if (const std::optional<Vec3> p = before(mesh, probed(probe, count))) {
            common = containing(*p, std::move(common));
            asked = true;
        }
    }
    return asked ? common : Set{};
}

/// Returns the body that lies in most others; among equals the smaller one.
std::optional<std::uint32_t> EnclosingVolumes::innermost(const Set& bodies) const
{
    if (bodies.empty()) {
        return std::nullopt;
    }
    const auto deeper = [&](std::size_t a, std::size_t b) {
        return around_[a].size() != around_[b].size() ? around_[a].size() > around_[b].size()
                                                      : volume(bounds_[a]) < volume(bounds_[b]);
    };
    return instances_[*std::min_element(bodies.begin(), bodies.end(), deeper)];
}

std::vector<std::optional<std::uint32_t>> EnclosingVolumes::around_all() const
{
    std::vector<std::optional<std::uint32_t>> result(placed_.size());
    tbb::parallel_for(std::size_t{0}, placed_.size(), [&](std::size_t instance) {
        const auto body = volume_of_instance_[instance];
        result[instance] =
            innermost(body ? around_[*body] : containing(static_cast<std::uint32_t>(instance)));
    });
    return result;
}

std::optional<std::uint32_t> EnclosingVolumes::at(Vec3 p) const
{
    return innermost(containing(p, all_));
}

}  // namespace bdpt
