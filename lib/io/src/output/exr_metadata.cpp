#include "output/exr_metadata.h"

#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFramesPerSecond.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/chrono.h>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <limits>

#include "output/camera_matrices.h"

namespace bdpt::io {
namespace {

/// GLM has v' = M v in columns, Imath v' = v M in rows: the same numbers in the same places.
Imath::M44f to_imath(const Mat4& matrix)
{
    Imath::M44f result;
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            result[i][j] = matrix[i][j];
        }
    }
    return result;
}

}  // namespace

void add_exr_metadata(Imf::Header& header, const ImageMetadata& metadata, float aspect)
{
    const float seconds = static_cast<float>(metadata.render_seconds);
    const int samples = static_cast<int>(
        std::min<std::int64_t>(metadata.samples_per_pixel, std::numeric_limits<int>::max()));

    Imf::addChromaticities(header, Imf::Chromaticities{});  // default is Rec. 709
    Imf::addWhiteLuminance(header, 1.0f);                   // pixels are in nit
    const std::time_t created = std::chrono::system_clock::to_time_t(metadata.created);
    Imf::addCapDate(header, fmt::format("{:%Y:%m:%d %H:%M:%S}", fmt::gmtime(created)));
    Imf::addUtcOffset(header, 0.0f);
    Imf::addWorldToCamera(header, to_imath(camera_from_file(metadata.camera, metadata.origin)));
    Imf::addWorldToNDC(header, to_imath(ndc_from_file(metadata.camera, metadata.origin, aspect)));

    header.insert("software", Imf::StringAttribute(software_name(metadata)));
    for (const auto& [name, text] : text_entries(metadata)) {
        header.insert(name.c_str(), Imf::StringAttribute(text));
    }
    if (metadata.frame) {
        // Standard attributes: an image's number in the order of play, and its rate.
        header.insert("imageCounter", Imf::IntAttribute(metadata.frame->number));
        if (metadata.frame->per_second > 0.0) {
            Imf::addFramesPerSecond(header, Imf::guessExactFps(metadata.frame->per_second));
        }
    }
    header.insert("bdpt.spp", Imf::IntAttribute(samples));
    header.insert("bdpt.renderTimeSeconds", Imf::FloatAttribute(seconds));
    header.insert("samplesPerPixel", Imf::IntAttribute(samples));
    header.insert("renderTimeSeconds", Imf::FloatAttribute(seconds));
}

}  // namespace bdpt::io
