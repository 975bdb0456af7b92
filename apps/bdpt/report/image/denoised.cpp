#include "report/image/denoised.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace bdpt::app {
namespace {

const Layer* find(std::span<const Layer> layers, std::string_view name)
{
    const auto found = std::find_if(layers.begin(), layers.end(),
                                    [name](const Layer& layer) { return layer.name == name; });
    return found != layers.end() ? &*found : nullptr;
}

}  // namespace

std::optional<io::Denoiser> open_denoiser(const std::optional<DenoiseArguments>& asked,
                                          std::span<const std::filesystem::path> outputs,
                                          int threads)
{
    if (!asked || outputs.empty()) {
        return std::nullopt;
    }
    return io::Denoiser(asked->library, threads);
}

Image denoised(const io::Denoiser& denoiser, const Image& image, std::span<const Layer> layers)
{
    const Layer* albedo = find(layers, "albedo");
    return denoiser.denoise({.image = image,
                             .albedo = albedo,
                             .normal = albedo != nullptr ? find(layers, "normal") : nullptr});
}

Layer layer_of(const Image& image, const char* name)
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

}  // namespace bdpt::app
