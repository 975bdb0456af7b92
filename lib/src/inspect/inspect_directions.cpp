#include "inspect/pixel_walk.h"
#include "math/elementary.h"
#include "path/densities.h"

#include <bdpt/error.h>
#include <bdpt/inspect.h>

#include <glm/geometric.hpp>

#include <cmath>
#include <optional>
#include <string>

namespace bdpt {
namespace {

constexpr int strata = 4;  // rays along each side of a pixel

/// Returns the direction at (u, v) of an image with +y at the top and -z in the centre.
Vec3 direction_at(float u, float v)
{
    const SinCos turn = sin_cos(2.0f * pi * (u - 0.5f));
    const SinCos from_top = sin_cos(pi * v);
    return {turn.sin * from_top.sin, from_top.cos, -turn.cos * from_top.sin};
}

/// Light that arrives from a direction.
struct Seen {
    Rgb radiance{0.0f};
    std::optional<PathVertex> light{};  ///< vertex on the light
};

Seen look(const SampleContext& sample, const SegmentEnd& from, Vec3 direction, SegmentKey segment)
{
    Seen seen;
    PathVertex x0;
    if (const auto point = sample.world.intersect(from, direction, segment)) {
        if (!point->light) {
            return seen;
        }
        seen.radiance = point->emission;
        x0.kind = VertexKind::light;
        x0.light = point->light;
        x0.end = point->end;
        x0.barycentrics = point->barycentrics;
    } else if (const auto id = sample.world.lights().environment()) {
        const auto& light = std::get<EnvironmentLight>(sample.world.lights()[*id].model());
        seen.radiance = light.radiance(direction);
        x0.kind = VertexKind::infinite;
        x0.light = id;
        x0.end.p = direction;
    } else {
        return seen;
    }
    seen.light = x0;
    return seen;
}

/// Returns the density of the light sample that finds `x0` from `vertex`.
float light_density(const SampleContext& sample, const PathVertex& x0, const PathVertex& vertex,
                    Vec3 direction, NextEventSampling sampling)
{
    const float pdf = next_event_density(sample, x0, vertex, sampling).value;
    if (x0.kind == VertexKind::infinite) {
        return pdf;
    }
    const Vec3 along = x0.end.p - vertex.end.p;
    const float cosine = std::abs(dot(x0.end.ng, direction));
    return cosine > 0.0f ? pdf * dot(along, along) / cosine : 0.0f;
}

Image black(int width)
{
    return {.width = width,
            .height = width / 2,
            .pixels = std::vector<Rgb>(static_cast<std::size_t>(width) *
                                       static_cast<std::size_t>(width / 2))};
}

const PathVertex& checked_vertex(const Subpath& path, int vertex)
{
    if (vertex < 1 || vertex >= path.size()) {
        throw Error(ErrorCode::usage,
                    "vertex " + std::to_string(vertex) +
                        ": the camera path of this sample has the vertices 1 to " +
                        std::to_string(path.size() - 1));
    }
    const PathVertex& result = path.all()[static_cast<std::size_t>(vertex)];
    if (!scatters(result.kind) || !result.connectible) {
        throw Error(ErrorCode::usage,
                    "vertex " + std::to_string(vertex) +
                        " has no directional pdf: it does not scatter, or only by delta lobes");
    }
    return result;
}

}  // namespace

DirectionMaps inspect_directions(const Scene& scene, const CameraDesc& camera,
                                 const RenderOptions& options, const PixelSample& sample,
                                 int vertex, int width)
{
    constexpr int widest = 8192;
    if (width < 2 || width > widest || width % 2 != 0) {
        throw Error(ErrorCode::usage, "width of the images of directions is " +
                                          std::to_string(width) + ", not even or not in [2, 8192]");
    }
    PixelWalk walk(scene, camera, inspected_options(scene, camera, options, sample), sample);
    const SampleContext& context = walk.sample();
    const PathVertex& from = checked_vertex(walk.camera_path(), vertex);
    const SegmentKey segment = context.segment(0, vertex + 1);
    DirectionMaps maps{black(width), black(width), black(width), black(width), black(width)};
    constexpr float share = 1.0f / (strata * strata);
    for (std::size_t i = 0; i < maps.incident.pixels.size(); ++i) {
        const auto column = static_cast<int>(i) % width;
        const auto row = static_cast<int>(i) / width;
        for (int k = 0; k < strata * strata; ++k) {
            const auto in_strata = [](int at) { return static_cast<float>(at) + 0.5f; };
            const float scale = 1.0f / static_cast<float>(strata * width);
            const Vec3 direction =
                direction_at(in_strata(strata * column + k % strata) * scale,
                             in_strata(strata * row + k / strata) * 2.0f * scale);
            const BsdfEval f = from.bsdf->eval(direction, TransportMode::radiance);
            const Seen seen = look(context, from.end, direction, segment);
            maps.incident.pixels[i] += share * seen.radiance;
            maps.scattering.pixels[i] += share * f.f_cos;
            maps.product.pixels[i] += share * f.f_cos * seen.radiance;
            maps.bsdf_pdf.pixels[i] += Rgb(share * f.pdf_fwd.value);
            if (seen.light) {
                maps.light_pdf.pixels[i] +=
                    Rgb(share * light_density(context, *seen.light, from, direction,
                                              walk.next_event_sampling()));
            }
        }
    }
    return maps;
}

}  // namespace bdpt
