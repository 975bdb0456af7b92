#include <bdpt/render.h>

#include "pilot/pilot.h"
#include "render/check_options.h"
#include "render/view.h"
#include "threads/threads.h"

#include <bdpt/tools/intrinsics.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

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

/// The image that a render shows: the crop, if there is one, as an image of its own.
struct ShownImage {
    CameraDesc camera;
    RenderOptions options;  ///< without crop and rates
    double share = 1.0;     ///< of the pixels of the whole image

    ShownImage(const CameraDesc& whole, const RenderOptions& asked) : camera(whole), options(asked)
    {
        options.film.crop.reset();
        options.sampling.rates.reset();
        if (!asked.film.crop) {
            return;
        }
        const PixelRect& crop = *asked.film.crop;
        FilmOptions& film = options.film;
        Intrinsics values = intrinsics(camera, film.width, film.height);
        values.cx -= crop.x0;
        values.cy -= crop.y0;
        camera.vertical_extent *=
            static_cast<float>(crop.height()) / static_cast<float>(film.height);
        share = static_cast<double>(crop.width()) / film.width * crop.height() / film.height;
        film.width = crop.width();
        film.height = crop.height();
        set_intrinsics(camera, values, film.width, film.height);
    }
};

/// Returns rates of the whole image that has these in its crop.
std::shared_ptr<const SampleRates> rates_of_whole(std::shared_ptr<const SampleRates> rates,
                                                  const FilmOptions& film)
{
    if (!rates || !film.crop) {
        return rates;
    }
    std::vector<std::int8_t> exponents(static_cast<std::size_t>(film.width) *
                                       static_cast<std::size_t>(film.height));
    for (int y = film.crop->y0; y < film.crop->y1; ++y) {
        for (int x = film.crop->x0; x < film.crop->x1; ++x) {
            exponents[static_cast<std::size_t>(y) * static_cast<std::size_t>(film.width) +
                      static_cast<std::size_t>(x)] =
                static_cast<std::int8_t>(rates->exponent(x - film.crop->x0, y - film.crop->y0));
        }
    }
    return std::make_shared<const SampleRates>(film.width, film.height, std::move(exponents));
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
    const ShownImage shown(camera, options);
    const auto taking = [&](const Candidate& candidate) {
        RenderOptions taken = with_candidate(options, candidate);
        if (taken.integrator == IntegratorKind::bdpt) {
            // As many light paths, and points on lights that are connected to the lens, as an image
            // of the crop alone has.
            taken.bidirectional.light_paths *= shown.share;
            taken.bidirectional.visible_light_samples *= shown.share;
        }
        return taken;
    };
    if (!is_worth_measuring(shown.options)) {
        return {.options = taking(unmeasured(scene))};
    }
    const MovingCamera opened = open_camera(scene.world(), shown.camera, shown.options);
    const auto learned = learned_light(scene.world(), camera, options, abandon);
    Threads threads(options.system.threads);
    IntegratorChoice choice;
    threads.execute([&] {
        const PilotMeasurements pilot =
            measure(scene.world(), opened, shown.options, learned.get(), abandon);
        const std::size_t best = choose(pilot);
        choice = {.options = taking(candidates[best]), .unseen_light = pilot.merging_alone};
        if (!abandon.stop_requested() && !options.sampling.rates) {
            choice.rates = rates_of_whole(choose_rates(pilot, best), options.film);
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
