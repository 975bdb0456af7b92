#pragma once

#include <bdpt/aov.h>
#include <bdpt/image.h>
#include <bdpt/io/display.h>
#include <bdpt/options/filter_options.h>
#include <bdpt/options/option_fields.h>
#include <bdpt/pixel_rect.h>
#include <bdpt/render_options.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "options/option_list.h"
#include "options/value_types.h"

namespace bdpt::job {

/// Parses "gaussian" or "gaussian:2"; the radius [pixels] is in the range of `FilterOptions`.
[[nodiscard]] std::optional<FilterOptions> parse_filter(std::string_view text);

/// Parses "albedo,normal,depth,position,samples,variance,alpha,object,material", or some of them.
[[nodiscard]] std::optional<AovSet> parse_aovs(std::string_view text);

/// Parses "x0,y0,x1,y1", whole numbers; x0 < x1 and y0 < y1.
[[nodiscard]] std::optional<PixelRect> parse_crop(std::string_view text);

/// Kinds of ground below the scene.
enum class Ground : std::uint8_t { automatic, none, shadow };

/// Adds --ground.
void add_ground_option(OptionList& options, Ground& ground);

/// Returns `film` with the layer of the shadow on the ground, if requested. Throws `OptionError`
/// for options that are incompatible with it.
[[nodiscard]] FilmOptions with_ground(Ground ground, FilmOptions film, const OptionList& options);

/// Returns the memory of the film of a render of `size`, with its layers and the image that it is
/// developed to [bytes].
[[nodiscard]] std::uint64_t film_bytes(const RenderOptions& options, const Size& size);

/// Returns the memory that Open Image Denoise takes for a render of `size` [bytes].
[[nodiscard]] std::uint64_t denoiser_bytes(const RenderOptions& options, const Size& size);

// Options of the command that are fields of `RenderOptions`, generated from the list in
// <bdpt/options/option_fields.h>: a field with a help text there is an option here.

/// Adds the fields of a group, such as `FilmOptions`.
template <typename Group>
void add_fields(OptionList& options, Group& group);

/// Adds the fields `names`, such as "light_samples", of all groups.
void add_fields(OptionList& options, RenderOptions& render,
                std::span<const std::string_view> names);

/// Reference of an exposure.
enum class ExposureBase : std::uint8_t {
    radiance,   ///< pixel values as they are: the value is absolute
    automatic,  ///< exposure by the image's average luminance
    light,      ///< exposure that makes a white card at the scene's position white
};

/// Exposure of images for screens.
struct Exposure {
    ExposureBase base = ExposureBase::radiance;
    float value = 0.0f;  ///< relative to the base [EV]
};

/// Parses "1.5" or "+1.5", relative to radiance; "auto", "light", and either followed by a signed
/// number: "light-0.5".
[[nodiscard]] std::optional<Exposure> parse_exposure(const std::string& text);

/// Background shown instead of the environment.
struct Backdrop {
    std::optional<io::SrgbColor> color{};
    std::filesystem::path photo{};  ///< file of an image shown instead of a colour; empty: none

    [[nodiscard]] bool is_transparent() const { return !color && photo.empty(); }
};

/// Options of images for screens.
struct DisplayArguments {
    /// None: by light if there is a backdrop and for frames, else automatic.
    std::optional<Exposure> exposure{};
    io::ToneCurve curve = io::ToneCurve::filmic;
    TexelType type = TexelType::unorm8;  ///< type of .png files
    std::optional<Backdrop> backdrop{};  ///< none: the environment is shown
};

/// Parses "transparent", "black", "white", "#rrggbb", "#rgb" or sRGB-encoded "r,g,b" from 0 to 1,
/// or the name of an image: .png, .jpg, .webp, .exr or .hdr.
[[nodiscard]] std::optional<Backdrop> parse_backdrop(std::string_view text);

/// Formats a backdrop, the inverse of `parse_backdrop`; black is "#000000".
[[nodiscard]] std::string backdrop_text(const Backdrop& backdrop);

/// Throws `OptionError` if a transparent image goes to one of `outputs` that has no alpha.
void check_transparency(const DisplayArguments& display,
                        std::span<const std::filesystem::path> outputs);

/// Adds --exposure, --tone-map, --background and --png-bits.
void add_display_options(OptionList& options, DisplayArguments& display);

/// Which images are denoised. Pictures are files for screens: .png, .jpg, .webp.
enum class Denoising : std::uint8_t {
    automatic,  ///< pictures, where the denoiser and the layers that guide it are found
    none,
    image,  ///< all images; .exr files have the noisy one as a layer
    layer,  ///< pictures; .exr files have the denoised image as a layer
};

/// Options of denoising.
struct DenoiseArguments {
    Denoising kind = Denoising::automatic;
    std::optional<std::filesystem::path> library{};  ///< none: the one that `io::Denoiser` finds

    /// Tests whether the user asked for denoised images.
    [[nodiscard]] bool is_asked() const
    {
        return kind == Denoising::image || kind == Denoising::layer;
    }
};

/// Adds --denoise and --denoiser-library.
void add_denoise_options(OptionList& options, DenoiseArguments& denoise);

/// Tests whether one of `outputs` would be denoised if the denoiser is found.
[[nodiscard]] bool needs_denoiser(const DenoiseArguments& asked,
                                  std::span<const std::filesystem::path> outputs);

/// Returns the layers that guide the denoiser, with opacity if the image has a `backdrop`, except
/// those in `known`.
[[nodiscard]] std::vector<Aov> missing_guides(const AovSet& known,
                                              const std::optional<Backdrop>& backdrop);

}  // namespace bdpt::job
