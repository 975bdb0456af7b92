#include "pilot/visibility_pilot.h"

#include "camera/moving_camera.h"
#include "geometry/flush_denormals.h"
#include "integrator/sample_start.h"
#include "math/rgb.h"
#include "path/densities.h"
#include "path/random_walk.h"

#include <tbb/parallel_for.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace bdpt {
namespace {

using Trials = std::vector<EnvironmentVisibility::Trial>;

/// Camera paths along each side of the image: one per pixel, up to a number beyond which more have
/// no benefit.
constexpr int min_side = 16;
constexpr int max_side = 128;
/// Later vertices lie where earlier ones do, and carry less light.
constexpr int visibility_edges = 8;
constexpr std::uint64_t visibility_seed = 0x7669736962;  // a seed that users will hardly choose
/// If a larger fraction of rays reaches the environment, tiles without learned visibility do as
/// well and take less time: a shader ball gains at 0.76, a car in a studio does not at 0.80.
constexpr double max_visible = 0.78;
/// If a smaller fraction does, everything is hidden equally and there is nothing to learn.
constexpr double min_visible = 1e-3;

/// Tests whether learned visibility can help this render.
bool may_help(const World& world, const RenderOptions& options)
{
    // In fog, points on segments are sampled for a light, without a receiver.
    return options.sampling.environment == EnvironmentSampling::learned &&
           options.integrator != IntegratorKind::pt && options.integrator != IntegratorKind::nee &&
           options.integrator != IntegratorKind::lt && options.transport.max_depth >= 2 &&
           world.lights().environment() && world.media().fog() == MediumId::clear;
}

int pilot_side(const RenderOptions& options)
{
    const double pixels = static_cast<double>(options.film.width) * options.film.height;
    return static_cast<int>(std::clamp<double>(std::sqrt(pixels), min_side, max_side));
}

/// Camera paths of one row of the pilot.
class VisibilityRow {
public:
    VisibilityRow(const World& world, const MovingCamera& camera, const RenderOptions& options)
        : world_(world),
          camera_(camera),
          options_(options),
          environment_(
              std::get<EnvironmentLight>(world.lights()[*world.lights().environment()].model())),
          path_(std::min(options.transport.max_depth, visibility_edges) + 1)
    {}

    [[nodiscard]] Trials trace(int row)
    {
        const int side = pilot_side(options_);
        for (int column = 0; column < side; ++column) {
            Sampler sampler(SamplerKind::independent, visibility_seed, column, row, 0);
            sampler.start(SampleUse::film);
            const Vec2 in_cell = sampler.next_2d();
            const Vec2 raster =
                (Vec2(column, row) + in_cell) *
                (Vec2(options_.film.width, options_.film.height) / static_cast<float>(side));
            const TimeAndWavelength moment = draw_time_and_wavelength(sampler, world_, camera_);
            const TimedCamera camera(camera_, moment.time);
            SampleContext sample{.world = world_,
                                 .camera = camera.get(),
                                 .sampler = sampler,
                                 .time = moment.time,
                                 .wavelength = moment.wavelength,
                                 .rays = rays_,
                                 .clock = nullptr};
            trace_camera_subpath(sample, raster,
                                 {.max_vertices = path_.capacity(),
                                  .rr_start = options_.transport.rr_start,
                                  .rr_survival = options_.transport.rr_survival},
                                 path_);
            note_path(sample);
        }
        return std::move(trials_);
    }

private:
    void note_path(SampleContext& sample)
    {
        for (int t = 2; t <= path_.size(); ++t) {
            const PathVertex& vertex = path_[t - 1];
            if (!scatters(vertex.kind) || !vertex.connectible) {
                continue;
            }
            if (t < path_.size()) {
                const PathVertex& next = path_[t];
                const bool visible = next.kind == VertexKind::infinite;
                note(vertex, visible ? next.end.p : normalize(next.end.p - vertex.end.p), visible);
            }
            sample_environment(sample, vertex, t);
        }
    }

    void sample_environment(SampleContext& sample, const PathVertex& vertex, int t)
    {
        sample.sampler.start(SampleUse::next_event, static_cast<std::uint32_t>(t));
        const auto incident =
            environment_.sample_incident(light_sample_context(vertex), sample.sampler.next_2d(),
                                         EnvironmentSampling::compensated, sample.time);
        if (!incident || is_black(vertex.bsdf->eval(incident->wi, TransportMode::radiance).f_cos)) {
            return;
        }
        note(vertex, incident->wi,
             world_.transmission_to_infinity(vertex.end, incident->wi, sample.segment(1, t))
                 .has_value());
    }

    void note(const PathVertex& vertex, Vec3 direction, bool visible)
    {
        trials_.push_back({.p = vertex.end.p,
                           .tile = static_cast<std::uint32_t>(environment_.tile_to(direction)),
                           .visible = visible});
    }

    const World& world_;
    const MovingCamera& camera_;
    const RenderOptions& options_;
    const EnvironmentLight& environment_;
    Subpath path_;
    RayCounts rays_;
    Trials trials_;
};

}  // namespace

std::unique_ptr<const EnvironmentVisibility> learn_visibility(const World& world,
                                                              const MovingCamera& camera,
                                                              const RenderOptions& options,
                                                              const std::stop_token& abandon)
{
    if (!may_help(world, options)) {
        return nullptr;
    }
    const int side = pilot_side(options);
    std::vector<Trials> rows(static_cast<std::size_t>(side));
    tbb::parallel_for(0, side, [&](int row) {
        if (abandon.stop_requested()) {
            return;
        }
        const FlushDenormals flush;
        rows[static_cast<std::size_t>(row)] = VisibilityRow(world, camera, options).trace(row);
    });
    if (abandon.stop_requested()) {
        return nullptr;
    }
    Trials all;
    for (const Trials& row : rows) {
        all.insert(all.end(), row.begin(), row.end());
    }
    const auto visible =
        std::count_if(all.begin(), all.end(), [](const auto& trial) { return trial.visible; });
    const double share = static_cast<double>(visible) / static_cast<double>(all.size());
    if (all.empty() || share < min_visible || share > max_visible) {
        return nullptr;
    }
    return std::make_unique<const EnvironmentVisibility>(std::move(all));
}

}  // namespace bdpt
