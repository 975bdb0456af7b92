#include "scene/framing/framing.h"

#include "math/elementary.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace bdpt {
namespace {

/// Support function of a scene in a few directions: its extent in each, from an origin [m].
class Supports {
public:
    using Directions = std::array<Vec3, 4>;

    /// `directions` may have any length.
    Supports(Vec3 origin, const Directions& directions, bool whole_turn)
        : origin_(origin), directions_(directions)
    {
        reach_.fill(-std::numeric_limits<float>::infinity());
        for (std::size_t i = 0; i < directions.size(); ++i) {
            const Vec3 d = directions[i];
            // During a whole turn about the vertical axis, a point passes the position where its
            // extent is largest.
            level_[i] = whole_turn ? std::sqrt(d.x * d.x + d.z * d.z) : -1.0f;
        }
    }

    void add(Vec3 point) { add(point, 0.0f); }

    void add(Vec3 center, float radius)
    {
        const Vec3 p = center - origin_;
        for (std::size_t i = 0; i < directions_.size(); ++i) {
            const Vec3 d = directions_[i];
            const float along = level_[i] < 0.0f
                                    ? glm::dot(p, d)
                                    : p.y * d.y + std::sqrt(p.x * p.x + p.z * p.z) * level_[i];
            const float more = radius > 0.0f ? radius * glm::length(d) : 0.0f;
            reach_[i] = std::max(reach_[i], along + more);
        }
    }

    [[nodiscard]] float operator[](std::size_t direction) const { return reach_[direction]; }

private:
    Vec3 origin_;
    Directions directions_;
    std::array<float, 4> level_{};  // length of the horizontal part of each; below 0: no turn
    std::array<float, 4> reach_{};
};

/// The points and spheres that bound a scene.
struct Outline {
    std::vector<Vec3> points{};
    std::vector<Vec4> spheres{};  ///< center and radius
};

/// Adds each vertex of the triangles of `placed` once, at all steps of its motion.
void add_vertices(const PlacedMesh& placed, Outline& outline)
{
    std::vector<bool> used(placed.mesh().positions.size());
    for (const UVec3& triangle : placed.mesh().triangles) {
        for (int corner = 0; corner < 3; ++corner) {
            used[triangle[corner]] = true;
        }
    }
    for (std::uint32_t vertex = 0; vertex < used.size(); ++vertex) {
        for (std::size_t step = 0; used[vertex] && step <= placed.steps(); ++step) {
            outline.points.push_back(placed.world_point_at(step, vertex));
        }
    }
}

/// Adds the corners of the mesh's bounding box instead, in constant time.
void add_box(const PlacedMesh& placed, const MeshBox& box, Outline& outline)
{
    for (std::size_t step = 0; step <= placed.steps(); ++step) {
        const Placement placement(placed.transform_at(step));
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3 sign((corner & 1) != 0 ? 1.0f : -1.0f, (corner & 2) != 0 ? 1.0f : -1.0f,
                            (corner & 4) != 0 ? 1.0f : -1.0f);
            outline.points.push_back(placement.point(box.center + sign * box.half));
        }
    }
}

Outline outline_of(const SceneGeometry& geometry)
{
    // Beyond this many triangles, rigid meshes are fitted by their boxes.
    constexpr std::size_t max_triangles = 4'000'000;
    const bool by_box = geometry.counts.instanced_triangles > max_triangles;
    Outline outline;
    for (std::size_t i = 0; i < geometry.placed.size(); ++i) {
        const PlacedMesh& placed = geometry.placed[i];
        const auto mesh = static_cast<std::size_t>(geometry.instances[i].mesh);
        if (by_box && !placed.deforms() && geometry.boxes[mesh]) {
            add_box(placed, *geometry.boxes[mesh], outline);
        } else {
            add_vertices(placed, outline);
        }
    }
    for (const Sphere& sphere : geometry.spheres) {
        outline.spheres.emplace_back(sphere.center, sphere.radius);
        for (const Vec3 center : sphere.motion) {
            outline.spheres.emplace_back(center, sphere.radius);
        }
    }
    for (const VolumeDesc& volume : geometry.volumes) {
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3 sides((corner & 1) != 0 ? 1.0f : 0.0f, (corner & 2) != 0 ? 1.0f : 0.0f,
                             (corner & 4) != 0 ? 1.0f : 0.0f);
            outline.points.emplace_back(volume.world_from_grid *
                                        Vec4(sides * Vec3(volume.size), 1.0f));
        }
    }
    return outline;
}

/// Sides of the frustum, or of a box if both slopes are 0, that touch the scene.
struct Sides {
    Vec2 center;  ///< position along right and up of an eye equally far from opposite sides [m]
    Vec2 width;   ///< distance of opposite sides in the plane of that eye and `middle` [m]
};

/// A frame of reference in which scenes are fitted.
class Fit {
public:
    Fit(const SceneGeometry& geometry, const Mat3& axes, bool whole_turn)
        : outline_(outline_of(geometry)),
          axes_(axes),
          middle_(0.5f * (geometry.bounds.min + geometry.bounds.max)),
          whole_turn_(whole_turn)
    {}

    [[nodiscard]] Vec3 middle() const { return middle_; }

    /// Computes the sides that touch the scene. A point p is left of the right side of the frustum
    /// of an eye c if dot(p, right + slope back) <= dot(c, right + slope back), and so on.
    [[nodiscard]] Sides sides(Vec2 slope) const
    {
        const Vec3 aslant_x = slope.x * axes_[2];
        const Vec3 aslant_y = slope.y * axes_[2];
        Supports supports(
            middle_,
            {axes_[0] + aslant_x, -axes_[0] + aslant_x, axes_[1] + aslant_y, -axes_[1] + aslant_y},
            whole_turn_);
        for (const Vec3 point : outline_.points) {
            supports.add(point);
        }
        for (const Vec4& sphere : outline_.spheres) {
            supports.add(Vec3(sphere), sphere.w);
        }
        if (!std::isfinite(supports[0])) {
            supports.add(middle_);  // for an empty scene
        }
        return {.center = 0.5f * Vec2(supports[0] - supports[1], supports[2] - supports[3]),
                .width = Vec2(supports[0] + supports[1], supports[2] + supports[3])};
    }

    /// Returns the position along `axis` from which an eye at that depth sees the scene centred in
    /// the image: the centre of the sides of the smallest slope that shows all of it. `shown` has
    /// room for all.
    [[nodiscard]] float centered(int axis, float depth, Vec2 slope, Sides shown) const
    {
        // The margin, 2 slope depth - width, is concave in the slope, so chords from slope 0 lead
        // to slopes that show all.
        constexpr int steps = 4;
        float most = slope[axis];
        const float parallel = sides(Vec2(0.0f)).width[axis];
        for (int step = 0; step < steps; ++step) {
            const float room = 2.0f * most * depth - shown.width[axis];
            if (!(room > 0.0f)) {
                break;
            }
            most *= parallel / (parallel + room);
            slope[axis] = most;
            shown = sides(slope);
        }
        return shown.center[axis];
    }

private:
    Outline outline_;
    Mat3 axes_;
    Vec3 middle_;
    bool whole_turn_;
};

}  // namespace

CameraDesc fitted_camera(const SceneGeometry& geometry, const Mat3& axes, const FitTarget& target)
{
    const Fit fit(geometry, axes, target.whole_turn);
    const float size = glm::length(geometry.bounds.max - geometry.bounds.min);
    const float used = 1.0f - 2.0f * target.margin;
    CameraDesc camera = target.camera;
    Vec3 eye(0.0f);
    if (camera.projection == Projection::orthographic) {
        const Sides box = fit.sides(Vec2(0.0f));
        const float extent = std::max(box.width.y, box.width.x / target.aspect) / used;
        camera.vertical_extent = extent > 0.0f ? extent : 1.0f;
        eye = Vec3(box.center, size > 0.0f ? size : 1.0f);
    } else {
        const SinCos half = sin_cos(0.5f * camera.vertical_fov);
        const float slope_y = used * half.sin / half.cos;
        const Vec2 slope(slope_y * target.aspect, slope_y);
        const Sides frustum = fit.sides(slope);
        const Vec2 depth = 0.5f * frustum.width / slope;
        const float nearest = size > 0.0f ? 0.01f * size : 1.0f;
        eye = Vec3(frustum.center, std::max({depth.x, depth.y, nearest}));
        const int free_axis = depth.x < depth.y ? 0 : 1;
        eye[free_axis] = fit.centered(free_axis, eye.z, slope, frustum);
    }
    camera.world_from_camera = Mat4(Vec4(axes[0], 0.0f), Vec4(axes[1], 0.0f), Vec4(axes[2], 0.0f),
                                    Vec4(fit.middle() + axes * eye, 1.0f));
    return camera;
}

}  // namespace bdpt
