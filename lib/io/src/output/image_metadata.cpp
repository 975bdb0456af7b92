#include <bdpt/io/write_image.h>
#include <fmt/chrono.h>
#include <fmt/core.h>

#include <chrono>
#include <ctime>

#include "output/picture_text.h"

namespace bdpt::io {

std::vector<std::pair<std::string, std::string>> text_entries(const ImageMetadata& metadata)
{
    // The seed has 64 bits, more than the integers of the formats hold.
    std::vector<std::pair<std::string, std::string>> entries{
        {"bdpt.version", metadata.version},
        {"bdpt.scene", metadata.scene},
        {"bdpt.settings", metadata.settings},
        {"bdpt.integrator", metadata.integrator},
        {"bdpt.seed", std::to_string(metadata.seed)}};
    if (metadata.frame) {
        entries.emplace_back("bdpt.frame", std::to_string(metadata.frame->number));
    }
    if (!metadata.denoiser.empty()) {
        entries.emplace_back("bdpt.denoiser", metadata.denoiser);
    }
    if (!metadata.xmp.empty()) {
        entries.emplace_back("bdpt.xmp", metadata.xmp);
    }
    return entries;
}

std::vector<std::pair<std::string, std::string>> picture_text(const PngOptions& options)
{
    const ImageMetadata& metadata = options.metadata;
    const std::time_t created = std::chrono::system_clock::to_time_t(metadata.created);
    std::vector<std::pair<std::string, std::string>> text{
        {"Software", software_name(metadata)},
        {"Creation Time", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(created))},
        {"bdpt.spp", std::to_string(metadata.samples_per_pixel)},
        {"bdpt.renderTimeSeconds", fmt::format("{}", metadata.render_seconds)},
        {"bdpt.exposure", fmt::format("{}", options.exposure)},
        {"bdpt.toneMap", std::string(tone_curve_name(options.curve))}};
    for (auto& entry : text_entries(metadata)) {
        text.push_back(std::move(entry));
    }
    return text;
}

std::string software_name(const ImageMetadata& metadata)
{
    return "bdpt " + metadata.version;
}

}  // namespace bdpt::io
