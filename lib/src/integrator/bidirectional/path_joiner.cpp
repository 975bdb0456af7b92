#include "integrator/bidirectional/path_joiner.h"

#include "math/random_numbers.h"
#include "path/connect.h"

#include <algorithm>

namespace bdpt {

bool PathJoiner::is_background(const SampleContext& sample, const PathVertex& x0) const
{
    return options_.transport.background == Background::none && x0.kind == VertexKind::infinite &&
           x0.light == sample.world.lights().environment();
}

void PathJoiner::join_camera_path(SampleContext& sample, Subpath& path)
{
    weigher_.begin_camera_path(path.all());
    for (int t = 2; t <= path.size(); ++t) {
        const auto camera = path.first(t);
        if (strategies_.uses(0, t) && !(t == 2 && is_background(sample, camera.back()))) {
            if (const auto found = hit_light(sample, camera, weigher_)) {
                sink_.add(sample, {.s = 0, .t = t}, *found, strategies_.count(0, t));
            }
        }
        if (t <= options_.transport.max_depth && strategies_.uses(1, t)) {
            join_to_lights(sample, camera);
        }
    }
    if (sample.camera.is_perspective() &&
        connects_light_to_lens(sample.sampler, sink_.x(), sink_.y())) {
        if (const auto found = connect_light_to_lens(sample, weigher_)) {
            sink_.splat(sample, {.s = 1, .t = 1}, *found, strategies_.count(1, 1), 1);
        }
    }
}

bool PathJoiner::connects_light_to_lens(const Sampler& sampler, int x, int y) const
{
    const float chance = light_to_lens_pixels_.chance();
    return chance == 1.0f ||
           (chance > 0.0f && light_to_lens_pixels_.contains(x, y) &&
            sampler.ordered_1d(SampleUse::next_event, Sampler::choice_of_visible_light) < chance);
}

void PathJoiner::join_to_lights(SampleContext& sample, std::span<const PathVertex> camera)
{
    if (!scatters(camera.back().kind) || !camera.back().connectible) {
        return;
    }
    const auto t = static_cast<int>(camera.size());
    const auto count = static_cast<std::uint32_t>(strategies_.next_event_sampling().samples);
    const Vec2 first = first_light_sample(sample, t);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec2 u = i == 0 ? first : shifted_point(first, i, count);
        if (const auto found = connect_to_light(sample, camera, u, weigher_)) {
            sink_.add(sample, {.s = 1, .t = t}, *found, strategies_.count(1, t));
        }
    }
}

void PathJoiner::join_light_path(SampleContext& sample, Subpath& path)
{
    weigher_.begin_light_path(path.all());
    const auto deliver = [&](const std::optional<Contribution>& found, Strategy strategy) {
        if (found) {
            sink_.splat(sample, strategy, *found, strategies_.count(strategy.s, strategy.t),
                        static_cast<std::uint32_t>(2 * strategy.s + (strategy.t == 0 ? 1 : 0)));
        }
    };
    const int max_s = std::min(path.size(), options_.transport.max_depth);
    for (int s = 2; s <= max_s; ++s) {
        if (strategies_.uses(s, 1)) {
            deliver(connect_to_lens(sample, path.first(s), weigher_), {.s = s, .t = 1});
        }
    }
    for (const LensCrossing& crossing : path.crossings()) {
        const int s = crossing.light_vertices + 1;
        if (s <= options_.transport.max_depth + 1 && strategies_.uses(s, 0) &&
            !(s == 2 && is_background(sample, path[0]))) {
            deliver(hit_lens(sample, path, crossing, weigher_), {.s = s, .t = 0});
        }
    }
}

void PathJoiner::join_paths(const SampleContext& sample, std::span<const PathVertex> light,
                            const Subpath& camera)
{
    for (int t = 2; t <= camera.size(); ++t) {
        const int max_s =
            std::min(static_cast<int>(light.size()), options_.transport.max_depth + 1 - t);
        for (int s = 2; s <= max_s; ++s) {
            if (!strategies_.uses(s, t)) {
                continue;
            }
            if (const auto found = connect_interior(
                    sample, light.first(static_cast<std::size_t>(s)), camera.first(t), weigher_)) {
                sink_.add(sample, {.s = s, .t = t}, *found, strategies_.count(s, t));
            }
        }
    }
}

void PathJoiner::join_chosen(const SampleContext& sample, const LightPathCache& cache,
                             const LightPathCache::Choice& choice, const Subpath& camera)
{
    const float u =
        sample.sampler.ordered_1d(SampleUse::light_walk, Sampler::choice_of_connections);
    const auto chosen = chooser_.choose(camera, cache.blocks(choice), u);
    for (const ConnectionChooser::Connection& each : chosen) {
        LightPathCache::prefetch_vertex(cache.prefix(choice, each.path_begin, each.s).back());
    }
    for (const ConnectionChooser::Connection& each : chosen) {
        __builtin_prefetch(cache.prefix(choice, each.path_begin, each.s).back().bsdf);
    }
    for (const ConnectionChooser::Connection& each : chosen) {
        if (!strategies_.uses(each.s, each.t)) {
            continue;
        }
        if (auto found = connect_interior(sample, cache.prefix(choice, each.path_begin, each.s),
                                          camera.first(each.t), weigher_)) {
            found->unweighted *= each.scale;
            found->chance = each.chance;
            sink_.begin_joins(static_cast<int>(each.path));
            sink_.add(sample, {.s = each.s, .t = each.t}, *found,
                      strategies_.count(each.s, each.t));
        }
    }
}

}  // namespace bdpt
