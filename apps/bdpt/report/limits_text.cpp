#include "report/limits_text.h"

#include <fmt/core.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

namespace bdpt::app {
namespace {

struct Limit {
    std::string_view name;
    std::uint64_t value = 0;
    std::string_view meaning;
};

/// Returns all limits: a new member of the struct does not compile until it is added here.
std::vector<Limit> list(const io::ReadLimits& limits)
{
    const auto& [file_bytes, buffer_bytes, json_bytes, json_depth, json_values, nodes, node_depth,
                 instances, mesh_bytes, triangles, image_side, image_bytes, texture_bytes,
                 volume_bytes, volume_seconds, compression_ratio, memory_bytes] = limits;
    return {
        {"file_bytes", file_bytes, "bytes of one file"},
        {"buffer_bytes", buffer_bytes, "bytes of all buffers of a scene"},
        {"json_bytes", json_bytes, "bytes of the JSON text, data URIs included"},
        {"json_depth", json_depth, "nested objects and arrays"},
        {"json_values", json_values, "objects, arrays, strings, numbers"},
        {"nodes", nodes, "nodes of a scene"},
        {"node_depth", node_depth, "nested nodes"},
        {"instances", instances, "meshes placed in a scene"},
        {"mesh_bytes", mesh_bytes, "bytes of vertices, key frames and instances, decoded"},
        {"triangles", triangles, "triangles, each mesh once"},
        {"image_side", static_cast<std::uint64_t>(image_side), "pixels per side of an image"},
        {"image_bytes", image_bytes, "bytes of one image, decoded"},
        {"texture_bytes", texture_bytes, "bytes of all images, decoded"},
        {"volume_bytes", volume_bytes, "bytes of the densities of a volume"},
        {"volume_seconds", volume_seconds, "CPU seconds to read a volume"},
        {"compression_ratio", compression_ratio, "decoded over encoded size of compressed meshes"},
        {"memory_bytes", memory_bytes, "bytes of a scene in memory, as estimated"}};
}

}  // namespace

std::string limits_text(const io::ReadLimits& limits)
{
    std::string text;
    for (const Limit& limit : list(limits)) {
        text += fmt::format("{:<18}{:>12}  {}\n", limit.name, limit.value, limit.meaning);
    }
    return text;
}

nlohmann::ordered_json limits_json(const io::ReadLimits& limits)
{
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (const Limit& limit : list(limits)) {
        json[std::string(limit.name)] = limit.value;
    }
    return json;
}

}  // namespace bdpt::app
