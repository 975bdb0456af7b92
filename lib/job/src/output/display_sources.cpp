#include "output/image_files.h"

#include <bdpt/error.h>
#include <bdpt/io/read_image.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>
#include <utility>

namespace bdpt::job {
namespace {

namespace fs = std::filesystem;
using Attributes = std::vector<std::pair<std::string, std::string>>;

/// Returns the pixels in `rect`.
Image cropped(Image image, const PixelRect& rect)
{
    if (rect.x0 == 0 && rect.y0 == 0 && rect.x1 == image.width && rect.y1 == image.height) {
        return image;
    }
    Image result{rect.x1 - rect.x0, rect.y1 - rect.y0, {}};
    for (int y = rect.y0; y < rect.y1; ++y) {
        for (int x = rect.x0; x < rect.x1; ++x) {
            result.pixels.push_back(image.at(x, y));
        }
    }
    return result;
}

/// Reads a layer of `file`, within its data window; none: there is no such layer.
std::optional<Image> layer_in(const fs::path& file, const char* name)
{
    try {
        io::LoadedImage loaded = io::read_image(file, {.layer = name});
        return cropped(std::move(loaded.image), loaded.filled);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::not_found) {
            throw;
        }
        return std::nullopt;
    }
}

/// Returns a layer with one value per pixel.
Layer alpha_layer(const Image& image, const char* name)
{
    Layer layer{
        .name = name, .channels = "A", .width = image.width, .height = image.height, .values = {}};
    for (const Rgb& pixel : image.pixels) {
        layer.values.push_back(pixel.r);
    }
    return layer;
}

/// Replaces the noisy alpha and shadow in `layers` of `file` by its denoised ones, if it has them.
std::vector<Layer> with_clean_matte(const fs::path& file, std::vector<Layer> layers)
{
    const Matte noisy = find_matte(layers);
    if (noisy.alpha.empty()) {
        return layers;
    }
    Matte matte = noisy;
    if (const std::optional<Image> shadow = layer_in(file, "denoisedShadow")) {
        matte.shadow = alpha_layer(*shadow, "").values;
        matte.alpha = compute_coverage(noisy);
        for (std::size_t i = 0; i < matte.alpha.size(); ++i) {
            matte.alpha[i] += matte.shadow[i];
        }
    }
    if (const std::optional<Image> alpha = layer_in(file, "denoisedAlpha")) {
        matte.alpha = alpha_layer(*alpha, "").values;
    }
    put(matte, noisy, "noisy", layers);
    return layers;
}

std::string text_in(const Attributes& attributes, std::string_view name)
{
    const auto found = std::find_if(attributes.begin(), attributes.end(),
                                    [name](const auto& entry) { return entry.first == name; });
    return found != attributes.end() ? found->second : std::string();
}

template <typename Number>
Number number_in(const Attributes& attributes, std::string_view name)
{
    const std::string text = text_in(attributes, name);
    Number number{};
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
}

io::ImageMetadata metadata_in(const Attributes& attributes)
{
    io::ImageMetadata metadata;
    metadata.version = text_in(attributes, "bdpt.version");
    metadata.scene = text_in(attributes, "bdpt.scene");
    metadata.settings = text_in(attributes, "bdpt.settings");
    metadata.integrator = text_in(attributes, "bdpt.integrator");
    metadata.denoiser = text_in(attributes, "bdpt.denoiser");
    metadata.xmp = text_in(attributes, "bdpt.xmp");
    metadata.seed = number_in<std::uint64_t>(attributes, "bdpt.seed");
    metadata.samples_per_pixel = number_in<std::int64_t>(attributes, "bdpt.spp");
    metadata.render_seconds = number_in<double>(attributes, "bdpt.renderTimeSeconds");
    return metadata;
}

/// Returns the backdrop by the settings of the image's render. Alpha of other programs is that of a
/// transparent image; ours may also be a layer of an image that shows the environment.
std::optional<Backdrop> find_backdrop(const io::ImageMetadata& metadata, bool has_alpha)
{
    if (!has_alpha) {
        return std::nullopt;
    }
    if (metadata.version.empty()) {
        return Backdrop{};
    }
    const auto settings = nlohmann::json::parse(metadata.settings, nullptr, false);
    const bool is_named = settings.is_object() && settings.contains("background") &&
                          settings["background"].is_string();
    return is_named ? parse_backdrop(settings["background"].get<std::string>()) : std::nullopt;
}

}  // namespace

LayeredImage read_layered_image(const fs::path& file, Wanted wanted)
{
    io::LoadedImage main = io::read_image(file);
    const io::ExrPlacement placement{.x = main.filled.x0,
                                     .y = main.filled.y0,
                                     .full_width = main.image.width,
                                     .full_height = main.image.height};
    LayeredImage result{.image = cropped(std::move(main.image), main.filled),
                        .placement = placement,
                        .layers = {},
                        .metadata = metadata_in(main.attributes),
                        .warnings = std::move(main.warnings)};
    if (result.image.pixels.empty()) {
        throw Error(ErrorCode::invalid_input, file.string() + ": has no pixels in its window");
    }
    const std::optional<Image> alpha = layer_in(file, "A");
    if (alpha) {
        result.layers.push_back(alpha_layer(*alpha, ""));
    }
    result.backdrop = find_backdrop(result.metadata, alpha.has_value());
    // An image that shows the environment is already darkened by the shadow.
    if (const auto shadow = result.backdrop ? layer_in(file, "shadow") : std::nullopt) {
        result.layers.push_back(alpha_layer(*shadow, "shadow"));
    }
    result.is_denoised = layer_in(file, "noisy").has_value();
    std::optional<Image> clean =
        wanted == Wanted::clean ? layer_in(file, "denoised") : std::nullopt;
    if (clean) {
        result.image = std::move(*clean);
        result.is_denoised = true;
        result.layers = with_clean_matte(file, std::move(result.layers));
    }
    if (!result.is_denoised) {
        result.metadata.denoiser.clear();
    }
    if (const std::optional<Image> opacity = layer_in(file, "opacity")) {
        result.layers.push_back(alpha_layer(*opacity, "opacity"));
    }
    for (const char* name : {"albedo", "normal"}) {
        if (const std::optional<Image> layer = layer_in(file, name)) {
            result.layers.push_back(to_layer(*layer, name));
        }
    }
    return result;
}

namespace {

/// The samples on one axis that contribute to a pixel, and their weights.
struct Taps {
    int first = 0;
    std::vector<float> weights;
};

/// Returns the taps of a pixel centred at `center` on an axis of `size` samples, of which `step`
/// cover a pixel: a tent two pixels wide, or two samples if those are larger.
Taps taps_at(double center, double step, int size)
{
    const double radius = std::max(1.0, step);
    const int first = static_cast<int>(std::floor(center - radius));
    const int last = static_cast<int>(std::ceil(center + radius));
    Taps taps{.first = std::clamp(first, 0, size - 1), .weights = {}};
    taps.weights.resize(static_cast<std::size_t>(std::clamp(last, 0, size - 1) - taps.first) + 1);
    double sum = 0.0;
    const auto weight = [&](int sample) {
        return std::max(0.0, 1.0 - std::abs(sample + 0.5 - center) / radius);
    };
    for (int sample = first; sample <= last; ++sample) {
        sum += weight(sample);
    }
    for (int sample = first; sample <= last; ++sample) {
        // The border is replicated.
        const int inside = std::clamp(sample, 0, size - 1);
        taps.weights[static_cast<std::size_t>(inside - taps.first)] +=
            static_cast<float>(weight(sample) / sum);
    }
    return taps;
}

Rgb shown(Rgb color)
{
    for (int channel = 0; channel < 3; ++channel) {
        color[channel] = color[channel] > 0.0f ? std::min(color[channel], 1.0f) : 0.0f;
    }
    return color;
}

/// Returns the weighted sum of pixels at a distance of `stride`.
Rgb weighted(const Image& image, std::size_t begin, std::size_t stride, const Taps& taps)
{
    Rgb sum(0.0f);
    for (std::size_t i = 0; i < taps.weights.size(); ++i) {
        sum += taps.weights[i] * image.pixels[begin + stride * i];
    }
    return sum;
}

/// Fits `image` to a full frame: scales it uniformly until it covers the frame, crops two sides if
/// its proportions differ, and returns the part that lies behind the frame's region from x and y.
/// Filtered in linear light; an image of the frame's size is unchanged. Values are limited to [0,
/// 1], what a screen shows.
Image behind_frame(const Image& image, const io::ExrPlacement& frame, int width, int height)
{
    const double step = std::min(static_cast<double>(image.width) / frame.full_width,
                                 static_cast<double>(image.height) / frame.full_height);
    const auto taps = [step](int pixel, int pixels, int samples) {
        return taps_at(0.5 * samples + step * (pixel + 0.5 - 0.5 * pixels), step, samples);
    };
    Image clean = image;
    std::transform(clean.pixels.begin(), clean.pixels.end(), clean.pixels.begin(), shown);
    const auto samples = static_cast<std::size_t>(image.width);
    std::vector<Taps> across;
    for (int x = 0; x < width; ++x) {
        across.push_back(taps(x + frame.x, frame.full_width, image.width));
    }
    Image wide{width, image.height, {}};  // final width, original height
    for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y) {
        for (const Taps& of_pixel : across) {
            wide.pixels.push_back(weighted(
                clean, y * samples + static_cast<std::size_t>(of_pixel.first), 1, of_pixel));
        }
    }
    Image result{width, height, {}};
    const auto columns = static_cast<std::size_t>(width);
    for (int y = 0; y < height; ++y) {
        const Taps down = taps(y + frame.y, frame.full_height, image.height);
        for (std::size_t x = 0; x < columns; ++x) {
            result.pixels.push_back(
                weighted(wide, static_cast<std::size_t>(down.first) * columns + x, columns, down));
        }
    }
    return result;
}

}  // namespace

std::optional<Image> backplate(const DisplayArguments& display, const Image& image,
                               const std::optional<io::ExrPlacement>& frame)
{
    if (!display.backdrop || display.backdrop->photo.empty()) {
        return std::nullopt;
    }
    const io::ExrPlacement whole{.full_width = image.width, .full_height = image.height};
    return behind_frame(io::read_image(display.backdrop->photo).image, frame.value_or(whole),
                        image.width, image.height);
}

void check_backplate(const DisplayArguments& display)
{
    if (display.backdrop && !display.backdrop->photo.empty()) {
        static_cast<void>(io::read_image(display.backdrop->photo));
    }
}

std::filesystem::path find_photo(const std::filesystem::path& named,
                                 const std::filesystem::path& image)
{
    std::error_code ignored;
    const std::filesystem::path beside = image.parent_path() / named;
    return !exists(named, ignored) && exists(beside, ignored) ? beside : named;
}

}  // namespace bdpt::job
