#pragma once

#include <bdpt/inspect.h>
#include <bdpt/render_options.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "options/arguments.h"
#include "view/layers.h"
#include "view/view_camera.h"

namespace bdpt::app {

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

/// State of one of the pictures side by side.
struct SlotState {
    std::string integrator;  ///< the chosen one; empty: not yet chosen
    std::int64_t samples = 0;
    std::int64_t target = 0;
    double noise = 0.0;  ///< infinite: unknown
    double seconds = 0.0;
    bool is_done = false;
};

/// State sent to pages, except pixels.
struct ViewState {
    bool is_loading = true;
    std::string file;
    std::string message;  ///< reason why the picture is not as requested; empty: it is
    // The members below are valid once something was loaded.
    Size size{};
    std::string camera_name;
    Pose pose{};
    DVec3 origin{0.0};          ///< of the world, which `pose` is in
    double vertical_fov = 0.0;  ///< [deg]; 0: orthographic
    std::string integrator_a;
    std::string integrator_b;
    std::vector<std::string> environments;
    std::string environment;
    double rotation = 0.0;  ///< [deg]
    double intensity = 1.0;
    double exposure = 0.0;            ///< shown exposure [EV]
    double automatic_exposure = 0.0;  ///< exposure [EV] used if none is set
    bool exposure_is_automatic = true;
    std::string curve;
    /// "transparent" or a colour, such as "#ffffff"; empty: the environment.
    std::string background;
    std::vector<ViewLayer> layers;
    ViewLayer layer = ViewLayer::picture;
    std::optional<Scale> scale{};
    std::vector<Strategy> strategies;
    std::optional<Strategy> strategy{};
    bool is_paused = false;
    std::vector<SlotState> slots;
    std::vector<std::string> warnings;
    std::string command;
    std::string final_command;
};

/// Returns the state as JSON.
[[nodiscard]] std::string state_text(const ViewState& state);

}  // namespace bdpt::app
