#pragma once

#include <optional>

namespace CLI {
class App;
}

namespace bdpt::app {

/// What words say about the environment of a scene, wherever it comes from, as they were given.
struct EnvironmentWords {
    std::optional<double> rotation;  // [deg]
    std::optional<double> intensity;
};

/// The same, checked.
struct EnvironmentChange {
    double rotation = 0.0;   ///< [deg] about +y, counter-clockwise as seen from above
    float intensity = 1.0f;  ///< >= 0, times the radiance

    [[nodiscard]] bool operator==(const EnvironmentChange&) const = default;
};

/// Describes --env-rotation and --env-intensity to the parser.
void add_environment_options(CLI::App& command, EnvironmentWords& words, const char* group);

/// Throws `OptionError`.
[[nodiscard]] EnvironmentChange understand(const EnvironmentWords& words);

}  // namespace bdpt::app
