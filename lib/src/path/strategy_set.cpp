#include "path/strategy_set.h"

#include <algorithm>
#include <cstddef>

namespace bdpt {
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
      stride_(options.transport.max_depth + 2),
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
    counts_.assign(static_cast<std::size_t>(stride_ * stride_), 0.0f);
    for (int s = 0; s < stride_; ++s) {
        for (int t = 0; s + t < stride_; ++t) {
            if (s + t < 2 || !allows(s + t - 1, s, t) || !is_switched_on(options, {s, t})) {
                continue;
            }
            // s = 1 samples new light points for each camera vertex; other strategies use light
            // paths.
            const double samples = s == 1 && t >= 2   ? next_event_sampling_.samples
                                   : s == 1 && t == 1 ? visible_light_samples_
                                   : s <= 1           ? 1.0
                                   : t <= 1           ? light_paths()
                                                      : connections();
            if (samples == 0.0) {
                continue;
            }
            counts_[static_cast<std::size_t>(s * stride_ + t)] = static_cast<float>(samples);
            camera_vertices_ = std::max(camera_vertices_, t);
            // For t = 0 the last vertex is the lens, which is not a vertex of the walk.
            light_vertices_ = std::max(light_vertices_, s < 2 ? 0 : t == 0 ? s - 1 : s);
        }
    }
    if (merges_) {
        // Subpaths of a path of max_depth edges, whose two ends do not merge.
        camera_vertices_ =
            std::max(camera_vertices_, std::min(max_depth_ - 1, max_camera_depth_) + 1);
        light_vertices_ = std::max(light_vertices_, std::min(max_depth_ - 1, max_light_depth_) + 1);
    }
    for (int t = 2; t + 1 < stride_; ++t) {
        if (uses(1, t) && !uses(0, t + 1)) {
            next_event_sampling_.environments = EnvironmentSampling::plain;
            next_event_sampling_.learned = nullptr;
        }
    }
}

}  // namespace bdpt
