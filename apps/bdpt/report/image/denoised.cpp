#include "report/image/denoised.h"

#include <bdpt/error.h>

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

#include "report/image/visible_values.h"

namespace bdpt::app {
namespace {

const Layer* find(std::span<const Layer> layers, std::string_view name)
{
    const auto found = std::find_if(layers.begin(), layers.end(),
                                    [name](const Layer& layer) { return layer.name == name; });
    return found != layers.end() ? &*found : nullptr;
}

}  // namespace

std::optional<io::Denoiser> open_denoiser(const DenoiseArguments& asked,
                                          std::span<const std::filesystem::path> outputs,
                                          int threads)
{
    if (!needs_denoiser(asked, outputs)) {
        return std::nullopt;
    }
    try {
        return io::Denoiser(asked.library, threads);
    } catch (const Error&) {
        if (asked.kind == Denoising::automatic && !asked.library) {
            return std::nullopt;
        }
        throw;
    }
}

bool has_guides(std::span<const Layer> layers)
{
    return find(layers, "albedo") != nullptr && find(layers, "normal") != nullptr;
}

Image denoised(const io::Denoiser& denoiser, const Image& image, std::span<const Layer> layers)
{
    const Layer* albedo = find(layers, "albedo");
    return denoiser.denoise({.image = image,
                             .albedo = albedo,
                             .normal = albedo != nullptr ? find(layers, "normal") : nullptr});
}

Image denoised(const io::Denoiser& denoiser, const Image& image, std::span<const Layer> layers,
               const Coverage& coverage)
{
    std::vector<Layer> helpers;
    for (const char* name : {"albedo", "normal"}) {
        if (const Layer* layer = find(layers, name)) {
            helpers.push_back(visible_values(*layer, coverage.noisy));
        }
    }
    const Image colors = to_image(visible_values(to_layer(image, ""), coverage.noisy));
    Image result = denoised(denoiser, colors, helpers);
    for (std::size_t i = 0; i < result.pixels.size(); ++i) {
        // Light paths may contribute to pixels whose camera rays found nothing.
        const float clean = coverage.clean[i];
        result.pixels[i] = clean > 0.0f ? clean * result.pixels[i] : image.pixels[i];
    }
    return result;
}

Layer to_layer(const Image& image, const char* name)
{
    Layer layer{.name = name,
                .channels = "RGB",
                .width = image.width,
                .height = image.height,
                .values = {}};
    layer.values.reserve(3 * image.pixels.size());
    for (const Rgb& pixel : image.pixels) {
        layer.values.insert(layer.values.end(), {pixel.r, pixel.g, pixel.b});
    }
    return layer;
}

Image to_image(const Layer& layer)
{
    Image image{layer.width, layer.height, {}};
    image.pixels.reserve(layer.values.size() / 3);
    for (std::size_t i = 0; i + 2 < layer.values.size(); i += 3) {
        image.pixels.emplace_back(layer.values[i], layer.values[i + 1], layer.values[i + 2]);
    }
    return image;
}

}  // namespace bdpt::app
