#pragma once

#include <bdpt/inspect.h>
#include <bdpt/render_options.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "state/view_camera.h"

namespace bdpt::view {

/// Contents of a picture.
enum class ViewLayer : std::uint8_t { picture, noise, rates, strategy };

[[nodiscard]] std::string_view layer_name(ViewLayer layer);

/// Settings that a page requests; only those that are set.
struct ViewSettings {
    std::optional<std::string> integrator_a{};
    std::optional<std::string> integrator_b{};  ///< "": no second one
    std::optional<std::string> environment{};   ///< as in --env, or "scene": its own
    std::optional<double> rotation{};           ///< [deg]
    std::optional<double> intensity{};
    std::optional<std::string> exposure{};  ///< EV, or "auto"
    std::optional<std::string> curve{};
    std::optional<bool> paused{};
    std::optional<ViewLayer> layer{};
    std::optional<Strategy> strategy{};
};

/// A page's request to the session.
struct PageRequest {
    std::uint32_t sequence = 0;  ///< number that its answer refers to
    std::optional<Move> move{};
    std::optional<std::array<int, 2>> focus{};  ///< pixel
    bool reset = false;                         ///< resets the camera
    std::optional<ViewSettings> settings{};
    std::optional<PixelSample> inspect{};

    /// Tests whether the request changes the view, which makes the current picture obsolete.
    [[nodiscard]] bool changes_picture() const;
};

/// Parses the message `text`. Throws `Error` (usage), one line, for an invalid request.
[[nodiscard]] PageRequest parse_request(std::string_view text);

/// Returns the number that the answer to `text` refers to, whatever else is wrong with it; none: it
/// has no number.
[[nodiscard]] std::optional<std::uint32_t> parse_sequence(std::string_view text);

}  // namespace bdpt::view
