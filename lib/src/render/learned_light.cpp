#include "render/learned_light.h"

#include "pilot/light_pilot.h"
#include "render/identity_inputs.h"
#include "render/open_camera.h"
#include "scene/world.h"
#include "threads/threads.h"

#include <string>
#include <utility>

namespace bdpt {
namespace {

/// `options` without what has no part in the pilot. Whatever is not named here counts, so that an
/// option that is new cannot be forgotten.
LearnedMemo::Inputs make_inputs(const CameraDesc& camera, RenderOptions options)
{
    options.integrator = IntegratorKind::mis;
    options.film.crop.reset();
    options.film.aovs = {};
    options.sampling.seed = 0;
    options.sampling.rates.reset();
    options.bidirectional = {};
    LearnedMemo::Inputs inputs;
    add_camera(inputs, camera);
    add_options(inputs, options);
    inputs.push_back({.name = "camera paths", .value = std::to_string(light_pilot_side(options))});
    return inputs;
}

}  // namespace

std::shared_ptr<const LearnedLight> learned_light(const World& world, const CameraDesc& camera,
                                                  const RenderOptions& options,
                                                  const std::stop_token& abandon)
{
    RenderOptions whole = options;
    whole.film.crop.reset();
    if (!can_learn_light(world, whole)) {
        return nullptr;
    }
    LearnedMemo::Inputs inputs = make_inputs(camera, whole);
    if (auto found = world.learned().find(inputs)) {
        return *std::move(found);
    }
    const MovingCamera opened = open_camera(world, camera, whole);
    Threads threads(options.system.threads);
    std::shared_ptr<const LearnedLight> learned;
    threads.execute([&] { learned = learn_light(world, opened, whole, abandon); });
    if (!abandon.stop_requested()) {
        world.learned().keep(std::move(inputs), learned);
    }
    return learned;
}

}  // namespace bdpt
