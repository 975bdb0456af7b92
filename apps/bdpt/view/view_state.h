#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "options/arguments.h"
#include "view/layers.h"
#include "view/page_request.h"
#include "view/view_camera.h"

namespace bdpt::app {

/// One of the pictures side by side.
struct SlotState {
    std::string integrator;  ///< that was chosen; empty: not yet
    std::int64_t samples = 0;
    std::int64_t target = 0;
    double noise = 0.0;  ///< infinite: not known
    double seconds = 0.0;
    bool is_done = false;
};

/// All that pages are told beside pixels.
struct ViewState {
    bool is_loading = true;
    std::string file;
    std::string message;  ///< why the picture is not what it should be; empty: it is
    // The rest once something was loaded.
    Size size{};
    std::string camera_name;
    Pose pose{};
    double vertical_fov = 0.0;  ///< [deg]; 0: orthographic
    std::string integrator_a;
    std::string integrator_b;
    std::vector<std::string> environments;
    std::string environment;
    double rotation = 0.0;  ///< [deg]
    double intensity = 1.0;
    double exposure = 0.0;            ///< [EV] that is shown
    double automatic_exposure = 0.0;  ///< [EV] in the place of a number
    bool exposure_is_automatic = true;
    std::string curve;
    std::string background;  ///< "transparent" or a colour, like "#ffffff"; empty: the environment
    std::vector<ViewLayer> layers;
    ViewLayer layer = ViewLayer::picture;
    std::optional<Scale> scale{};
    std::vector<Strategy> strategies;
    std::optional<Strategy> strategy{};
    bool is_paused = false;
    std::vector<SlotState> slots;
    std::vector<std::string> warnings;
    std::string command;
};

/// As JSON.
[[nodiscard]] std::string state_text(const ViewState& state);

}  // namespace bdpt::app
