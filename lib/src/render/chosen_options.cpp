#include <bdpt/render.h>

#include "pilot/choice.h"
#include "render/check_options.h"
#include "render/learned_light.h"
#include "render/open_camera.h"
#include "threads/threads.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <variant>

namespace bdpt {
namespace {

/// Tests for a light that rays cannot hit.
bool has_no_size(const LightDesc& light)
{
    const auto* point = std::get_if<PointLightDesc>(&light);
    const auto* spot = std::get_if<SpotLightDesc>(&light);
    return std::holds_alternative<DirectionalLightDesc>(light) ||
           (point != nullptr && point->radius == 0.0f) || (spot != nullptr && spot->radius == 0.0f);
}

/// Tests for a surface that makes caustics.
bool is_shiny(const MaterialDesc& material)
{
    constexpr float smooth = 0.1f;
    const bool is_coated =
        material.clearcoat.factor > 0.0f && material.clearcoat.roughness < smooth;
    return is_coated || (material.roughness < smooth &&
                         (material.metallic > 0.0f || material.transmission > 0.0f));
}

/// Returns what renders take whose pilot is not worth its time: `mis`, and a few light paths where
/// it would miss the caustics of lights without a size.
Candidate unmeasured(const Scene& scene)
{
    constexpr Candidate few_splats = candidates[1];
    static_assert(few_splats.light_paths > 0.0 && few_splats.connections == 0.0);
    const auto& desc = scene.description();
    const bool may_miss_light = std::any_of(desc.lights.begin(), desc.lights.end(), has_no_size) &&
                                std::any_of(desc.materials.begin(), desc.materials.end(), is_shiny);
    return may_miss_light ? few_splats : candidates.front();
}

/// Tests for options that only bdpt supports, disabled strategies and strategy images, and for
/// heuristics that pilots do not predict: they predict balance and power alone.
bool asks_for_bdpt(const RenderOptions& options)
{
    constexpr int unlimited = std::numeric_limits<int>::max();
    const BidirectionalOptions& asked = options.bidirectional;
    const Heuristic heuristic = options.transport.heuristic;
    return !asked.disabled.empty() || asked.strategy_depth > 0 ||
           asked.max_camera_depth != unlimited || asked.max_light_depth != unlimited ||
           (heuristic != Heuristic::balance && heuristic != Heuristic::power);
}

}  // namespace

IntegratorChoice choose_integrator(const Scene& scene, const CameraDesc& camera,
                                   const RenderOptions& asked, const std::stop_token& abandon)
{
    check_options(asked);
    check_camera(camera);
    check_camera_distance(camera, scene.world().farthest_origin());
    if (asked.integrator != IntegratorKind::automatic) {
        return {.options = asked};
    }
    RenderOptions options = asked;
    options.integrator = IntegratorKind::bdpt;
    options.bidirectional.light_paths = 1.0;
    options.bidirectional.connections.reset();
    options.bidirectional.connection_rays = 0.0;
    if (asks_for_bdpt(options)) {
        return {.options = options};
    }
    RenderOptions whole = options;
    whole.film.crop.reset();
    whole.sampling.rates.reset();
    if (!is_worth_measuring(whole)) {
        return {.options = with_candidate(options, unmeasured(scene))};
    }
    const MovingCamera opened = open_camera(scene.world(), camera, whole);
    const auto learned = learned_light(scene.world(), camera, whole, abandon);
    Threads threads(options.system.threads);
    IntegratorChoice choice;
    threads.execute([&] {
        const PilotMeasurements pilot =
            measure(scene.world(), opened, whole, learned.get(), abandon);
        const std::size_t best = choose(pilot);
        choice = {.options = with_candidate(options, candidates[best]),
                  .unseen_light = pilot.merging_alone};
        if (!abandon.stop_requested() && !options.sampling.rates) {
            choice.rates = choose_rates(pilot, best);
        }
    });
    return choice;
}

RenderOptions with_rates(const IntegratorChoice& choice)
{
    RenderOptions options = choice.options;
    if (choice.rates && SampleRates::fit(options.sampling.samples)) {
        options.sampling.rates = choice.rates;
    }
    return options;
}

RenderOptions chosen_options(const Scene& scene, const CameraDesc& camera,
                             const RenderOptions& asked)
{
    return with_rates(choose_integrator(scene, camera, asked));
}

}  // namespace bdpt
