#include "path/merge.h"

#include "math/elementary.h"
#include "math/rgb.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace bdpt {

Merging::Merging(const RenderOptions& options, const LightPathCounts& counts,
                 const BoundingSphere& scene, std::int64_t index)
{
    if (!counts.merged) {
        return;
    }
    // Below these values positions lose all digits, or squared distances underflow.
    const float least = std::max(1e-7f * scene.radius, std::sqrt(coincident));
    const float exponent = 0.5f * (static_cast<float>(options.bidirectional.merge_alpha) - 1.0f);
    const float first = static_cast<float>(options.bidirectional.merge_radius) * scene.radius;
    radius =
        std::max(least, first * exp_exact(exponent * log_exact(static_cast<float>(index + 1))));
    light_paths = static_cast<float>(counts.bundles * counts.bundle);
}

float Merging::disk() const
{
    return pi * radius * radius;
}

std::optional<Contribution> merge(std::span<const PathVertex> light,
                                  std::span<const PathVertex> camera, const Merging& merging,
                                  PathWeigher& weigher)
{
    const PathVertex& y = light.back();
    const PathVertex& z = camera.back();
    const PathVertex& before_y = light[light.size() - 2];
    const PathVertex& before_z = camera[camera.size() - 2];
    const Vec3 wi = before_y.kind == VertexKind::infinite
                        ? before_y.end.p
                        : glm::normalize(before_y.end.p - y.end.p);
    const float cosine = std::abs(dot(wi, z.end.ng));
    const BsdfEval f = z.bsdf->eval(wi, TransportMode::radiance);
    if (cosine == 0.0f || is_black(f.f_cos)) {
        return std::nullopt;
    }
    // Incident flux includes the cosine at the surface, so that of f_cos is removed. The surface's
    // opacity affected both walks, but counts once in the path.
    const Rgb value = z.beta * f.f_cos * y.beta * (1.0f / (cosine * z.opacity * merging.disk()));
    if (is_black(value)) {
        return std::nullopt;
    }
    return Contribution{
        .unweighted = value,
        .weight = weigher.weight_of_merge(
            light, camera,
            {.light_at_camera_end = y.pdf_fwd,
             .light_at_camera_neighbor = {f.pdf_rev.value * before_z.area_per_solid_angle},
             .camera_at_light_end = {f.pdf_fwd.value * before_y.area_per_solid_angle},
             .camera_at_light_neighbor =
                 light.size() > 2 ? light[light.size() - 3].pdf_rev : AreaPdf{},
             .next_event = light[0].pdf_next_event}),
        .dispersed = y.dispersed || z.dispersed};
}

}  // namespace bdpt
