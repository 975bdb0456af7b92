#pragma once

#include "file/bytes.h"
#include "file/json.h"
#include "file/load_context.h"
#include "gltf/document/prepass.h"
#include "gltf/document/tinygltf.h"

#include <cstdint>
#include <string>
#include <vector>

namespace bdpt::io {

/// Where the bytes of a light profile are: in a URI (a file or data), or in a buffer view.
struct ProfileSource {
    std::string uri;
    int buffer_view = -1;  ///< -1: none
};

/// Name under which the indices of a primitive stand among its attributes: tinygltf refuses some
/// that are sound where they belong.
inline constexpr const char* indices_attribute = "INDICES";

/// A checked glTF document as the structs of tinygltf, but for the little that these lose: values
/// of extensions that are empty or beyond `int`, and channels of animations that lack something.
struct GltfModel {
    /// Images have their `uri` as the file has it, or their `bufferView`; nothing is decoded. See
    /// indices_attribute.
    tinygltf::Model structs;
    std::vector<ProfileSource> light_profiles;  ///< of EXT_lights_ies
    Json environments;                          ///< the array "lights" of EXT_lights_image_based
    Json motion;  ///< an object with the array "animations" of the document
};

/// The bytes of a file, of data, or, where there is no URI, of a view (-1: none). Throws `Error`:
/// not_found for a file that is missing, invalid_input when it is larger than `limit` bytes, or
/// neither is given.
[[nodiscard]] Bytes read_source(const tinygltf::Model& model, const std::string& uri,
                                int buffer_view, std::uint64_t limit, const LoadContext& context);

/// Throws `Error` (invalid_input) for what the checks before let through and tinygltf does not.
[[nodiscard]] GltfModel build_model(CheckedGltf checked);

}  // namespace bdpt::io
