#pragma once

#include <bdpt/error.h>
#include <bdpt/film/aov_film.h>
#include <bdpt/film/id_film.h>
#include <bdpt/image.h>
#include <bdpt/io/denoise.h>
#include <bdpt/io/exr.h>
#include <bdpt/io/image_metadata.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "options/groups/display_arguments.h"

namespace bdpt::app {

/// Steps that are all attempted even if some of them fail, so that an image is not lost because
/// another file cannot be written.
class Attempts {
public:
    /// Calls `work()`; returns false if it threw an `Error`.
    template <typename Work>
    bool run(const Work& work)
    {
        try {
            work();
            return true;
        } catch (const Error& error) {
            errors_.push_back(error);
            return false;
        }
    }
    /// Throws one `Error` for all failures, if any, with the code of the first.
    void finish() const;

private:
    std::vector<Error> errors_;
};

/// Returns the exposure [EV] of an image whose `metadata` tell how it was rendered; if none is
/// requested, it is by light with a background and for frames, else automatic. Without metered
/// light an exposure by light falls back to automatic.
[[nodiscard]] float shown_exposure(const std::optional<Exposure>& asked,
                                   const io::ImageMetadata& metadata, const Image& image);

/// Throws `Error` (invalid_input) if the exposure is to be by light, and `what` was rendered
/// without metering it.
void check_metered(const std::optional<Exposure>& asked, const io::ImageMetadata& metadata,
                   const std::string& what);

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
