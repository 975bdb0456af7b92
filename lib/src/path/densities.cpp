#include "path/densities.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace bdpt {
namespace {

LightPoint light_point(const PathVertex& x0, float time)
{
    return {.p = x0.end.p, .ng = x0.end.ng, .barycentrics = x0.barycentrics, .time = time};
}

}  // namespace

bool can_be_seen_directly(const Light& light, const Camera& camera)
{
    return !light.is_delta() && !light.is_infinite() && camera.is_perspective();
}

LightSampleContext light_sample_context(const PathVertex& x1)
{
    return {.p = x1.end.p, .normal = scatters(x1.kind) ? x1.bsdf->opaque_normal() : std::nullopt};
}

AreaPdf next_event_density(const SampleContext& sample, const PathVertex& x0, const PathVertex& x1,
                           NextEventSampling sampling)
{
    return sample.world.lights().next_event_pdf(*x0.light, light_point(x0, sample.time),
                                                light_sample_context(x1), sampling);
}

LightDensities light_densities(const SampleContext& sample, const PathVertex& x0,
                               const SegmentEnd& x1, NextEventSampling sampling)
{
    const bool infinite = x0.kind == VertexKind::infinite;
    const Vec3 offset = x0.end.p - x1.p;
    const float distance_squared = dot(offset, offset);
    const Vec3 to_light = infinite ? x0.end.p : offset * (1.0f / std::sqrt(distance_squared));
    const LightSet::EmissionPdfs pdfs = sample.world.lights().emission_pdfs(
        *x0.light, light_point(x0, sample.time), x1.p, to_light, sampling.learned);
    const float cosine = abs_cosine(x1, to_light);
    return {.emit = pdfs.position,
            .to_next = infinite ? to_area(pdfs.entry, cosine)
                                : to_area(pdfs.direction, cosine, distance_squared)};
}

}  // namespace bdpt
