#include "output/cryptomatte.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

namespace bdpt::io {
namespace {

/// Returns {"lamp":"4090f8a4",...}
std::string manifest_text(const IdManifest& manifest)
{
    using Json = nlohmann::json;
    Json names = Json::object();
    for (const NamedId& name : manifest.names) {
        names[name.name] = hex_text(name.id);
    }
    return names.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

void add_cryptomatte_metadata(Imf::Header& header, std::span<const IdManifest> manifests)
{
    for (const IdManifest& manifest : manifests) {
        if (header.channels().findChannel(manifest.layer + "00.r") == nullptr) {
            continue;
        }
        constexpr std::size_t key_length = 7;
        const std::string key =
            "cryptomatte/" + hex_text(name_id(manifest.layer)).substr(0, key_length) + "/";
        const auto insert = [&](const char* name, const std::string& text) {
            header.insert(key + name, Imf::StringAttribute(text));
        };
        insert("name", manifest.layer);
        insert("hash", "MurmurHash3_32");
        insert("conversion", "uint32_to_float32");
        insert("manifest", manifest_text(manifest));
    }
}

}  // namespace bdpt::io
