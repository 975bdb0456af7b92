#include "render/view.h"

#include "identity/scene_identity.h"
#include "pilot/light_pilot.h"
#include "scene/world.h"
#include "threads/threads.h"

#include <bdpt/options/option_fields.h>
#include <bdpt/options/option_text.h>

#include <memory>
#include <optional>
#include <string>
#include <type_traits>
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

void add_options(std::vector<IdentityComponent>& result, const RenderOptions& options)
{
    for_each_option(options, [&result](const auto& option, const auto& value) {
        using T = std::remove_cvref_t<decltype(value)>;
        if (option.info.role != OptionRole::image) {
            return;
        }
        const std::string name = "option: " + std::string(option.name);
        if constexpr (std::is_same_v<T, std::shared_ptr<const SampleRates>>) {
            if (value) {
                result.push_back({.name = name, .value = hash_text(value->exponents())});
            }
        } else {
            result.push_back({.name = name, .value = option_text(value)});
        }
    });
}

void add_camera(std::vector<IdentityComponent>& result, const CameraDesc& camera)
{
    for_each_field(camera, [&result](const auto& field, const auto& value) {
        using T = std::remove_cvref_t<decltype(value)>;
        const std::string name = "camera: " + std::string(field.name);
        if constexpr (std::is_same_v<T, std::string> || std::is_same_v<T, std::optional<float>>) {
            return;  // its name, and the shape of image that its author had in mind
        } else if constexpr (std::is_arithmetic_v<T>) {
            result.push_back({.name = name, .value = option_text(value)});
        } else {
            result.push_back({.name = name, .value = hash_text(value)});
        }
    });
}

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
