#include "path/merge.h"

#include "math/rgb.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace bdpt {

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
