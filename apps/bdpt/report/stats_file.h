#pragma once

#include <bdpt/render.h>

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace bdpt::app {

/// Where the time of a run went [s].
struct TimeSplit {
    double load = 0.0;    ///< reading files
    double build = 0.0;   ///< the scene ready for rays
    double choose = 0.0;  ///< the pilot of --integrator auto
    double render = 0.0;
    double write = 0.0;  ///< images
};

/// Where the time of samples went: `seconds` of threads, and the share of each phase.
[[nodiscard]] nlohmann::ordered_json profile_json(const TimeProfile& profile);
/// The same in a line for people.
[[nodiscard]] std::string profile_text(const TimeProfile& profile);

/// noise_of() a film; null when it is unknown.
[[nodiscard]] nlohmann::ordered_json noise_json(double noise);

/// The numbers of a render, for programs.
[[nodiscard]] nlohmann::ordered_json stats_json(const RenderResult& result, const TimeSplit& time);

/// Writes `stats` atomically. Throws `Error` (output).
void write_stats_file(const std::filesystem::path& file, const nlohmann::ordered_json& stats);

}  // namespace bdpt::app
