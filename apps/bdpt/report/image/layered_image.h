#pragma once

#include <bdpt/image.h>
#include <bdpt/io/exr.h>
#include <bdpt/io/image_metadata.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "options/groups/display_arguments.h"

namespace bdpt::app {

/// What an EXR file has that pictures are made from.
struct LayeredImage {
    Image image;                 ///< where the file has data
    io::ExrPlacement placement;  ///< where in the whole that is
    std::vector<Layer> layers;   ///< alpha, shadow, albedo and normal, as far as there are any
    bool is_denoised = false;    ///< or else it is as it was rendered
    std::optional<Backdrop> backdrop{};  ///< none: the environment is seen
    io::ImageMetadata metadata;
    std::vector<std::string> warnings;  ///< one line each, without the file's name
};

/// Which of two images a file may have.
enum class Wanted : std::uint8_t {
    main,   ///< that of viewers
    clean,  ///< the denoised one, if there is one
};

/// Reads an EXR file of ours, or of another program: one with alpha has a transparent backdrop
/// then. Throws `Error`.
[[nodiscard]] LayeredImage read_layered_image(const std::filesystem::path& file, Wanted wanted);

}  // namespace bdpt::app
