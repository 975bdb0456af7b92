#pragma once

#include <bdpt/io/volume.h>

#include <filesystem>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace bdpt::app {

/// What words say about a volume, as they were given.
struct VolumeWords {
    std::optional<std::string> file;
    std::optional<std::string> grid;
    std::optional<std::string> extinction;  // [1/m]
    std::optional<std::string> albedo;
    std::optional<double> anisotropy;
    std::optional<std::string> up;
};

/// The same, understood and checked.
struct VolumeChoice {
    std::filesystem::path file;
    io::VolumeOptions options{};  ///< without limits
};

/// Describes --volume and the options that start with its name to the parser.
void add_volume_options(CLI::App& command, VolumeWords& words, const char* group);

/// Nothing if no volume is asked for. Throws `OptionError`.
[[nodiscard]] std::optional<VolumeChoice> understand(const VolumeWords& words);

}  // namespace bdpt::app
