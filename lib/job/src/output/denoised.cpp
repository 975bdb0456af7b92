#include "output/image_files.h"

#include <bdpt/error.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string_view>
#include <utility>

namespace bdpt::job {
namespace {

/// Values times shares, and shares.
struct Level {
    std::size_t width = 0;
    std::size_t height = 0;
    std::vector<float> sums;
    std::vector<float> shares;
};

/// Returns the next coarser level: means of two by two pixels.
Level pulled(const Level& fine, std::size_t channels)
{
    Level coarse{(fine.width + 1) / 2, (fine.height + 1) / 2, {}, {}};
    const std::size_t pixels = coarse.width * coarse.height;
    coarse.sums.resize(pixels * channels);
    coarse.shares.resize(pixels);
    for (std::size_t y = 0; y < fine.height; ++y) {
        for (std::size_t x = 0; x < fine.width; ++x) {
            const std::size_t from = y * fine.width + x;
            const std::size_t to = (y / 2) * coarse.width + x / 2;
            coarse.shares[to] += 0.25f * fine.shares[from];
            for (std::size_t c = 0; c < channels; ++c) {
                coarse.sums[to * channels + c] += 0.25f * fine.sums[from * channels + c];
            }
        }
    }
    return coarse;
}

/// Returns the values of a level; pixels that show nothing get those of the coarser one.
std::vector<float> pushed(const Level& fine, const std::vector<float>& coarse, std::size_t channels)
{
    std::vector<float> values(fine.sums.size());
    const std::size_t coarse_width = (fine.width + 1) / 2;
    for (std::size_t i = 0; i < fine.shares.size(); ++i) {
        const std::size_t parent = (i / fine.width / 2) * coarse_width + (i % fine.width) / 2;
        for (std::size_t c = 0; c < channels; ++c) {
            // Mixing both would bleed a bright neighbour into the dark pixels of an edge.
            values[i * channels + c] = fine.shares[i] > 0.0f
                                           ? fine.sums[i * channels + c] / fine.shares[i]
                                           : coarse[parent * channels + c];
        }
    }
    return values;
}

}  // namespace

Layer visible_values(const Layer& layer, std::span<const float> shares)
{
    const std::size_t channels = layer.channels.size();
    std::vector<Level> levels;
    levels.push_back({static_cast<std::size_t>(layer.width),
                      static_cast<std::size_t>(layer.height),
                      layer.values,
                      {shares.begin(), shares.end()}});
    while (levels.back().shares.size() > 1) {
        levels.push_back(pulled(levels.back(), channels));
    }
    std::vector<float> values(channels, 0.0f);
    for (std::size_t level = levels.size(); level-- > 0;) {
        values = pushed(levels[level], values, channels);
    }
    Layer result = layer;
    result.values = std::move(values);
    return result;
}

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

Image denoised(const io::Denoiser& denoiser, const Image& image, std::span<const Layer> layers,
               const io::DenoiserControl& control)
{
    const Layer* albedo = find(layers, "albedo");
    return denoiser.denoise({.image = image,
                             .albedo = albedo,
                             .normal = albedo != nullptr ? find(layers, "normal") : nullptr},
                            control);
}

Image denoised(const io::Denoiser& denoiser, const Image& image, std::span<const Layer> layers,
               const Coverage& coverage, const io::DenoiserControl& control)
{
    std::vector<Layer> helpers;
    for (const char* name : {"albedo", "normal"}) {
        if (const Layer* layer = find(layers, name)) {
            helpers.push_back(visible_values(*layer, coverage.noisy));
        }
    }
    const Image colors = to_image(visible_values(to_layer(image, ""), coverage.noisy));
    Image result = denoised(denoiser, colors, helpers, control);
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

Matte denoised(const io::Denoiser& denoiser, const Matte& noisy, std::span<const Layer> layers,
               const io::DenoiserControl& control)
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
    const Image clean = denoiser.denoise({.image = image}, control);
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

void put(const Matte& matte, const Matte& other, const std::string& name_of_other,
         std::vector<Layer>& layers)
{
    std::vector<Layer> extra;
    const auto exchange = [&extra](Layer* layer, const std::vector<float>& values,
                                   const std::vector<float>& others, const std::string& name) {
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
        exchange(alpha, matte.alpha, other.alpha, name_of_other + "Alpha");
    } else if (alpha != nullptr) {
        alpha->values = matte.alpha;
    }
    exchange(shadow, matte.shadow, other.shadow, name_of_other + "Shadow");
    std::move(extra.begin(), extra.end(), std::back_inserter(layers));
}

}  // namespace bdpt::job
