#pragma once

#include <bdpt/film/aov_film.h>
#include <bdpt/film/id_film.h>
#include <bdpt/image.h>
#include <bdpt/io/denoise.h>
#include <bdpt/io/exr.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "options/groups/denoise_arguments.h"
#include "options/groups/display_arguments.h"
#include "report/image/attempts.h"

namespace bdpt::app {

struct ImageFileOptions {
    io::ExrOptions exr;
    std::vector<Layer> layers;               ///< layers of EXR files, beside the image
    DisplayArguments display;                ///< options of files for screens
    const io::Denoiser* denoiser = nullptr;  ///< null: images are not denoised
    DenoisedAs denoised_as = DenoisedAs::image;
};

struct WrittenImages {
    std::size_t clamped_pixels = 0;            ///< in an EXR file of halves
    std::optional<float> exposure;             ///< exposure of files for screens [EV], if any
    std::vector<std::filesystem::path> files;  ///< files that were written
};

/// Returns all requested layers; `film` is of the same samples.
[[nodiscard]] std::vector<Layer> develop_layers(const Film& film, const AovFilm& aovs,
                                                const IdFilm& ids);

/// Writes all `outputs`, each by its extension; with a denoiser, files for screens are denoised,
/// and EXR files have both images. A file for screens with a backdrop needs the layer with alpha.
/// Failures are collected in `attempts`.
WrittenImages write_image_files(std::span<const std::filesystem::path> outputs, const Image& image,
                                ImageFileOptions options, Attempts& attempts);

/// Returns the pixels of the PNG file that `write_image_files` would write.
[[nodiscard]] TexelImage screen_image(const Image& image, const ImageFileOptions& options);

}  // namespace bdpt::app
