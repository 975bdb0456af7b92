#include "report/image/image_files.h"

#include <bdpt/io/display.h>
#include <bdpt/io/png.h>
#include <bdpt/io/tone_map.h>

#include <algorithm>

#include "options/values/output_files.h"
#include "options/values/pipes.h"
#include "report/image/denoised.h"

namespace bdpt::app {

namespace fs = std::filesystem;

namespace {

/// Alpha; empty if no layer has it.
std::span<const float> coverage_of(std::span<const Layer> layers)
{
    const auto found = std::find_if(layers.begin(), layers.end(), [](const Layer& layer) {
        return layer.name.empty() && layer.channels == "A";
    });
    return found != layers.end() ? std::span(found->values) : std::span<const float>();
}

WrittenImages write_as_they_are(std::span<const fs::path> outputs, const Image& exr_image,
                                const Image& image, const ImageFileOptions& options)
{
    const DisplayArguments& display = options.display;
    const auto background = display.backdrop ? display.backdrop->color : std::nullopt;
    const auto coverage = display.backdrop ? coverage_of(options.layers) : std::span<const float>();
    WrittenImages report;
    for (const fs::path& output : outputs) {
        const fs::path file = written_file(output);
        if (type_of(output) == ImageType::exr) {
            report.clamped_pixels =
                io::write_exr(file, exr_image, options.layers, options.exr).clamped_pixels;
            continue;
        }
        if (!report.exposure) {
            report.exposure = display.exposure.value_or(io::automatic_exposure(image));
        }
        io::write_png(file,
                      io::to_display(image, coverage,
                                     {.exposure = *report.exposure,
                                      .curve = display.curve,
                                      .type = display.type,
                                      .background = background}),
                      {.exposure = *report.exposure,
                       .metadata = options.exr.metadata,
                       .curve = display.curve});
    }
    return report;
}

}  // namespace

WrittenImages write_image_files(std::span<const fs::path> outputs, const Image& image,
                                ImageFileOptions options)
{
    if (options.denoiser == nullptr || outputs.empty()) {
        return write_as_they_are(outputs, image, image, options);
    }
    const Image clean = denoised(*options.denoiser, image, options.layers);
    const bool clean_first = options.denoised_as == DenoisedAs::image;
    options.layers.push_back(clean_first ? layer_of(image, "noisy") : layer_of(clean, "denoised"));
    return write_as_they_are(outputs, clean_first ? clean : image, clean, options);
}

}  // namespace bdpt::app
