#pragma once

#include "path/path_vertex.h"
#include "path/sample_context.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace bdpt {

/// Densities at a light vertex x_0 as seen from its neighbour x_1, independent of the strategy.
struct LightDensities {
    AreaPdf emit;     ///< x_0 as start of a light path (s >= 2)
    AreaPdf to_next;  ///< x_1 sampled from x_0 by a light path, excluding media
};

/// Returns the point on a light that is vertex `x0`.
[[nodiscard]] inline LightPoint light_point(const PathVertex& x0, float time)
{
    return {.p = x0.end.p, .ng = x0.end.ng, .barycentrics = x0.barycentrics, .time = time};
}

/// Returns the receiver x_1 for which next-event estimation chooses a light. It does not depend on
/// the walk that sampled the vertex: on opaque surfaces, both directions of a connection lie on one
/// side.
[[nodiscard]] inline LightSampleContext light_sample_context(const PathVertex& x1)
{
    return {.p = x1.end.p, .normal = scatters(x1.kind) ? x1.bsdf->opaque_normal() : std::nullopt};
}

/// Returns the density of x_0 on light `x0.light`, sampled from x_1 by next-event estimation.
[[nodiscard]] inline AreaPdf next_event_density(const SampleContext& sample, const PathVertex& x0,
                                                const PathVertex& x1, NextEventSampling sampling)
{
    return sample.world.lights().next_event_pdf(*x0.light, light_point(x0, sample.time),
                                                light_sample_context(x1), sampling);
}

/// Returns the densities of `x0`, a vertex on light `x0.light`, with light paths by `sampling`.
[[nodiscard]] inline LightDensities light_densities(const SampleContext& sample,
                                                    const PathVertex& x0, const SegmentEnd& x1,
                                                    NextEventSampling sampling)
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

/// Tests whether the strategy s = t = 1, which connects a light point to a lens point, can see this
/// light.
[[nodiscard]] inline bool can_be_seen_directly(const Light& light, const Camera& camera)
{
    return !light.is_delta() && !light.is_infinite() && camera.is_perspective();
}

/// Returns `Media::mean_scatterings` at a scattering event; 1 on surfaces and in fog.
[[nodiscard]] inline float mean_scatterings(const World& world, const PathVertex& vertex)
{
    return vertex.kind == VertexKind::medium
               ? world.media().mean_scatterings(vertex.end.media.ahead)
               : 1.0f;
}

/// Returns how many samples MIS weights count for a connection between two vertices, in (0, 1].
///
/// A camera path and a light path that scatter n times in the same body have n^2 connections there,
/// which vary together: all are bright if the light path comes near, and otherwise dark. Weights
/// that count each of them as a sample would prefer them to what one path finds alone, such as
/// splats. Weights that count 1 / n^2 treat them like one sample [cf. Grittmann et al. 2021,
/// "Correlation-Aware Multiple Importance Sampling for Bidirectional Rendering Algorithms"].
[[nodiscard]] inline float connection_count(const World& world, const PathVertex& a,
                                            const PathVertex& b)
{
    return 1.0f / (mean_scatterings(world, a) * mean_scatterings(world, b));
}

}  // namespace bdpt
