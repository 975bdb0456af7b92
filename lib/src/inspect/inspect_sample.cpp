#include "inspect/pixel_walk.h"

#include <bdpt/inspect.h>
#include <bdpt/render.h>

#include <mutex>
#include <span>

namespace bdpt {
namespace {

InspectedKind to_inspected_kind(VertexKind kind)
{
    switch (kind) {
        case VertexKind::camera:
            return InspectedKind::lens;
        case VertexKind::light:
            return InspectedKind::light;
        case VertexKind::surface:
            return InspectedKind::surface;
        case VertexKind::medium:
        case VertexKind::volume:
            return InspectedKind::medium;
        case VertexKind::infinite:
            return InspectedKind::infinite;
    }
    return InspectedKind::surface;
}

std::vector<InspectedVertex> described(std::span<const PathVertex> path)
{
    std::vector<InspectedVertex> result;
    for (const PathVertex& vertex : path) {
        const bool on_surface = vertex.kind == VertexKind::surface && vertex.bsdf != nullptr;
        result.push_back({.kind = to_inspected_kind(vertex.kind),
                          .position = vertex.end.p,
                          .normal = on_surface ? vertex.bsdf->shading_normal() : Vec3(0.0f),
                          .beta = vertex.beta,
                          .emission = vertex.emission,
                          .pdf_fwd = vertex.pdf_fwd.value,
                          .is_light = vertex.light.has_value(),
                          .connectible = vertex.connectible,
                          .scattered_delta = vertex.scattered_delta});
    }
    return result;
}

}  // namespace

InspectedSample inspect_sample(const Scene& scene, const CameraDesc& camera,
                               const RenderOptions& options, const PixelSample& sample)
{
    const RenderOptions chosen = inspected_options(scene, camera, options, sample);
    InspectedSample result;
    std::mutex mutex;
    RenderControl control;
    control.on_path = [&](const PathContribution& path) {
        const std::lock_guard lock(mutex);
        result.contributions.push_back({.strategy = path.strategy,
                                        .light_path = path.light_path,
                                        .unweighted = path.unweighted,
                                        .weight = path.weight,
                                        .shares = {path.shares.begin(), path.shares.end()}});
        result.value += path.weight * path.unweighted;
    };
    static_cast<void>(render(scene, camera, chosen, control));
    PixelWalk walk(scene, camera, chosen, sample);
    result.raster = walk.raster();
    result.time = walk.sample().time;
    result.camera_path = described(walk.camera_path().all());
    const Subpath light_path = walk.light_path();
    result.light_path = described(light_path.all());
    return result;
}

}  // namespace bdpt
