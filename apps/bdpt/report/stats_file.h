#pragma once

#include <bdpt/render.h>

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace bdpt::app {

/// Time of a run by phase [s].
struct TimeSplit {
    double load = 0.0;    ///< reading files
    double build = 0.0;   ///< acceleration structures and other preparation of the scene
    double choose = 0.0;  ///< the pilot of --integrator auto
    double render = 0.0;
    double write = 0.0;  ///< writing images
};

/// Returns estimate_noise() of a film; null if it is unknown.
[[nodiscard]] nlohmann::ordered_json noise_json(double noise);

/// Returns the statistics of a render, for programs.
[[nodiscard]] nlohmann::ordered_json stats_json(const RenderResult& result, const TimeSplit& time);

/// Writes `stats` atomically. Throws `Error` (output).
void write_stats_file(const std::filesystem::path& file, const nlohmann::ordered_json& stats);

}  // namespace bdpt::app
