#pragma once

#include "file/bytes.h"
#include "file/json.h"
#include "file/load_context.h"
#include "gltf/document/prepass.h"
#include "gltf/document/tinygltf.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace bdpt::io {

/// Where the bytes of a picture or a light profile are: in a URI (a file or data), or in a buffer
/// view.
struct ImageSource {
    std::string uri;
    std::optional<std::size_t> buffer_view;
};

/// Name under which the indices of a primitive stand among its attributes: tinygltf refuses some
/// that are sound where they belong.
inline constexpr const char* indices_attribute = "INDICES";

/// A checked glTF document as structs.
struct GltfModel {
    tinygltf::Model structs;  ///< without images, skins and animations; see indices_attribute
    std::vector<ImageSource> images;
    std::vector<ImageSource> light_profiles;  ///< of EXT_lights_ies
    Json environments;                        ///< the array "lights" of EXT_lights_image_based
    Json motion;  ///< an object with the arrays "skins" and "animations" of the document
};

/// The bytes of a file, of data, or of a view. Throws `Error`: not_found for a file that is
/// missing, invalid_input when it is larger than `limit` bytes, or the source says nothing.
[[nodiscard]] Bytes read_source(const GltfModel& model, const ImageSource& source,
                                std::uint64_t limit, const LoadContext& context);

/// Throws `Error` (invalid_input) for what the checks before let through and tinygltf does not.
[[nodiscard]] GltfModel build_model(CheckedGltf checked);

}  // namespace bdpt::io
