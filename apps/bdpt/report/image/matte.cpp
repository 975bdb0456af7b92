#include "report/image/matte.h"

#include <bdpt/image.h>

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

#include "report/image/visible_values.h"

namespace bdpt::app {
namespace {

/// The layer of that name with alpha alone.
template <typename Layers>
auto* find(Layers& layers, std::string_view name)
{
    const auto found = std::find_if(layers.begin(), layers.end(), [name](const Layer& layer) {
        return layer.name == name && layer.channels == "A";
    });
    return found != layers.end() ? &*found : nullptr;
}

constexpr std::string_view main_layer;
constexpr std::string_view shadow_layer = "shadow";

}  // namespace

Matte matte_of(std::span<const Layer> layers)
{
    const Layer* alpha = find(layers, main_layer);
    const Layer* shadow = find(layers, shadow_layer);
    return {.alpha = alpha != nullptr ? alpha->values : std::vector<float>(),
            .shadow = shadow != nullptr ? shadow->values : std::vector<float>()};
}

std::vector<float> coverage_of(const Matte& matte)
{
    std::vector<float> coverage = matte.alpha;
    for (std::size_t i = 0; i < matte.shadow.size(); ++i) {
        coverage[i] = std::clamp(coverage[i] - matte.shadow[i], 0.0f, 1.0f);
    }
    return coverage;
}

Matte denoised(const io::Denoiser& denoiser, const Matte& noisy, std::span<const Layer> layers)
{
    const Layer* shadow = find(layers, shadow_layer);
    if (shadow == nullptr || noisy.alpha.empty()) {
        return noisy;
    }
    const std::vector<float> coverage = coverage_of(noisy);
    std::vector<float> seen(coverage);  // of the ground
    std::transform(seen.begin(), seen.end(), seen.begin(),
                   [](float covered) { return 1.0f - covered; });
    const Layer opacity = visible_values(*shadow, seen);
    Image image{shadow->width, shadow->height, {}};
    image.pixels.reserve(opacity.values.size());
    for (const float value : opacity.values) {
        image.pixels.emplace_back(value);
    }
    const Image clean = denoiser.denoise({.image = image});
    Matte result = noisy;
    for (std::size_t i = 0; i < clean.pixels.size(); ++i) {
        result.shadow[i] = seen[i] * std::clamp(clean.pixels[i].g, 0.0f, 1.0f);
        result.alpha[i] = coverage[i] + result.shadow[i];
    }
    return result;
}

void put(const Matte& matte, const Matte& other, const char* name_of_other,
         std::vector<Layer>& layers)
{
    Layer* shadow = find(layers, shadow_layer);
    if (shadow == nullptr) {
        return;
    }
    shadow->values = matte.shadow;
    if (Layer* alpha = find(layers, main_layer)) {
        alpha->values = matte.alpha;
    }
    Layer extra = *shadow;
    extra.name = name_of_other;
    extra.values = other.shadow;
    layers.push_back(std::move(extra));
}

}  // namespace bdpt::app
