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

/// Contents of an EXR file from which images for screens are made.
struct LayeredImage {
    Image image;                         ///< region with data
    io::ExrPlacement placement;          ///< position in the whole image
    std::vector<Layer> layers;           ///< alpha, shadow, albedo and normal, as available
    bool is_denoised = false;            ///< false: the image is as rendered
    std::optional<Backdrop> backdrop{};  ///< none: the environment is shown
    io::ImageMetadata metadata;
    std::vector<std::string> warnings;  ///< one line each, without the file's name
};

/// Selects one of two images that a file may have.
enum class Wanted : std::uint8_t {
    main,   ///< the one that viewers show
    clean,  ///< the denoised one, if there is one
};

/// Reads an EXR file of bdpt or of another program: one of another program with alpha has a
/// transparent backdrop. Throws `Error`.
[[nodiscard]] LayeredImage read_layered_image(const std::filesystem::path& file, Wanted wanted);

}  // namespace bdpt::app
