#include "output/image_files.h"

#include <bdpt/io/display.h>
#include <bdpt/io/write_image.h>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <nlohmann/json.hpp>

#include "options/output_files.h"

namespace bdpt::job {

void Attempts::finish() const
{
    if (errors_.empty()) {
        return;
    }
    std::string message;
    for (const Error& error : errors_) {
        message += (message.empty() ? "" : "; ") + std::string(error.what());
    }
    throw Error(errors_.front().code(), message);
}

namespace {

nlohmann::json settings_in(const io::ImageMetadata& metadata)
{
    return nlohmann::json::parse(metadata.settings, nullptr, false);
}

std::optional<float> metered_in(const nlohmann::json& settings)
{
    if (!settings.is_object() || !settings.contains("light_exposure") ||
        !settings["light_exposure"].is_number()) {
        return std::nullopt;
    }
    return settings["light_exposure"].get<float>();
}

}  // namespace

float shown_exposure(const std::optional<Exposure>& asked, const io::ImageMetadata& metadata,
                     const Image& image)
{
    const nlohmann::json settings = settings_in(metadata);
    const Exposure exposure = asked.value_or(Exposure{.base = ExposureBase::light});
    if (exposure.base == ExposureBase::radiance) {
        return exposure.value;
    }
    // Light is metered only if that is the default, or requested.
    const std::optional<float> metered =
        exposure.base == ExposureBase::light ? metered_in(settings) : std::nullopt;
    return exposure.value + (metered ? *metered : io::automatic_exposure(image));
}

void check_metered(const std::optional<Exposure>& asked, const io::ImageMetadata& metadata,
                   const std::string& what)
{
    if (asked && asked->base == ExposureBase::light && !metered_in(settings_in(metadata))) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("--exposure light: the incident light of {} was not metered; "
                                "render with --exposure light or --background",
                                what));
    }
}

namespace fs = std::filesystem;

namespace {

/// Image content of files for screens.
struct Picture {
    const Image& image;
    Matte matte;
    std::optional<Image> backplate{};
    std::string denoiser{};  ///< that made it; empty: none
};

/// Returns the pixels of files of that type.
TexelImage make_texels(const Picture& picture, ImageType type, float exposure,
                       const DisplayArguments& display)
{
    const bool has_backdrop = display.backdrop.has_value();
    return io::to_display(
        picture.image, has_backdrop ? std::span(picture.matte.alpha) : std::span<const float>(),
        {.exposure = exposure,
         .curve = display.curve,
         .type = type == ImageType::png ? display.type : TexelType::unorm8,
         .background = has_backdrop ? display.backdrop->color : std::nullopt,
         .backplate = picture.backplate ? &*picture.backplate : nullptr,
         .shadow = has_backdrop ? std::span(picture.matte.shadow) : std::span<const float>()});
}

/// Writes `picture` into a file of that type.
void write_picture(const fs::path& file, ImageType type, const Picture& picture, float exposure,
                   const ImageFileOptions& options)
{
    const DisplayArguments& display = options.display;
    io::PngOptions file_options{
        .exposure = exposure, .metadata = options.exr.metadata, .curve = display.curve};
    if (!picture.denoiser.empty()) {
        file_options.metadata.denoiser = picture.denoiser;
    }
    const TexelImage texels = make_texels(picture, type, exposure, display);
    if (type == ImageType::png) {
        io::write_png(file, texels, file_options);
    } else if (type == ImageType::jpeg) {
        io::write_jpeg(file, texels, file_options);
    } else {
        io::write_webp(file, texels, file_options);
    }
}

/// Returns the image by which the exposure is chosen. With automatic denoising, pictures have the
/// exposure that they have without.
const Image& metered_image(const Image& noisy, const Picture& picture,
                           const ImageFileOptions& options)
{
    return options.denoising == Denoising::automatic ? noisy : picture.image;
}

WrittenImages write_as_they_are(std::span<const fs::path> outputs, const Image& linear_image,
                                const Picture& picture, const ImageFileOptions& options,
                                Attempts& attempts)
{
    WrittenImages report;
    const auto write = [&](const fs::path& file, ImageType type) {
        if (type == ImageType::exr) {
            report.clamped_pixels =
                io::write_exr(file, linear_image, options.layers, options.exr).clamped_pixels;
        } else if (type == ImageType::hdr) {
            io::write_hdr(file, linear_image, options.exr.metadata);
        } else {
            if (!report.exposure) {
                report.exposure = shown_exposure(options.display.exposure, options.exr.metadata,
                                                 metered_image(linear_image, picture, options));
            }
            write_picture(file, type, picture, *report.exposure, options);
        }
    };
    for (const fs::path& output : outputs) {
        if (!attempts.run([&] { write(written_file(output), *find_type(output)); })) {
            continue;
        }
        report.files.push_back(output);
        if (!picture.denoiser.empty() &&
            (is_for_screens(output) || options.denoising == Denoising::image)) {
            report.denoised.push_back(output);
        }
    }
    return report;
}

/// Returns the image as files have it where a shadow on the ground darkens the visible environment;
/// none if it is `image`. Without a visible environment the shadow is part of alpha.
std::optional<Image> darkened(const Image& image, const Matte& matte,
                              const DisplayArguments& display)
{
    return display.backdrop || matte.shadow.empty()
               ? std::nullopt
               : std::optional(with_shadow(image, matte.shadow));
}

/// Returns the image denoised; the options have a denoiser.
Image clean_image(const Image& image, const Matte& noisy, const ImageFileOptions& options)
{
    // Without a backdrop, uncovered pixels show the environment.
    return options.display.backdrop && !noisy.alpha.empty()
               ? denoised(*options.denoiser, image, options.layers,
                          {.noisy = compute_coverage(noisy),
                           .clean = clean_coverage(noisy, options.layers)},
                          options.denoise_control)
               : denoised(*options.denoiser, image, options.layers, options.denoise_control);
}

}  // namespace

Cleaned cleaned(const Image& image, const Matte& noisy, const ImageFileOptions& options)
{
    const bool is_automatic = options.denoising == Denoising::automatic;
    if (options.denoiser == nullptr || (is_automatic && !has_guides(options.layers))) {
        return {};
    }
    try {
        return {
            .image = clean_image(image, noisy, options),
            .matte = denoised(*options.denoiser, noisy, options.layers, options.denoise_control)};
    } catch (const Error& error) {
        if (!is_automatic) {
            throw;
        }
        return {.failure = error.what()};
    }
}

namespace {

void drop_layer(Aov aov, std::vector<Layer>& layers)
{
    std::erase_if(layers, [aov](const Layer& layer) {
        return std::any_of(aov_layers.begin(), aov_layers.end(), [&](const AovLayer& known) {
            return known.aov == aov && known.layer == layer.name;
        });
    });
}

/// Writes files that all have the layers of `options` but those for screens.
WrittenImages write_alike(std::span<const fs::path> outputs, const Image& rendered,
                          ImageFileOptions options, Attempts& attempts)
{
    if (outputs.empty()) {
        return {};
    }
    const Matte noisy = find_matte(options.layers);
    const std::optional<Image> shadowed = darkened(rendered, noisy, options.display);
    const Image& image = shadowed ? *shadowed : rendered;
    const bool is_shown = std::any_of(outputs.begin(), outputs.end(), is_for_screens);
    std::optional<Image> behind =
        is_shown ? backplate(options.display, image, options.exr.placement) : std::nullopt;
    Cleaned clean = cleaned(image, noisy, options);
    for (const Aov aov : options.screen_aovs) {
        drop_layer(aov, options.layers);
    }
    if (!clean.image) {
        WrittenImages written = write_as_they_are(
            outputs, image, {.image = image, .matte = noisy, .backplate = std::move(behind)},
            options, attempts);
        written.why_noisy = std::move(clean.failure);
        return written;
    }
    const std::string denoiser = "Open Image Denoise " + options.denoiser->version();
    if (options.denoising == Denoising::image) {
        put(clean.matte, noisy, "noisy", options.layers);
        options.layers.push_back(to_layer(image, "noisy"));
        options.exr.metadata.denoiser = denoiser;
    } else if (options.denoising == Denoising::layer) {
        put(noisy, clean.matte, "denoised", options.layers);
        options.layers.push_back(to_layer(*clean.image, "denoised"));
        options.exr.metadata.denoiser = denoiser;
    }
    return write_as_they_are(outputs, options.denoising == Denoising::image ? *clean.image : image,
                             {.image = *clean.image,
                              .matte = std::move(clean.matte),
                              .backplate = std::move(behind),
                              .denoiser = denoiser},
                             options, attempts);
}

}  // namespace

std::vector<Layer> develop_layers(const RenderResult& part)
{
    std::vector<Layer> layers = part.aovs.develop(part.film);
    std::vector<Layer> more = part.ids.develop(part.film);
    std::move(more.begin(), more.end(), std::back_inserter(layers));
    return layers;
}

io::ImageMetadata completed(io::ImageMetadata metadata, std::int64_t samples, double seconds)
{
    metadata.samples_per_pixel = samples;
    metadata.render_seconds = seconds;
    metadata.created = std::chrono::system_clock::now();
    return metadata;
}

ImageFileOptions image_file_options(const RenderResult& part, io::ImageMetadata metadata,
                                    const ExrFormat& exr, const DisplayArguments& display,
                                    const io::Denoiser* denoiser, const DenoiseArguments& denoise)
{
    const FilmLayout& layout = part.film.layout();
    return {.exr = {.type = exr.channel_type,
                    .metadata = std::move(metadata),
                    .storage = exr.storage,
                    .placement = {{.x = layout.region.x0,
                                   .y = layout.region.y0,
                                   .full_width = layout.width,
                                   .full_height = layout.height}},
                    .manifests = part.ids.manifests()},
            .layers = develop_layers(part),
            .display = display,
            .denoiser = denoiser,
            .denoising = denoise.kind};
}

WrittenImages write_image_files(std::span<const fs::path> outputs, const Image& rendered,
                                ImageFileOptions options, Attempts& attempts)
{
    if (!is_among(options.screen_aovs, Aov::shadow)) {
        return write_alike(outputs, rendered, std::move(options), attempts);
    }
    std::vector<fs::path> screens(outputs.begin(), outputs.end());
    const auto others = std::stable_partition(screens.begin(), screens.end(), is_for_screens);
    const std::vector<fs::path> lights(others, screens.end());
    screens.erase(others, screens.end());
    WrittenImages written = write_alike(screens, rendered, options, attempts);
    drop_layer(Aov::shadow, options.layers);
    if (options.denoising == Denoising::automatic) {
        options.denoiser = nullptr;
    }
    const WrittenImages more = write_alike(lights, rendered, std::move(options), attempts);
    written.clamped_pixels = more.clamped_pixels;
    const auto add = [&outputs](std::vector<fs::path>& files, const std::vector<fs::path>& others) {
        files.insert(files.end(), others.begin(), others.end());
        std::ranges::sort(files, {}, [&outputs](const fs::path& file) {
            return std::find(outputs.begin(), outputs.end(), file) - outputs.begin();
        });
    };
    add(written.files, more.files);
    add(written.denoised, more.denoised);
    return written;
}

TexelImage screen_image(const Image& rendered, const ImageFileOptions& options)
{
    const Matte noisy = find_matte(options.layers);
    const std::optional<Image> shadowed = darkened(rendered, noisy, options.display);
    const Image& image = shadowed ? *shadowed : rendered;
    const auto texels = [&](const Picture& picture) {
        const float exposure = shown_exposure(options.display.exposure, options.exr.metadata,
                                              metered_image(image, picture, options));
        return make_texels(picture, ImageType::png, exposure, options.display);
    };
    std::optional<Image> behind = backplate(options.display, image, options.exr.placement);
    const Cleaned clean = cleaned(image, noisy, options);
    return clean.image ? texels({*clean.image, clean.matte, std::move(behind)})
                       : texels({image, noisy, std::move(behind)});
}

}  // namespace bdpt::job
