#include "report/image/image_files.h"

#include <bdpt/io/display.h>
#include <bdpt/io/png.h>
#include <bdpt/io/tone_map.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "options/values/output_files.h"
#include "options/values/pipes.h"
#include "report/image/denoised.h"
#include "report/image/matte.h"

namespace bdpt::app {

namespace fs = std::filesystem;

namespace {

/// What .png files show.
struct Picture {
    const Image& image;
    Matte matte;
};

WrittenImages write_as_they_are(std::span<const fs::path> outputs, const Image& exr_image,
                                const Picture& picture, const ImageFileOptions& options)
{
    const DisplayArguments& display = options.display;
    const auto background = display.backdrop ? display.backdrop->color : std::nullopt;
    const Matte& matte = picture.matte;
    const auto coverage = display.backdrop ? std::span(matte.alpha) : std::span<const float>();
    const auto shadow = display.backdrop ? std::span(matte.shadow) : std::span<const float>();
    WrittenImages report;
    for (const fs::path& output : outputs) {
        const fs::path file = written_file(output);
        if (type_of(output) == ImageType::exr) {
            report.clamped_pixels =
                io::write_exr(file, exr_image, options.layers, options.exr).clamped_pixels;
            continue;
        }
        if (!report.exposure) {
            report.exposure = display.exposure.value_or(io::automatic_exposure(picture.image));
        }
        io::write_png(file,
                      io::to_display(picture.image, coverage,
                                     {.exposure = *report.exposure,
                                      .curve = display.curve,
                                      .type = display.type,
                                      .background = background,
                                      .shadow = shadow}),
                      {.exposure = *report.exposure,
                       .metadata = options.exr.metadata,
                       .curve = display.curve});
    }
    return report;
}

}  // namespace

std::vector<Layer> layers_of(const Film& film, const AovFilm& aovs, const IdFilm& ids)
{
    std::vector<Layer> layers = aovs.develop(film);
    std::vector<Layer> more = ids.develop(film);
    std::move(more.begin(), more.end(), std::back_inserter(layers));
    return layers;
}

WrittenImages write_image_files(std::span<const fs::path> outputs, const Image& image,
                                ImageFileOptions options)
{
    const Matte noisy = matte_of(options.layers);
    if (options.denoiser == nullptr || outputs.empty()) {
        return write_as_they_are(outputs, image, {image, noisy}, options);
    }
    // Without a backdrop what no surface covers is the sky.
    const Image clean = options.display.backdrop && !noisy.alpha.empty()
                            ? denoised(*options.denoiser, image, options.layers, coverage_of(noisy))
                            : denoised(*options.denoiser, image, options.layers);
    const Matte clean_matte = denoised(*options.denoiser, noisy, options.layers);
    const bool clean_first = options.denoised_as == DenoisedAs::image;
    if (clean_first) {
        put(clean_matte, noisy, "noisyShadow", options.layers);
        options.layers.push_back(layer_of(image, "noisy"));
    } else {
        put(noisy, clean_matte, "denoisedShadow", options.layers);
        options.layers.push_back(layer_of(clean, "denoised"));
    }
    return write_as_they_are(outputs, clean_first ? clean : image, {clean, clean_matte}, options);
}

}  // namespace bdpt::app
