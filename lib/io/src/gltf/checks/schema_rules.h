#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace bdpt::io {

/// Types of properties. A `count` fits in 64 bits, a `code` in an `int`.
enum class Kind : std::uint8_t {
    object,
    array,
    string,
    boolean,
    number,
    count,
    code,
    numbers,
    index
};

/// Rule for one property: its path, where * stands for all elements of an array and {} for all
/// members of an object; its type; for `index` the array that it indexes; for `numbers` their count
/// (0: any). A `!` marks a required property. All that a path passes must be objects and arrays.
struct SchemaRule {
    std::string_view path;
    Kind kind = Kind::object;
    std::string_view target = {};
    std::size_t length = 0;
};

/// Rules for the references of textures. Files have unused textures whose images were removed,
/// which is harmless.
inline constexpr std::array texture_rules{
    SchemaRule{"source", Kind::index, "images"},
    SchemaRule{"sampler", Kind::index, "samplers"},
    SchemaRule{"extensions/EXT_texture_webp/source", Kind::index, "images"},
    SchemaRule{"extensions/KHR_texture_basisu/source", Kind::index, "images"},
};

inline constexpr std::array schema_rules{
    SchemaRule{"asset!/version!", Kind::string},
    SchemaRule{"extensionsUsed", Kind::array},
    SchemaRule{"extensionsRequired", Kind::array},
    // Arrays come first, as indices are checked against their sizes.
    SchemaRule{"scenes", Kind::array},
    SchemaRule{"nodes", Kind::array},
    SchemaRule{"meshes", Kind::array},
    SchemaRule{"accessors", Kind::array},
    SchemaRule{"bufferViews", Kind::array},
    SchemaRule{"buffers", Kind::array},
    SchemaRule{"images", Kind::array},
    SchemaRule{"cameras", Kind::array},
    SchemaRule{"skins", Kind::array},
    SchemaRule{"animations", Kind::array},
    SchemaRule{"materials", Kind::array},
    SchemaRule{"extensions/KHR_lights_punctual/lights", Kind::array},
    SchemaRule{"extensions/EXT_lights_ies/lights", Kind::array},
    SchemaRule{"extensions/EXT_lights_image_based/lights", Kind::array},
    SchemaRule{"extensions/KHR_materials_variants/variants", Kind::array},
    SchemaRule{"extensions/KHR_materials_variants/variants/*", Kind::object},
    SchemaRule{"scene", Kind::index, "scenes"},
    SchemaRule{"scenes/*/nodes/*", Kind::index, "nodes"},
    SchemaRule{"scenes/*/extensions/EXT_lights_image_based/light!", Kind::index,
               "extensions/EXT_lights_image_based/lights"},
    SchemaRule{"nodes/*/children/*", Kind::index, "nodes"},
    SchemaRule{"nodes/*/mesh", Kind::index, "meshes"},
    SchemaRule{"nodes/*/camera", Kind::index, "cameras"},
    SchemaRule{"nodes/*/skin", Kind::index, "skins"},
    SchemaRule{"nodes/*/matrix", Kind::numbers, "", 16},
    SchemaRule{"nodes/*/translation", Kind::numbers, "", 3},
    SchemaRule{"nodes/*/rotation", Kind::numbers, "", 4},
    SchemaRule{"nodes/*/scale", Kind::numbers, "", 3},
    SchemaRule{"nodes/*/extensions/KHR_lights_punctual/light!", Kind::index,
               "extensions/KHR_lights_punctual/lights"},
    SchemaRule{"nodes/*/extensions/EXT_lights_ies/light!", Kind::index,
               "extensions/EXT_lights_ies/lights"},
    SchemaRule{"nodes/*/extensions/EXT_lights_ies/multiplier", Kind::number},
    SchemaRule{"nodes/*/extensions/EXT_lights_ies/color", Kind::numbers, "", 3},
    SchemaRule{"nodes/*/weights", Kind::numbers},
    SchemaRule{"nodes/*/extensions/KHR_node_visibility/visible", Kind::boolean},
    SchemaRule{"nodes/*/extensions/EXT_mesh_gpu_instancing/attributes!/{}", Kind::index,
               "accessors"},
    SchemaRule{"skins/*/joints!/*", Kind::index, "nodes"},
    SchemaRule{"skins/*/inverseBindMatrices", Kind::index, "accessors"},
    // Required members are checked when the animation plays.
    SchemaRule{"animations/*/channels/*/sampler", Kind::count},
    SchemaRule{"animations/*/channels/*/target/node", Kind::index, "nodes"},
    SchemaRule{"animations/*/samplers/*/input", Kind::index, "accessors"},
    SchemaRule{"animations/*/samplers/*/output", Kind::index, "accessors"},
    SchemaRule{"meshes/*/weights", Kind::numbers},
    SchemaRule{"meshes/*/primitives!/*/attributes!/{}", Kind::index, "accessors"},
    SchemaRule{"meshes/*/primitives/*/indices", Kind::index, "accessors"},
    SchemaRule{"meshes/*/primitives/*/material", Kind::index, "materials"},
    SchemaRule{"meshes/*/primitives/*/mode", Kind::code},
    SchemaRule{"meshes/*/primitives/*/targets/*/{}", Kind::index, "accessors"},
    SchemaRule{"meshes/*/primitives/*/extensions/KHR_materials_variants/mappings/*/material!",
               Kind::index, "materials"},
    SchemaRule{"meshes/*/primitives/*/extensions/KHR_materials_variants/mappings/*/variants!/*",
               Kind::index, "extensions/KHR_materials_variants/variants"},
    SchemaRule{"meshes/*/primitives/*/extensions/KHR_draco_mesh_compression/bufferView!",
               Kind::index, "bufferViews"},
    SchemaRule{"meshes/*/primitives/*/extensions/KHR_draco_mesh_compression/attributes!/{}",
               Kind::count},
    SchemaRule{"accessors/*/bufferView", Kind::index, "bufferViews"},
    SchemaRule{"accessors/*/byteOffset", Kind::count},
    SchemaRule{"accessors/*/componentType!", Kind::code},
    SchemaRule{"accessors/*/count!", Kind::count},
    SchemaRule{"accessors/*/type!", Kind::string},
    SchemaRule{"accessors/*/normalized", Kind::boolean},
    SchemaRule{"accessors/*/sparse/count!", Kind::count},
    SchemaRule{"accessors/*/sparse/indices!/bufferView!", Kind::index, "bufferViews"},
    SchemaRule{"accessors/*/sparse/indices/byteOffset", Kind::count},
    SchemaRule{"accessors/*/sparse/indices/componentType!", Kind::code},
    SchemaRule{"accessors/*/sparse/values!/bufferView!", Kind::index, "bufferViews"},
    SchemaRule{"accessors/*/sparse/values/byteOffset", Kind::count},
    SchemaRule{"bufferViews/*/buffer!", Kind::index, "buffers"},
    SchemaRule{"bufferViews/*/byteOffset", Kind::count},
    SchemaRule{"bufferViews/*/byteLength!", Kind::count},
    SchemaRule{"bufferViews/*/byteStride", Kind::count},
    SchemaRule{"bufferViews/*/extensions/EXT_meshopt_compression/buffer!", Kind::index, "buffers"},
    SchemaRule{"bufferViews/*/extensions/EXT_meshopt_compression/byteOffset", Kind::count},
    SchemaRule{"bufferViews/*/extensions/EXT_meshopt_compression/byteLength!", Kind::count},
    SchemaRule{"bufferViews/*/extensions/EXT_meshopt_compression/byteStride!", Kind::count},
    SchemaRule{"bufferViews/*/extensions/EXT_meshopt_compression/count!", Kind::count},
    SchemaRule{"bufferViews/*/extensions/EXT_meshopt_compression/mode!", Kind::string},
    SchemaRule{"bufferViews/*/extensions/EXT_meshopt_compression/filter", Kind::string},
    SchemaRule{"bufferViews/*/extensions/KHR_meshopt_compression/buffer!", Kind::index, "buffers"},
    SchemaRule{"bufferViews/*/extensions/KHR_meshopt_compression/byteOffset", Kind::count},
    SchemaRule{"bufferViews/*/extensions/KHR_meshopt_compression/byteLength!", Kind::count},
    SchemaRule{"bufferViews/*/extensions/KHR_meshopt_compression/byteStride!", Kind::count},
    SchemaRule{"bufferViews/*/extensions/KHR_meshopt_compression/count!", Kind::count},
    SchemaRule{"bufferViews/*/extensions/KHR_meshopt_compression/mode!", Kind::string},
    SchemaRule{"bufferViews/*/extensions/KHR_meshopt_compression/filter", Kind::string},
    SchemaRule{"buffers/*/byteLength!", Kind::count},
    SchemaRule{"buffers/*/uri", Kind::string},
    SchemaRule{"images/*/uri", Kind::string},
    SchemaRule{"images/*/bufferView", Kind::index, "bufferViews"},
    SchemaRule{"samplers/*/wrapS", Kind::code},
    SchemaRule{"samplers/*/wrapT", Kind::code},
    SchemaRule{"textures/*/extensions/EXT_texture_webp", Kind::object},
    SchemaRule{"textures/*/extensions/KHR_texture_basisu", Kind::object},
    SchemaRule{"cameras/*/type!", Kind::string},
    SchemaRule{"cameras/*/perspective/yfov!", Kind::number},
    SchemaRule{"cameras/*/perspective/aspectRatio", Kind::number},
    SchemaRule{"cameras/*/orthographic/xmag!", Kind::number},
    SchemaRule{"cameras/*/orthographic/ymag!", Kind::number},
    SchemaRule{"extensions/KHR_lights_punctual/lights/*/type!", Kind::string},
    SchemaRule{"extensions/KHR_lights_punctual/lights/*/color", Kind::numbers, "", 3},
    SchemaRule{"extensions/KHR_lights_punctual/lights/*/intensity", Kind::number},
    SchemaRule{"extensions/KHR_lights_punctual/lights/*/range", Kind::number},
    SchemaRule{"extensions/KHR_lights_punctual/lights/*/spot/innerConeAngle", Kind::number},
    SchemaRule{"extensions/KHR_lights_punctual/lights/*/spot/outerConeAngle", Kind::number},
    SchemaRule{"extensions/EXT_lights_ies/lights/*/uri", Kind::string},
    SchemaRule{"extensions/EXT_lights_ies/lights/*/bufferView", Kind::index, "bufferViews"},
    SchemaRule{"extensions/EXT_lights_image_based/lights/*/rotation", Kind::numbers, "", 4},
    SchemaRule{"extensions/EXT_lights_image_based/lights/*/intensity", Kind::number},
    SchemaRule{"extensions/EXT_lights_image_based/lights/*/specularImages!/*/*", Kind::index,
               "images"},
    SchemaRule{"materials/*/alphaMode", Kind::string},
    SchemaRule{"materials/*/alphaCutoff", Kind::number},
    SchemaRule{"materials/*/doubleSided", Kind::boolean},
    SchemaRule{"materials/*/emissiveFactor", Kind::numbers, "", 3},
    SchemaRule{"materials/*/normalTexture/scale", Kind::number},
    SchemaRule{"materials/*/pbrMetallicRoughness/baseColorFactor", Kind::numbers, "", 4},
    SchemaRule{"materials/*/pbrMetallicRoughness/metallicFactor", Kind::number},
    SchemaRule{"materials/*/pbrMetallicRoughness/roughnessFactor", Kind::number},
    SchemaRule{"materials/*/extensions/{}", Kind::object},
};

}  // namespace bdpt::io
