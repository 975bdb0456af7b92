#pragma once

#include <bdpt/image.h>
#include <bdpt/io/exr.h>
#include <bdpt/layer.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

namespace bdpt::app {

struct ImageFileOptions {
    io::ExrOptions exr;
    std::vector<Layer> layers;      ///< of EXR files, beside the image
    std::optional<float> exposure;  ///< [EV] of PNG files; none: automatic
};

struct WrittenImages {
    std::size_t clamped_pixels = 0;  ///< in an EXR file of halves
    std::optional<float> exposure;   ///< [EV] of the PNG files, if there were any
};

/// Writes all `outputs`, each as its extension says. Throws `Error` (output).
WrittenImages write_image_files(std::span<const std::filesystem::path> outputs, const Image& image,
                                const ImageFileOptions& options);

}  // namespace bdpt::app
