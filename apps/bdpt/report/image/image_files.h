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
#include <string>
#include <vector>

#include "options/groups/denoise_arguments.h"
#include "options/groups/display_arguments.h"
#include "report/image/attempts.h"

namespace bdpt::app {

struct ImageFileOptions {
    io::ExrOptions exr;
    std::vector<Layer> layers;  ///< layers of EXR files, beside the image, and `guides`
    std::vector<Aov> guides{};  ///< layers that only guide the denoiser: EXR files lack them
    DisplayArguments display;   ///< options of files for screens
    const io::Denoiser* denoiser = nullptr;  ///< null: images are not denoised
    Denoising denoising = Denoising::image;
};

struct WrittenImages {
    std::size_t clamped_pixels = 0;                 ///< in an EXR file of halves
    std::optional<float> exposure;                  ///< exposure of files for screens [EV], if any
    std::vector<std::filesystem::path> files;       ///< files that were written
    std::vector<std::filesystem::path> denoised{};  ///< those whose image is denoised
    std::string why_noisy{};  ///< message of a denoiser that failed without being asked for
};

/// Returns all requested layers; `film` is of the same samples.
[[nodiscard]] std::vector<Layer> develop_layers(const Film& film, const AovFilm& aovs,
                                                const IdFilm& ids);

/// Writes all `outputs`, each by its extension. With a denoiser, files for screens are denoised
/// and, if that was asked for, EXR files have both images; automatic denoising needs layers that
/// guide it. A file for screens with a backdrop needs the layer with alpha. Failures are collected
/// in `attempts`, but those of automatic denoising leave the image noisy.
WrittenImages write_image_files(std::span<const std::filesystem::path> outputs,
                                const Image& rendered, ImageFileOptions options,
                                Attempts& attempts);

/// Returns the pixels of the PNG file that `write_image_files` would write.
[[nodiscard]] TexelImage screen_image(const Image& rendered, const ImageFileOptions& options);

}  // namespace bdpt::app
