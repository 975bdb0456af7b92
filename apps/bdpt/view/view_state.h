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
