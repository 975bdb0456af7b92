#include "scene_files.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace bdpt::test {
namespace {

/// Counter-clockwise from outside; vertex i is at x = bit 0, y = bit 1, z = bit 2.
constexpr std::array<std::uint16_t, 36> cube_indices{
    0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6,  // z
    0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7,  // y
    0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5,  // x
};

template <typename T>
void append(std::string& bytes, const T& value)
{
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), &value, sizeof(T));
    bytes.append(raw.data(), raw.size());
}

std::string cube_bytes(bool inside_out)
{
    std::string bytes;
    for (unsigned vertex = 0; vertex < 8; ++vertex) {
        for (unsigned axis = 0; axis < 3; ++axis) {
            append(bytes, (vertex >> axis & 1u) != 0 ? 1.0f : -1.0f);
        }
    }
    for (std::size_t i = 0; i < cube_indices.size(); i += 3) {
        append(bytes, cube_indices[i]);
        append(bytes, cube_indices[i + (inside_out ? 2 : 1)]);
        append(bytes, cube_indices[i + (inside_out ? 1 : 2)]);
    }
    return bytes;
}

constexpr std::string_view fixed_members = R"(
  "scene": 0,
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3",
     "min": [-1, -1, -1], "max": [1, 1, 1]},
    {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}],
  "bufferViews": [
    {"buffer": 0, "byteOffset": 0, "byteLength": 96, "target": 34962},
    {"buffer": 0, "byteOffset": 96, "byteLength": 72, "target": 34963}],
)";

}  // namespace

CubeFile shining_room()
{
    return {.material = R"({"pbrMetallicRoughness": {"metallicFactor": 0,
                "baseColorFactor": [0.5, 0.4, 0.3, 1]}, "emissiveFactor": [1, 1, 1]})",
            .cameras = R"({"camera": 0, "translation": [0, 0, 0.9]}, {"camera": 1},)",
            .inside_out = true};
}

std::filesystem::path write_cube(const ScratchFolder& folder, const std::string& name,
                                 const CubeFile& cube)
{
    std::string json = R"({"asset": {"version": "2.0", "generator": "bdpt tests"},)";
    json += cube.more;
    json += fixed_members;
    const bool cameras = !cube.cameras.empty();
    json += cameras ? "\"cameras\": [" + cube.camera_kinds + "],\n" : "";
    json += R"("scenes": [{"name": "main", "nodes": )";
    json += "[0";
    for (int node = 1; cameras && node <= cube.camera_nodes; ++node) {
        json += ", " + std::to_string(node);
    }
    json += "]}],";
    json += "\n\"materials\": [" + cube.material + "],\n\"nodes\": [";
    json += cameras ? cube.cameras : "";
    json += R"({"name": "cube", "mesh": 0}],)";
    json += "\n\"buffers\": [{\"byteLength\": 168, \"uri\": \"" + name + ".bin\"}]}\n";

    write_text(folder / (name + ".bin"), cube_bytes(cube.inside_out));
    const std::filesystem::path file = folder / (name + ".gltf");
    write_text(file, json);
    return file;
}

}  // namespace bdpt::test
