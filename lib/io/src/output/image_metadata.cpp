#include <bdpt/io/image_metadata.h>

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
    if (!metadata.xmp.empty()) {
        entries.emplace_back("bdpt.xmp", metadata.xmp);
    }
    return entries;
}

std::string software_name(const ImageMetadata& metadata)
{
    return "bdpt " + metadata.version;
}

}  // namespace bdpt::io
