#pragma once

#include "file/json.h"
#include "gltf/prepass.h"
#include "gltf/tinygltf.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace bdpt::io {

/// Where the bytes of a picture are: in a URI (a file or data), or in a buffer view.
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
    Json motion;  ///< an object with the arrays "skins" and "animations" of the document
    std::filesystem::path folder;
};

/// Throws `Error` (invalid_input) for what the checks before let through and tinygltf does not.
[[nodiscard]] GltfModel build_model(CheckedGltf checked);

}  // namespace bdpt::io
