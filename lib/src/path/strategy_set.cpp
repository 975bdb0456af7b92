#include "path/strategy_set.h"

#include <algorithm>
#include <cstddef>

namespace bdpt {
namespace {

bool is_used(const RenderOptions& options, Strategy strategy)
{
    const auto [s, t] = strategy;
    const int edges = s + t - 1;
    const bool by_length = edges >= options.transport.min_depth &&
                           edges <= options.transport.max_depth &&
                           t - 1 <= options.bidirectional.max_camera_depth &&
                           s - 1 <= options.bidirectional.max_light_depth;
    const bool by_integrator = options.integrator != IntegratorKind::lt || t <= 1;
    const auto& disabled = options.bidirectional.disabled;
    return by_length && by_integrator &&
           std::find(disabled.begin(), disabled.end(), strategy) == disabled.end();
}

}  // namespace

StrategySet::StrategySet(const RenderOptions& options)
    : stride_(options.transport.max_depth + 2),
      light_paths_(options),
      complete_(options.integrator == IntegratorKind::bdpt &&
                options.bidirectional.disabled.empty() &&
                options.bidirectional.max_camera_depth >= options.transport.max_depth &&
                options.bidirectional.max_light_depth >= options.transport.max_depth),
      // Images of single strategies show what each finds by itself.
      next_event_sampling_{.environments = options.bidirectional.strategy_depth > 0
                                               ? EnvironmentSampling::plain
                                               : options.sampling.environment,
                           .lights = options.sampling.lights}
{
    counts_.assign(static_cast<std::size_t>(stride_ * stride_), 0.0f);
    for (int s = 0; s < stride_; ++s) {
        for (int t = 0; s + t < stride_; ++t) {
            if (s + t < 2 || !is_used(options, {s, t})) {
                continue;
            }
            // A fresh light point for each camera vertex (s = 1); the rest comes from light paths.
            const double samples = s <= 1 ? 1.0 : t <= 1 ? light_paths() : connections();
            if (samples == 0.0) {
                continue;
            }
            counts_[static_cast<std::size_t>(s * stride_ + t)] = static_cast<float>(samples);
            camera_vertices_ = std::max(camera_vertices_, t);
            // A path that hits the lens has it as its last vertex, which is not a vertex of the
            // walk.
            light_vertices_ = std::max(light_vertices_, s < 2 ? 0 : t == 0 ? s - 1 : s);
        }
    }
    for (int t = 2; t + 1 < stride_; ++t) {
        if (uses(1, t) && !uses(0, t + 1)) {
            next_event_sampling_.environments = EnvironmentSampling::plain;
        }
    }
}

}  // namespace bdpt
