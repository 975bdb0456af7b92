#include <bdpt/render.h>

#include "pilot/choice.h"
#include "render/check_options.h"
#include "render/learned_light.h"
#include "render/open_camera.h"
#include "threads/threads.h"

#include <cstddef>
#include <limits>

namespace bdpt {
namespace {

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
        return {.options = with_candidate(options, candidates.front())};
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
