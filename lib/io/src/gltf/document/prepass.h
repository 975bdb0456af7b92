#pragma once

#include "file/bytes.h"
#include "file/json.h"
#include "file/load_context.h"

#include <bdpt/io/gltf.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

namespace bdpt::io {

/// A glTF document that has passed all checks which need no vertex data.
struct CheckedGltf {
    Json document;
    std::vector<Bytes> buffers;  ///< each at least as long as its `byteLength`
    std::vector<ExtensionUse> extensions;
    std::vector<std::filesystem::path> files;  ///< named by its URIs, used or not
};

/// Reads and checks a document and its buffers before any other code sees it. Throws `Error`; the
/// message lacks the file's path.
[[nodiscard]] CheckedGltf read_checked_gltf(const std::filesystem::path& file,
                                            LoadContext& context);

/// Returns the files that the URIs of a document name, used or not. Throws `Error` for those that
/// lead out of its folders.
[[nodiscard]] std::vector<std::filesystem::path> checked_uris(const JsonPlace& root,
                                                              LoadContext& context);

}  // namespace bdpt::io
