#pragma once

#include <bdpt/inspect.h>
#include <bdpt/render_options.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "view/view_camera.h"

namespace bdpt::app {

/// What a picture shows.
enum class ViewLayer : std::uint8_t { picture, noise, rates, strategy };

[[nodiscard]] std::string_view layer_name(ViewLayer layer);

/// Settings that a page asks for; those that are there.
struct ViewSettings {
    std::optional<std::string> integrator_a{};
    std::optional<std::string> integrator_b{};  ///< "": no second one
    std::optional<std::string> environment{};   ///< as --env, or "scene": its own
    std::optional<double> rotation{};           ///< [deg]
    std::optional<double> intensity{};
    std::optional<std::string> exposure{};  ///< EV, or "auto"
    std::optional<std::string> curve{};
    std::optional<bool> paused{};
    std::optional<ViewLayer> layer{};
    std::optional<Strategy> strategy{};
};

/// What a page asks of the session.
struct PageRequest {
    std::uint32_t sequence = 0;  ///< by which its answer names it
    std::optional<Move> move{};
    std::optional<std::array<int, 2>> focus{};  ///< pixel
    bool reset = false;                         ///< the camera
    std::optional<ViewSettings> settings{};
    std::optional<PixelSample> inspect{};

    /// Does it change what is seen, so that there is no use in going on with the old picture?
    [[nodiscard]] bool changes_picture() const;
};

/// What the message `text` asks for. Throws `Error` (usage), one line, for what is no request.
[[nodiscard]] PageRequest parse_request(std::string_view text);

/// By which the answer to `text` names it, whatever else is wrong with it; none: it has no number.
[[nodiscard]] std::optional<std::uint32_t> sequence_of(std::string_view text);

}  // namespace bdpt::app
