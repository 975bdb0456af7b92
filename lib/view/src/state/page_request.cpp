#include "state/view_state.h"

#include <bdpt/error.h>
#include <bdpt/options/integrators.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "output/values.h"

namespace bdpt::view {

namespace {

using Json = nlohmann::json;

/// In the order of `ViewLayer`.
constexpr std::array<std::string_view, 4> layer_names{"picture", "noise", "rates", "strategy"};

[[noreturn]] void fail(std::string_view key, std::string_view expected)
{
    throw Error(ErrorCode::usage, fmt::format("\"{}\": expected {}", key, expected));
}

double number(const Json& value, std::string_view key, double least, double most)
{
    const double number = value.is_number() ? value.get<double>() : std::nan("");
    if (!(number >= least && number <= most)) {
        fail(key, fmt::format("a number from {} to {}", least, most));
    }
    return number;
}

std::int64_t whole(const Json& value, std::string_view key, std::int64_t most)
{
    const bool is_whole = value.is_number_unsigned() &&
                          value.get<std::uint64_t>() <= static_cast<std::uint64_t>(most);
    if (!is_whole) {
        fail(key, fmt::format("a whole number from 0 to {}", most));
    }
    return value.get<std::int64_t>();
}

std::array<int, 2> pair_of_wholes(const Json& value, std::string_view key)
{
    constexpr std::int64_t most = 65535;
    if (!value.is_array() || value.size() != 2) {
        fail(key, "two whole numbers");
    }
    return {static_cast<int>(whole(value[0], key, most)),
            static_cast<int>(whole(value[1], key, most))};
}

Vec2 pair_of_numbers(const Json& value, std::string_view key)
{
    constexpr double most = 1000.0;
    if (!value.is_array() || value.size() != 2) {
        fail(key, "two numbers");
    }
    return {static_cast<float>(number(value[0], key, -most, most)),
            static_cast<float>(number(value[1], key, -most, most))};
}

/// Returns the text of a number; "" for null.
std::string number_or_none(const Json& value, std::string_view key, double least, double most)
{
    return value.is_null() ? "" : fmt::format("{}", number(value, key, least, most));
}

std::string text(const Json& value, std::string_view key)
{
    constexpr std::size_t longest = 4096;
    if (!value.is_string() || value.get_ref<const std::string&>().size() > longest) {
        fail(key, "a text");
    }
    return value.get<std::string>();
}

/// Returns a text; "" for null.
std::string text_or_none(const Json& value, std::string_view key)
{
    return value.is_null() ? "" : text(value, key);
}

bool truth(const Json& value, std::string_view key)
{
    if (!value.is_boolean()) {
        fail(key, "true or false");
    }
    return value.get<bool>();
}

Move parse_move(const Json& value)
{
    Move move;
    if (!value.is_object()) {
        fail("move", "an object");
    }
    for (const auto& [key, member] : value.items()) {
        if (key == "orbit") {
            move.orbit = pair_of_numbers(member, key);
        } else if (key == "pan") {
            move.pan = pair_of_numbers(member, key);
        } else if (key == "dolly") {
            move.dolly = static_cast<float>(number(member, key, 1e-3, 1e3));
        } else {
            fail(key, "orbit, pan or dolly");
        }
    }
    return move;
}

ViewLayer parse_layer(const Json& value)
{
    const std::string name = value.is_string() ? value.get<std::string>() : std::string();
    const auto* const found = std::find(layer_names.begin(), layer_names.end(), name);
    if (found == layer_names.end()) {
        fail("layer", "picture, noise, rates or strategy");
    }
    return static_cast<ViewLayer>(found - layer_names.begin());
}

/// Parses EV as in --exposure.
std::string parse_ev(const Json& value)
{
    if (value.is_number()) {
        return fmt::format("{}", number(value, "exposure", -100.0, 100.0));
    }
    if (value != "auto") {
        fail("exposure", "EV from -100 to 100, or auto");
    }
    return "auto";
}

ViewSettings parse_settings(const Json& value)
{
    ViewSettings settings;
    if (!value.is_object()) {
        fail("set", "an object");
    }
    for (const auto& [key, member] : value.items()) {
        const auto set = [&settings](const char* option, std::string text) {
            settings.options.emplace_back(option, std::move(text));
        };
        if (key == "integrator_a") {
            set("--integrator", text(member, key));
        } else if (key == "integrator_b") {
            settings.integrator_b = text_or_none(member, key);
        } else if (key == "camera") {
            set("--camera", text(member, key));
        } else if (key == "variant") {
            set("--variant", text_or_none(member, key));
        } else if (key == "animation") {
            set("--animation", text_or_none(member, key));
        } else if (key == "time") {
            set("--frame-time", number_or_none(member, key, -1e6, 1e6));
        } else if (key == "fov") {
            set("--fov", fmt::format("{}", number(member, key, 0.1, 179.0)));
        } else if (key == "f_stop") {
            set("--f-stop", number_or_none(member, key, 1e-6, 1e6));
        } else if (key == "background") {
            set("--background", text_or_none(member, key));
        } else if (key == "ground") {
            set("--ground", truth(member, key) ? "shadow" : "none");
        } else if (key == "environment") {
            set("--env", text(member, key));
        } else if (key == "rotation") {
            set("--env-rotation", fmt::format("{}", number(member, key, -1e6, 1e6)));
        } else if (key == "intensity") {
            set("--env-intensity", fmt::format("{}", number(member, key, 0.0, 1e6)));
        } else if (key == "exposure") {
            set("--exposure", parse_ev(member));
        } else if (key == "curve") {
            set("--tone-map", text(member, key));
        } else if (key == "paused") {
            settings.paused = truth(member, key);
        } else if (key == "denoise") {
            settings.denoises = truth(member, key);
        } else if (key == "layer") {
            settings.layer = parse_layer(member);
        } else if (key == "strategy") {
            const auto [s, t] = pair_of_wholes(member, key);
            settings.strategy = Strategy{.s = s, .t = t};
        } else {
            throw Error(ErrorCode::usage, fmt::format("\"{}\": is not a setting", key));
        }
    }
    return settings;
}

}  // namespace

std::string_view layer_name(ViewLayer layer)
{
    return layer_names.at(static_cast<std::size_t>(layer));
}

bool PageRequest::changes_picture() const
{
    const auto changes = [](const auto& option) {
        return option.first != "--exposure" && option.first != "--tone-map";
    };
    return move || focus || reset ||
           (settings && std::any_of(settings->options.begin(), settings->options.end(), changes));
}

std::optional<std::uint32_t> parse_sequence(std::string_view text)
{
    const Json value = Json::parse(text, nullptr, false);
    if (!value.is_object()) {
        return std::nullopt;
    }
    const auto found = value.find("seq");
    if (found == value.end() || !found->is_number_unsigned() ||
        found->get<std::uint64_t>() > std::numeric_limits<std::uint32_t>::max()) {
        return std::nullopt;
    }
    return found->get<std::uint32_t>();
}

PageRequest parse_request(std::string_view message)
{
    constexpr std::int64_t max_index = (std::int64_t{1} << 32) - 2;
    const Json value = Json::parse(message, nullptr, false);
    if (!value.is_object()) {
        throw Error(ErrorCode::usage, "a request must be a JSON object");
    }
    PageRequest request;
    std::int64_t sample = 0;
    for (const auto& [key, member] : value.items()) {
        if (key == "seq") {
            request.sequence = static_cast<std::uint32_t>(
                whole(member, key, std::numeric_limits<std::uint32_t>::max()));
        } else if (key == "move") {
            request.move = parse_move(member);
        } else if (key == "focus") {
            request.focus = pair_of_wholes(member, key);
        } else if (key == "turn") {
            request.turns = truth(member, key);
        } else if (key == "reset") {
            request.reset = truth(member, key);
        } else if (key == "set") {
            request.settings = parse_settings(member);
        } else if (key == "inspect") {
            const auto [x, y] = pair_of_wholes(member, key);
            request.inspect = PixelSample{.x = x, .y = y, .index = 0};
        } else if (key == "sample") {
            sample = whole(member, key, max_index);
        } else {
            throw Error(ErrorCode::usage, fmt::format("\"{}\": is not a request", key));
        }
    }
    if (request.inspect) {
        request.inspect->index = sample;
    }
    return request;
}

}  // namespace bdpt::view
