#include "camera/camera.h"
#include "scene/scene_names.h"
#include "scene/world.h"

#include <bdpt/error.h>
#include <bdpt/scene.h>
#include <bdpt/tools/pixel_hits.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <glm/geometric.hpp>

#include <map>
#include <string>

namespace bdpt {
namespace {

/// Calls `visit(x, y, index)` for all pixels, row by row on several threads.
template <typename Visit>
void for_each_pixel(int width, int height, const Visit& visit)
{
    tbb::parallel_for(tbb::blocked_range<int>(0, height), [&](const auto& rows) {
        for (int y = rows.begin(); y < rows.end(); ++y) {
            for (int x = 0; x < width; ++x) {
                visit(x, y,
                      static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                          static_cast<std::size_t>(x));
            }
        }
    });
}

Camera pinhole(CameraDesc desc, int width, int height)
{
    desc.lens_radius = 0.0f;
    desc.motion.clear();
    return {desc, width, height};
}

Vec2 middle_of_pixel(int x, int y)
{
    return Vec2(x, y) + 0.5f;
}

/// Returns the point of `desc` that `hit` met, perhaps at another time; none if there is none.
std::optional<Vec3> same_point(const SharedSceneDesc& desc, const SurfaceHit& hit)
{
    if (!hit.instance || *hit.instance >= desc.instances.size()) {
        return std::nullopt;
    }
    const InstanceDesc& instance = desc.instances[*hit.instance];
    const MeshDesc& mesh = desc.meshes[static_cast<std::size_t>(instance.mesh)];
    if (hit.triangle >= mesh.triangles.size()) {
        return std::nullopt;
    }
    const UVec3& corners = mesh.triangles[hit.triangle];
    const Vec2 b = hit.barycentrics;
    const Vec3 local = (1.0f - b.x - b.y) * mesh.positions[corners.x] +
                       b.x * mesh.positions[corners.y] + b.y * mesh.positions[corners.z];
    return Vec3(instance.world_from_object * Vec4(local, 1.0f));
}

/// Tests whether the camera sees a point that appears at `raster`, to within rounding.
bool sees(const Scene& scene, const Camera& camera, Vec2 raster, Vec3 point)
{
    constexpr float tolerance = 1e-3f;  // of the distance
    const CameraRay ray = camera.generate_ray(raster, Vec2(0.5f));
    const float distance = glm::distance(ray.lens.p, point);
    const auto hit = first_hit(scene, ray.lens.p, ray.direction);
    return !hit || hit->distance > (1.0f - tolerance) * distance;
}

}  // namespace

PixelHits pixel_hits(const Scene& scene, const CameraDesc& camera, int width, int height)
{
    if (width < 1 || height < 1) {
        throw Error(ErrorCode::usage, "pixel hits: the image is " + std::to_string(width) + "x" +
                                          std::to_string(height) + " pixels");
    }
    const Camera eye = pinhole(camera, width, height);
    PixelHits seen{.width = width, .height = height, .hits = {}};
    seen.hits.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for_each_pixel(width, height, [&](int x, int y, std::size_t i) {
        const CameraRay ray = eye.generate_ray(middle_of_pixel(x, y), Vec2(0.5f));
        seen.hits[i] = first_hit(scene, ray.lens.p, ray.direction);
    });
    return seen;
}

IdNumbers id_numbers(const Scene& scene, IdKind kind)
{
    const auto index = static_cast<std::size_t>(kind);
    const SceneNames scene_names(scene.description());
    IdNumbers numbers{.of_instances = {}, .names = {""}};
    std::map<NameId, std::uint32_t> by_id;
    const IdNames names = scene_names.names({id_aovs[index]});
    for (const NamedId& named : names[index]) {
        by_id.emplace(named.id, static_cast<std::uint32_t>(numbers.names.size()));
        numbers.names.push_back(named.name);
    }
    for (const NameId id : scene_names.ids(kind)) {
        numbers.of_instances.push_back(by_id.at(id));
    }
    return numbers;
}

std::vector<std::uint32_t> id_mask(const PixelHits& seen, const IdNumbers& numbers)
{
    std::vector<std::uint32_t> mask;
    mask.reserve(seen.hits.size());
    for (const std::optional<SurfaceHit>& hit : seen.hits) {
        mask.push_back(hit && hit->instance ? numbers.of_instances.at(*hit->instance) : 0);
    }
    return mask;
}

std::vector<PixelFlow> optical_flow(const PixelHits& seen, const Scene& later,
                                    const CameraDesc& camera)
{
    const Camera eye = pinhole(camera, seen.width, seen.height);
    std::vector<PixelFlow> flow(seen.hits.size());
    for_each_pixel(seen.width, seen.height, [&](int x, int y, std::size_t i) {
        const std::optional<SurfaceHit>& hit = seen.hits[i];
        const std::optional<Vec3> point =
            hit ? same_point(later.description(), *hit) : std::nullopt;
        const std::optional<Vec2> raster = point ? eye.project(*point) : std::nullopt;
        if (!raster) {
            return;
        }
        const bool inside = raster->x >= 0.0f && raster->y >= 0.0f &&
                            raster->x <= static_cast<float>(seen.width) &&
                            raster->y <= static_cast<float>(seen.height);
        flow[i] = {.motion = *raster - middle_of_pixel(x, y),
                   .is_visible = inside && sees(later, eye, *raster, *point)};
    });
    return flow;
}

}  // namespace bdpt
