#pragma once

#include <bdpt/error.h>
#include <bdpt/image.h>
#include <bdpt/io/denoise.h>
#include <bdpt/io/write_image.h>
#include <bdpt/part/render_result.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "options/groups/display_arguments.h"
#include "options/part_arguments.h"

namespace bdpt::job {

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

/// Returns all requested layers.
[[nodiscard]] std::vector<Layer> develop_layers(const RenderResult& part);

/// Completes `metadata` for an image of `samples` per pixel that took that time [s].
[[nodiscard]] io::ImageMetadata completed(io::ImageMetadata metadata, std::int64_t samples,
                                          double seconds);

/// Returns the options for files of the image of `part`, with all its layers.
[[nodiscard]] ImageFileOptions image_file_options(const RenderResult& part,
                                                  io::ImageMetadata metadata, const ExrFormat& exr,
                                                  const DisplayArguments& display,
                                                  const io::Denoiser* denoiser,
                                                  const DenoiseArguments& denoise);

/// Writes all `outputs`, each by its extension. With a denoiser, files for screens are denoised
/// and, if that was asked for, EXR files have both images; automatic denoising needs layers that
/// guide it. A file for screens with a backdrop needs the layer with alpha. Failures are collected
/// in `attempts`, but those of automatic denoising leave the image noisy.
WrittenImages write_image_files(std::span<const std::filesystem::path> outputs,
                                const Image& rendered, ImageFileOptions options,
                                Attempts& attempts);

/// Returns the pixels of the PNG file that `write_image_files` would write.
[[nodiscard]] TexelImage screen_image(const Image& rendered, const ImageFileOptions& options);

}  // namespace bdpt::job
