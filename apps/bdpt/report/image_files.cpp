#include "report/image_files.h"

#include <bdpt/io/png.h>
#include <bdpt/io/tone_map.h>

#include "options/output_files.h"

namespace bdpt::app {

namespace fs = std::filesystem;

WrittenImages write_image_files(std::span<const fs::path> outputs, const Image& image,
                                const ImageFileOptions& options)
{
    WrittenImages report;
    for (const fs::path& output : outputs) {
        if (has_extension(output, ".exr")) {
            report.clamped_pixels =
                io::write_exr(output, image, options.layers, options.exr).clamped_pixels;
            continue;
        }
        if (!report.exposure) {
            report.exposure = options.exposure.value_or(io::automatic_exposure(image));
        }
        io::write_png(output, io::tone_map(image, *report.exposure),
                      {.exposure = *report.exposure, .metadata = options.exr.metadata});
    }
    return report;
}

}  // namespace bdpt::app
