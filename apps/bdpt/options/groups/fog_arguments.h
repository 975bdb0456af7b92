#pragma once

#include <bdpt/medium_desc.h>

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace bdpt::app {

/// What words say about fog, as they were given.
struct FogWords {
    std::optional<std::string> extinction;  // [1/m]
    std::optional<std::string> albedo;
    std::optional<double> anisotropy;
};

/// Describes --fog, --fog-albedo and --fog-anisotropy to the parser.
void add_fog_options(CLI::App& command, FogWords& words, const char* group);

/// Nothing if no fog is asked for. Throws `OptionError`.
[[nodiscard]] std::optional<MediumDesc> understand(const FogWords& words);

}  // namespace bdpt::app
