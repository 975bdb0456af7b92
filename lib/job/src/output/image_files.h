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

#include "options/groups/image_arguments.h"
#include "options/render_arguments.h"

namespace bdpt::job {

/// Returns the values of partially visible content: `layer` divided by `shares`, one in [0, 1] per
/// pixel, by which its values are premultiplied. Pixels that show nothing get the mean of the
/// smallest block of pixels around that shows something, by a pyramid as in [Gortler et al. 1996,
/// "The Lumigraph", 3.4], so that a filter finds no edge there.
[[nodiscard]] Layer visible_values(const Layer& layer, std::span<const float> shares);

/// Opens the denoiser, if there are images for it. Throws as its constructor does, but returns none
/// if nobody asked for it and it is not found.
[[nodiscard]] std::optional<io::Denoiser> open_denoiser(
    const DenoiseArguments& asked, std::span<const std::filesystem::path> outputs, int threads);

/// Tests whether the layers that guide the denoiser are among `layers`.
[[nodiscard]] bool has_guides(std::span<const Layer> layers);

/// Returns `image` denoised, guided by albedo and normal if they are among the layers.
[[nodiscard]] Image denoised(const io::Denoiser& denoiser, const Image& image,
                             std::span<const Layer> layers,
                             const io::DenoiserControl& control = {});

/// Fraction of each pixel that surfaces cover: by the samples of the image, and without the noise
/// of surfaces that blend.
struct Coverage {
    std::vector<float> noisy;
    std::vector<float> clean;
};

/// Returns `image`, which is black where surfaces do not cover it, denoised. The denoiser gets
/// colours of surfaces, so edges are preserved.
[[nodiscard]] Image denoised(const io::Denoiser& denoiser, const Image& image,
                             std::span<const Layer> layers, const Coverage& coverage,
                             const io::DenoiserControl& control = {});

/// Returns the values of an image as a layer of that name.
[[nodiscard]] Layer to_layer(const Image& image, const char* name);

/// Returns a layer of three channels as an image.
[[nodiscard]] Image to_image(const Layer& layer);

/// Opacity of the pixels of an image towards its background, each in [0, 1]; empty if there is no
/// such layer.
struct Matte {
    std::vector<float> alpha{};
    std::vector<float> shadow{};  ///< part of alpha that is a shadow on the ground
};

[[nodiscard]] Matte find_matte(std::span<const Layer> layers);

/// Returns the fraction of each pixel that surfaces cover: alpha without the shadow.
[[nodiscard]] std::vector<float> compute_coverage(const Matte& matte);

/// Returns the fraction of each pixel that surfaces cover by the layer `opacity`, if there is one,
/// which has no noise where surfaces blend.
[[nodiscard]] std::vector<float> clean_coverage(const Matte& noisy, std::span<const Layer> layers);

/// Returns `noisy` with clean coverage, and with its shadow denoised: the shadow's opacity where
/// the ground is visible. The layers belong to the same image.
[[nodiscard]] Matte denoised(const io::Denoiser& denoiser, const Matte& noisy,
                             std::span<const Layer> layers,
                             const io::DenoiserControl& control = {});

/// Returns `image`, which shows the environment, with the black `shadow` of the ground over it, by
/// the opacity of each pixel; an empty shadow changes nothing.
[[nodiscard]] Image with_shadow(Image image, std::span<const float> shadow);

/// Stores `matte` in the layers, and adds the values of `other`, "noisy" or "denoised", as layers
/// like "noisyAlpha" and "noisyShadow" where both may differ: the shadow if there is one, alpha if
/// there is a layer `opacity`.
void put(const Matte& matte, const Matte& other, const std::string& name_of_other,
         std::vector<Layer>& layers);

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

/// Returns the photograph that is shown behind `image` where it covers nothing, if any; `frame`:
/// position of `image` in the frame, none: it is the whole. Throws `Error` if the file cannot be
/// read.
[[nodiscard]] std::optional<Image> backplate(const DisplayArguments& display, const Image& image,
                                             const std::optional<io::ExrPlacement>& frame);

/// Throws `Error`, before anything is rendered, if the file of a photograph cannot be read.
void check_backplate(const DisplayArguments& display);

/// The photograph that the metadata of `image` name: where the name leads, else beside the image.
[[nodiscard]] std::filesystem::path find_photo(const std::filesystem::path& named,
                                               const std::filesystem::path& image);

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
    std::vector<Layer> layers;               ///< layers of EXR files, and of `screen_aovs`
    std::vector<Aov> screen_aovs{};          ///< layers for files for screens: EXR files lack them
    DisplayArguments display;                ///< options of files for screens
    const io::Denoiser* denoiser = nullptr;  ///< null: images are not denoised
    Denoising denoising = Denoising::image;
    io::DenoiserControl denoise_control{};
};

/// What the denoiser makes of an image.
struct Cleaned {
    std::optional<Image> image{};  ///< none: it is not denoised
    Matte matte{};
    std::string failure{};  ///< message of automatic denoising that failed
};

/// Denoises `image`, as files have it, with the matte `noisy`, if the options say so. Throws
/// `Error`.
[[nodiscard]] Cleaned cleaned(const Image& image, const Matte& noisy,
                              const ImageFileOptions& options);

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
/// guide it. A shadow on the ground that is for screens alone darkens no other file. A file for
/// screens with a backdrop needs the layer with alpha. Failures are collected
/// in `attempts`, but those of automatic denoising leave the image noisy.
WrittenImages write_image_files(std::span<const std::filesystem::path> outputs,
                                const Image& rendered, ImageFileOptions options,
                                Attempts& attempts);

/// Returns the pixels of the PNG file that `write_image_files` would write.
[[nodiscard]] TexelImage screen_image(const Image& rendered, const ImageFileOptions& options);

}  // namespace bdpt::job
