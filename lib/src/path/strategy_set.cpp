#include "path/strategy_set.h"

#include <algorithm>
#include <cmath>

namespace bdpt {

namespace {

/// A batch keeps many threads busy, and its pixels share no errors: it has at least this many
/// pixels, light paths, and bundles (as many as a block of `PixelGroups` has pixels).
std::int64_t batches_of(double pixels, int bundle, std::int64_t bundles)
{
    constexpr double least_pixels = 1 << 18;
    constexpr double least_paths = 1 << 15;
    constexpr double least_bundles = 1 << 8;
    const auto count = static_cast<double>(bundles);
    const double most =
        std::min({pixels / least_pixels, count * bundle / least_paths, count / least_bundles});
    return most < 1.0 ? 1 : std::int64_t{1} << std::ilogb(most);
}

}  // namespace

LightPathCounts::LightPathCounts(const RenderOptions& options)
    : per_camera_path(options.bidirectional.light_paths)
{
    const bool whole = per_camera_path == std::floor(per_camera_path);
    connections = options.bidirectional.connections.value_or(whole ? per_camera_path : 1.0);
    rays = options.bidirectional.connection_rays;
    merged = options.integrator == IntegratorKind::vcm && per_camera_path > 0.0 &&
             options.bidirectional.merge_radius > 0.0;
    shared = merged ||
             (per_camera_path > 0.0 && (!whole || connections != per_camera_path || rays > 0.0));
    if (shared) {
        const double pixels =
            static_cast<double>(options.film.width) * static_cast<double>(options.film.height);
        bundle = std::max(1, static_cast<int>(std::ceil(connections)));
        bundles = std::max<std::int64_t>(1, std::llround(per_camera_path * pixels / bundle));
        per_camera_path = static_cast<double>(bundles) * bundle / pixels;
        batches = kept() && !merged ? batches_of(pixels, bundle, bundles) : 1;
    }
}

namespace {

bool is_switched_on(const RenderOptions& options, Strategy strategy)
{
    const bool by_integrator = options.integrator != IntegratorKind::lt || strategy.t <= 1;
    const auto& disabled = options.bidirectional.disabled;
    return by_integrator && std::find(disabled.begin(), disabled.end(), strategy) == disabled.end();
}

/// Paths of one edge are weighted separately.
bool has_more_edges_than_one(Strategy strategy)
{
    return strategy.s + strategy.t > 2;
}

}  // namespace

StrategySet::StrategySet(const RenderOptions& options, const LearnedLight* learned)
    : min_depth_(options.transport.min_depth),
      max_depth_(options.transport.max_depth),
      max_camera_depth_(options.bidirectional.max_camera_depth),
      max_light_depth_(options.bidirectional.max_light_depth),
      disabled_(options.bidirectional.disabled),
      light_paths_(options),
      complete_(options.integrator != IntegratorKind::lt &&
                std::none_of(options.bidirectional.disabled.begin(),
                             options.bidirectional.disabled.end(), has_more_edges_than_one) &&
                max_camera_depth_ >= max_depth_ && max_light_depth_ >= max_depth_),
      merges_(light_paths_.merged),
      // Where camera paths cannot hit lights, nothing else finds those that are directly visible.
      // Uniform weights would give few samples as much weight as many.
      visible_light_samples_(allows(1, 0, 2) && is_switched_on(options, {0, 2}) &&
                                     options.transport.heuristic != Heuristic::uniform
                                 ? options.bidirectional.visible_light_samples
                                 : 1.0),
      // Images of single strategies show what each finds by itself.
      next_event_sampling_{.environments = options.bidirectional.strategy_depth > 0
                                               ? EnvironmentSampling::plain
                                               : options.sampling.environment,
                           .lights = options.sampling.lights,
                           .samples = options.sampling.light_samples,
                           .learned = options.bidirectional.strategy_depth > 0 ? nullptr : learned}
{
    const auto of_light_paths = static_cast<float>(light_paths());
    // s = 1 samples new light points for each camera vertex; other strategies use light paths.
    counts_[0] = {1.0f, 1.0f, 1.0f};
    counts_[1] = {1.0f, static_cast<float>(visible_light_samples_),
                  static_cast<float>(next_event_sampling_.samples)};
    counts_[2] = {of_light_paths, of_light_paths, static_cast<float>(connections())};
    if (options.integrator == IntegratorKind::lt) {
        for (auto& of_s : counts_) {
            of_s[2] = 0.0f;
        }
    }
    camera_vertices_ = find_camera_vertices();
    light_vertices_ = find_light_vertices();
    if (merges_) {
        // Subpaths of a path of max_depth edges, whose two ends do not merge.
        camera_vertices_ =
            std::max(camera_vertices_, std::min(max_depth_ - 1, max_camera_depth_) + 1);
        light_vertices_ = std::max(light_vertices_, std::min(max_depth_ - 1, max_light_depth_) + 1);
    }
    for (int t = 2; t <= max_depth_; ++t) {
        if (uses(1, t) && !uses(0, t + 1)) {
            next_event_sampling_.environments = EnvironmentSampling::plain;
            next_event_sampling_.learned = nullptr;
        }
    }
}

// Kinds of strategies that take no samples are not searched, so that the time is linear in the
// depth, or proportional to the number of disabled strategies.

int StrategySet::find_camera_vertices() const
{
    for (int t = std::min(max_depth_, max_camera_depth_) + 1; t > 1; --t) {
        const int most = count_of_kind(2, t) > 0.0f ? max_depth_ + 1 - t : 1;
        for (int s = 0; s <= most; ++s) {
            if (uses(s, t)) {
                return t;
            }
        }
    }
    return 1;
}

int StrategySet::find_light_vertices() const
{
    for (int s = std::min(max_depth_, max_light_depth_) + 1; s > 1; --s) {
        const int most = count_of_kind(s, 2) > 0.0f ? max_depth_ + 1 - s : 1;
        for (int t = 1; t <= most; ++t) {
            if (uses(s, t)) {
                return s;
            }
        }
        if (uses(s, 0)) {
            return s - 1;  // the last vertex is the lens, which is not a vertex of the walk
        }
    }
    return 0;
}

}  // namespace bdpt
