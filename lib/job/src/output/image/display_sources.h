#pragma once

#include <bdpt/image.h>
#include <bdpt/io/write_image.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "options/groups/display_arguments.h"

namespace bdpt::job {

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

/// Fits `image` to a full frame: scales it uniformly until it covers the frame, crops two sides if
/// its proportions differ, and returns the part that lies behind the frame's region from x and y.
/// Filtered in linear light; an image of the frame's size is unchanged. Values are limited to [0,
/// 1], what a screen shows.
[[nodiscard]] Image behind_frame(const Image& image, const io::ExrPlacement& frame, int width,
                                 int height);

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

}  // namespace bdpt::job
