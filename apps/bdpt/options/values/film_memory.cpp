#include "options/values/film_memory.h"

#include <bdpt/film/exact_sum.h>
#include <bdpt/film/id_film.h>
#include <bdpt/options/integrators.h>

#include <algorithm>

namespace bdpt::app {
namespace {

constexpr std::uint64_t color_sum = 3 * sizeof(ExactSum);
constexpr std::uint64_t shadow_sums = 2 * sizeof(ExactSum) + sizeof(std::uint64_t);

/// Typical cost of a pixel's ids; each further one takes 8 bytes, and the heap's overhead.
constexpr std::uint64_t two_ids = sizeof(IdCounts) + 32;
constexpr std::uint64_t id_channels = 2 * IdFilm::levels;

/// Returns the size of the sums of a pixel in an `AovFilm` or `IdFilm` [bytes].
std::uint64_t count_sum_bytes(const AovLayer& layer)
{
    switch (layer.aov) {
        case Aov::object:
        case Aov::material:
            return two_ids;
        case Aov::alpha:
            return sizeof(std::uint64_t);
        case Aov::opacity:
            return sizeof(ExactSum);
        case Aov::shadow:
            return shadow_sums;
        default:
            return layer.mean == AovMean::none ? 0 : layer.channels.size() * sizeof(ExactSum);
    }
}

std::uint64_t count_pixels(const RenderOptions& options, const Size& size)
{
    const PixelRect region = options.film.crop.value_or(
        PixelRect{.x0 = 0, .y0 = 0, .x1 = size.width, .y1 = size.height});
    return static_cast<std::uint64_t>(region.width()) * static_cast<std::uint64_t>(region.height());
}

}  // namespace

std::uint64_t film_bytes(const RenderOptions& options, const Size& size)
{
    const bool splats = info(options.integrator).traces_light_paths;
    constexpr std::uint64_t halves = 2;
    std::uint64_t pixel = halves * (splats ? 2 : 1) * color_sum + sizeof(Rgb);
    for (const AovLayer& layer : aov_layers) {
        if (options.film.aovs.contains(layer.aov)) {
            const bool is_id = layer.aov == Aov::object || layer.aov == Aov::material;
            const std::uint64_t channels = is_id ? id_channels : layer.channels.size();
            // Developed, and once more in the channel order of a file.
            pixel += count_sum_bytes(layer) + 2 * channels * sizeof(float);
        }
    }
    return pixel * count_pixels(options, size);
}

std::uint64_t denoiser_bytes(const RenderOptions& options, const Size& size)
{
    // Measured with version 2.5.1 from 16x16 to 3840x2160; it splits large images into tiles.
    constexpr std::uint64_t program = 100'000'000;
    constexpr std::uint64_t pixel = 700;
    constexpr std::uint64_t most = 3'600'000'000;
    return std::min(program + pixel * count_pixels(options, size), most);
}

}  // namespace bdpt::app
