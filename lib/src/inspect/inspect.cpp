#include <bdpt/inspect.h>

#include "camera/camera.h"
#include "film/pixel_filter.h"
#include "integrator/sample_schedule.h"
#include "light/learned/learned_light.h"
#include "math/elementary.h"
#include "path/densities.h"
#include "path/random_walk.h"
#include "path/sample_context.h"
#include "path/strategy_set.h"
#include "render/view.h"

#include <bdpt/error.h>
#include <bdpt/options/integrators.h>
#include <bdpt/render.h>

#include <glm/geometric.hpp>

#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>

namespace bdpt {
namespace {

NextEventSampling find_sampling(const RenderOptions& options, const LearnedLight* learned)
{
    if (info(options.integrator).has_strategies) {
        return StrategySet(options, learned).next_event_sampling();
    }
    const bool weighs = options.integrator == IntegratorKind::mis;
    return {.environments = weighs ? options.sampling.environment : EnvironmentSampling::plain,
            .lights = options.sampling.lights,
            .learned = weighs ? learned : nullptr};
}

WalkLimits make_limits(const RenderOptions& options, int max_vertices)
{
    return {.max_vertices = max_vertices,
            .rr_start = options.transport.rr_start,
            .rr_survival = options.transport.rr_survival};
}

/// Returns `options` with `automatic` resolved, for this sample alone and on one thread. Throws
/// like `inspect_sample`.
RenderOptions inspected_options(const Scene& scene, const CameraDesc& camera, RenderOptions options,
                                const PixelSample& sample)
{
    const bool in_image = sample.x >= 0 && sample.y >= 0 && sample.x < options.film.width &&
                          sample.y < options.film.height;
    if (!in_image) {
        throw Error(ErrorCode::usage,
                    "pixel " + std::to_string(sample.x) + "," + std::to_string(sample.y) +
                        " is outside of the image of " + std::to_string(options.film.width) + "x" +
                        std::to_string(options.film.height) + " pixels");
    }
    options.bidirectional.strategy_depth = 0;
    options = chosen_options(scene, camera, options);  // before the crop, which has its own choice
    options.film.crop =
        PixelRect{.x0 = sample.x, .y0 = sample.y, .x1 = sample.x + 1, .y1 = sample.y + 1};
    options.film.aovs = {};
    options.sampling.samples = {.begin = sample.index, .end = sample.index + 1};
    if (options.sampling.rates) {
        // The pixel's own number of samples, which has the same random numbers without rates.
        const int log = log_samples(options.sampling, sample.x, sample.y);
        options.sampling.planned_samples = log == Sampler::open_ended ? 0 : std::int64_t{1} << log;
        options.sampling.rates = nullptr;
    }
    options.system.threads = 1;
    if (options.integrator == IntegratorKind::vcm) {
        throw Error(ErrorCode::usage,
                    "vcm cannot be inspected: its merged paths belong to no strategy (s, t)");
    }
    return options;
}

/// The camera path of a sample, as integrators trace it.
class PixelWalk {
public:
    /// `options` are `inspected_options`. `scene` must outlive this object.
    PixelWalk(const Scene& scene, const CameraDesc& camera, const RenderOptions& options,
              const PixelSample& sample);
    PixelWalk(const PixelWalk&) = delete;
    PixelWalk& operator=(const PixelWalk&) = delete;

    [[nodiscard]] SampleContext& sample() { return sample_; }
    [[nodiscard]] Vec2 raster() const { return start_.raster; }
    [[nodiscard]] const Subpath& camera_path() const { return camera_path_; }
    [[nodiscard]] NextEventSampling next_event_sampling() const { return next_event_sampling_; }
    /// Returns the light path of the sample, if its integrator has one of its own.
    [[nodiscard]] Subpath light_path();

private:
    RenderOptions options_;
    MovingCamera camera_;
    SampleStart start_;
    TimedCamera timed_;
    RayCounts rays_;
    SampleContext sample_;
    std::shared_ptr<const LearnedLight> learned_;
    NextEventSampling next_event_sampling_;
    Subpath camera_path_;
};

PixelWalk::PixelWalk(const Scene& scene, const CameraDesc& camera, const RenderOptions& options,
                     const PixelSample& sample)
    : options_(options),
      camera_(open_camera(scene.world(), camera, options)),
      start_(options_, PixelFilter(options.film.filter), scene.world(), camera_, sample.x, sample.y,
             sample.index),
      timed_(camera_, start_.moment.time),
      sample_(start_.context(scene.world(), timed_.get(), rays_)),
      learned_(learned_light(scene.world(), camera, options)),
      next_event_sampling_(find_sampling(options, learned_.get())),
      camera_path_(options.transport.max_depth + 1)
{
    trace_camera_subpath(sample_, start_.raster, make_limits(options_, camera_path_.capacity()),
                         camera_path_);
}

Subpath PixelWalk::light_path()
{
    const bool own =
        info(options_.integrator).traces_light_paths && !LightPathCounts(options_).shared;
    Subpath path(own ? StrategySet(options_).light_vertices() : 0);
    if (path.capacity() > 0) {
        trace_light_subpath(sample_, make_limits(options_, path.capacity()), next_event_sampling_,
                            path);
    }
    return path;
}

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
