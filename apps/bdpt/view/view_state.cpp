#include "view/view_state.h"

#include <bdpt/options/integrators.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "report/values.h"

namespace bdpt::app {
namespace {

using nlohmann::ordered_json;

ordered_json describe(const SlotState& slot)
{
    return {{"integrator", slot.integrator},
            {"samples", slot.samples},
            {"target", slot.target},
            {"noise", std::isfinite(slot.noise) ? ordered_json(slot.noise) : ordered_json()},
            {"seconds", slot.seconds},
            {"done", slot.is_done}};
}

ordered_json describe(const Scale& scale)
{
    ordered_json ticks = ordered_json::array();
    for (const Tick& tick : scale.ticks) {
        ticks.push_back(ordered_json::array({tick.place, tick.text}));
    }
    return {{"label", scale.label}, {"ticks", std::move(ticks)}};
}

ordered_json describe(const Strategy& strategy)
{
    return ordered_json::array({strategy.s, strategy.t});
}

ordered_json names_of_integrators()
{
    ordered_json names = ordered_json::array();
    for (const IntegratorInfo& integrator : integrators()) {
        names.push_back(integrator.name);
    }
    return names;
}

void add_picture(ordered_json& json, const ViewState& state)
{
    json["size"] = {state.size.width, state.size.height};
    json["camera"] = {
        {"name", state.camera_name},
        {"from", to_json(state.pose.from, state.origin)},
        {"look_at", to_json(state.pose.look_at, state.origin)},
        {"fov", state.vertical_fov > 0.0 ? ordered_json(state.vertical_fov) : ordered_json()}};
    json["integrators"] = names_of_integrators();
    json["integrator_a"] = state.integrator_a;
    json["integrator_b"] =
        state.integrator_b.empty() ? ordered_json() : ordered_json(state.integrator_b);
    json["environments"] = state.environments;
    json["environment"] = state.environment;
    json["rotation"] = state.rotation;
    json["intensity"] = state.intensity;
    json["exposure"] = state.exposure;
    json["exposure_auto"] = state.automatic_exposure;
    json["exposure_is_auto"] = state.exposure_is_automatic;
    json["curve"] = state.curve;
    json["background"] =
        state.background.empty() ? ordered_json() : ordered_json(state.background);
    json["layers"] = ordered_json::array();
    for (const ViewLayer layer : state.layers) {
        json["layers"].push_back(layer_name(layer));
    }
    json["layer"] = layer_name(state.layer);
    json["scale"] = state.scale ? describe(*state.scale) : ordered_json();
    json["strategies"] = ordered_json::array();
    for (const Strategy& strategy : state.strategies) {
        json["strategies"].push_back(describe(strategy));
    }
    json["strategy"] = state.strategy ? describe(*state.strategy) : ordered_json();
    json["paused"] = state.is_paused;
    json["slots"] = ordered_json::array();
    for (const SlotState& slot : state.slots) {
        json["slots"].push_back(describe(slot));
    }
    json["warnings"] = state.warnings;
    json["command"] = state.command;
    json["final_command"] = state.final_command;
}

}  // namespace

std::string state_text(const ViewState& state)
{
    ordered_json json{
        {"loading", state.is_loading},
        {"file", state.file},
        {"title", std::filesystem::path(state.file).filename().string()},
        {"message", state.message.empty() ? ordered_json() : ordered_json(state.message)}};
    if (!state.slots.empty()) {
        add_picture(json, state);
    }
    return ordered_json{{"state", std::move(json)}}.dump(
        -1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace bdpt::app
