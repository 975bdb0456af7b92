#include "report/image/matte.h"

#include <bdpt/image.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string_view>
#include <utility>

#include "report/image/visible_values.h"

namespace bdpt::app {
namespace {

/// Returns the layer of that name that has only alpha.
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
constexpr std::string_view opacity_layer = "opacity";

}  // namespace

Matte find_matte(std::span<const Layer> layers)
{
    const Layer* alpha = find(layers, main_layer);
    const Layer* shadow = find(layers, shadow_layer);
    return {.alpha = alpha != nullptr ? alpha->values : std::vector<float>(),
            .shadow = shadow != nullptr ? shadow->values : std::vector<float>()};
}

std::vector<float> compute_coverage(const Matte& matte)
{
    std::vector<float> coverage = matte.alpha;
    for (std::size_t i = 0; i < matte.shadow.size(); ++i) {
        coverage[i] = std::clamp(coverage[i] - matte.shadow[i], 0.0f, 1.0f);
    }
    return coverage;
}

std::vector<float> clean_coverage(const Matte& noisy, std::span<const Layer> layers)
{
    const Layer* opacity = find(layers, opacity_layer);
    return opacity != nullptr ? opacity->values : compute_coverage(noisy);
}

Matte denoised(const io::Denoiser& denoiser, const Matte& noisy, std::span<const Layer> layers)
{
    Matte result = noisy;
    if (noisy.alpha.empty()) {
        return result;
    }
    const std::vector<float> coverage = clean_coverage(noisy, layers);
    const Layer* shadow = find(layers, shadow_layer);
    if (shadow == nullptr) {
        result.alpha = coverage;
        return result;
    }
    std::vector<float> seen = compute_coverage(noisy);  // visible fraction of the ground
    std::transform(seen.begin(), seen.end(), seen.begin(),
                   [](float covered) { return 1.0f - covered; });
    const Layer opacity = visible_values(*shadow, seen);
    Image image{shadow->width, shadow->height, {}};
    image.pixels.reserve(opacity.values.size());
    for (const float value : opacity.values) {
        image.pixels.emplace_back(value);
    }
    const Image clean = denoiser.denoise({.image = image});
    for (std::size_t i = 0; i < clean.pixels.size(); ++i) {
        result.shadow[i] = (1.0f - coverage[i]) * std::clamp(clean.pixels[i].g, 0.0f, 1.0f);
        result.alpha[i] = coverage[i] + result.shadow[i];
    }
    return result;
}

Image with_shadow(Image image, std::span<const float> shadow)
{
    for (std::size_t i = 0; i < shadow.size(); ++i) {
        image.pixels[i] *= 1.0f - std::clamp(shadow[i], 0.0f, 1.0f);
    }
    return image;
}

void put(const Matte& matte, const Matte& other, const MatteNames& names_of_other,
         std::vector<Layer>& layers)
{
    std::vector<Layer> extra;
    const auto exchange = [&extra](Layer* layer, const std::vector<float>& values,
                                   const std::vector<float>& others, const char* name) {
        if (layer != nullptr) {
            layer->values = others;
            extra.push_back(*layer);
            extra.back().name = name;
            layer->values = values;
        }
    };
    const bool blends = find(layers, opacity_layer) != nullptr;
    Layer* alpha = find(layers, main_layer);
    Layer* shadow = find(layers, shadow_layer);
    if (blends) {
        exchange(alpha, matte.alpha, other.alpha, names_of_other.alpha);
    } else if (alpha != nullptr) {
        alpha->values = matte.alpha;
    }
    exchange(shadow, matte.shadow, other.shadow, names_of_other.shadow);
    std::move(extra.begin(), extra.end(), std::back_inserter(layers));
}

}  // namespace bdpt::app
