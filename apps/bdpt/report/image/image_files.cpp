#include "report/image/image_files.h"

#include <bdpt/io/display.h>
#include <bdpt/io/picture.h>
#include <bdpt/io/png.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "options/values/output_files.h"
#include "options/values/pipes.h"
#include "report/image/backplate.h"
#include "report/image/denoised.h"
#include "report/image/matte.h"
#include "report/image/shown_exposure.h"

namespace bdpt::app {

namespace fs = std::filesystem;

namespace {

/// Image content of files for screens.
struct Picture {
    const Image& image;
    Matte matte;
    std::optional<Image> backplate{};
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
    const io::PngOptions file_options{
        .exposure = exposure, .metadata = options.exr.metadata, .curve = display.curve};
    const TexelImage texels = make_texels(picture, type, exposure, display);
    if (type == ImageType::png) {
        io::write_png(file, texels, file_options);
    } else if (type == ImageType::jpeg) {
        io::write_jpeg(file, texels, file_options);
    } else {
        io::write_webp(file, texels);
    }
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
                report.exposure =
                    shown_exposure(options.display.exposure, options.exr.metadata, picture.image);
            }
            write_picture(file, type, picture, *report.exposure, options);
        }
    };
    for (const fs::path& output : outputs) {
        if (attempts.run([&] { write(written_file(output), *find_type(output)); })) {
            report.files.push_back(output);
        }
    }
    return report;
}

/// Returns the image denoised; the options have a denoiser.
Image clean_image(const Image& image, const Matte& noisy, const ImageFileOptions& options)
{
    // Without a backdrop, uncovered pixels show the environment.
    return options.display.backdrop && !noisy.alpha.empty()
               ? denoised(*options.denoiser, image, options.layers,
                          {.noisy = compute_coverage(noisy),
                           .clean = clean_coverage(noisy, options.layers)})
               : denoised(*options.denoiser, image, options.layers);
}

}  // namespace

std::vector<Layer> develop_layers(const Film& film, const AovFilm& aovs, const IdFilm& ids)
{
    std::vector<Layer> layers = aovs.develop(film);
    std::vector<Layer> more = ids.develop(film);
    std::move(more.begin(), more.end(), std::back_inserter(layers));
    return layers;
}

WrittenImages write_image_files(std::span<const fs::path> outputs, const Image& image,
                                ImageFileOptions options, Attempts& attempts)
{
    const Matte noisy = find_matte(options.layers);
    const bool is_shown = std::any_of(outputs.begin(), outputs.end(), [](const fs::path& output) {
        return is_for_screens(*find_type(output));
    });
    std::optional<Image> behind =
        is_shown ? backplate(options.display, image, options.exr.placement) : std::nullopt;
    if (options.denoiser == nullptr || outputs.empty()) {
        return write_as_they_are(outputs, image, {image, noisy, std::move(behind)}, options,
                                 attempts);
    }
    const Image clean = clean_image(image, noisy, options);
    const Matte clean_matte = denoised(*options.denoiser, noisy, options.layers);
    const bool clean_first = options.denoised_as == DenoisedAs::image;
    if (clean_first) {
        put(clean_matte, noisy, {.alpha = "noisyAlpha", .shadow = "noisyShadow"}, options.layers);
        options.layers.push_back(to_layer(image, "noisy"));
    } else {
        put(noisy, clean_matte, {.alpha = "denoisedAlpha", .shadow = "denoisedShadow"},
            options.layers);
        options.layers.push_back(to_layer(clean, "denoised"));
    }
    return write_as_they_are(outputs, clean_first ? clean : image,
                             {clean, clean_matte, std::move(behind)}, options, attempts);
}

TexelImage screen_image(const Image& image, const ImageFileOptions& options)
{
    const Matte noisy = find_matte(options.layers);
    const auto texels = [&options](const Picture& picture) {
        const float exposure =
            shown_exposure(options.display.exposure, options.exr.metadata, picture.image);
        return make_texels(picture, ImageType::png, exposure, options.display);
    };
    std::optional<Image> behind = backplate(options.display, image, options.exr.placement);
    return options.denoiser == nullptr
               ? texels({image, noisy, std::move(behind)})
               : texels({clean_image(image, noisy, options),
                         denoised(*options.denoiser, noisy, options.layers), std::move(behind)});
}

}  // namespace bdpt::app
