#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace bdpt::app {

/// What words say about denoising, as they were given.
struct DenoiseWords {
    std::string denoise;  // "" not at all, "true", "image" or "layer"
    std::optional<std::string> library;
};

/// Which of the two is the image of .exr files; the other one is a layer.
enum class DenoisedAs : std::uint8_t { image, layer };

/// The same, understood and checked.
struct DenoiseArguments {
    DenoisedAs as = DenoisedAs::image;
    std::optional<std::filesystem::path> library{};  ///< none: where the system finds it
};

/// Describes --denoise and --denoiser-library to the parser.
void add_denoise_options(CLI::App& command, DenoiseWords& words, const char* group);

/// None without --denoise. Throws `OptionError`.
[[nodiscard]] std::optional<DenoiseArguments> understand(const DenoiseWords& words);

}  // namespace bdpt::app
