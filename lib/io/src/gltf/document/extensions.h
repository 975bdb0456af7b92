#pragma once

#include "file/json.h"
#include "file/load_context.h"

#include <bdpt/io/gltf.h>

#include <span>
#include <string_view>
#include <vector>

namespace bdpt::io {

/// Our support of one glTF extension.
struct ExtensionSupport {
    std::string_view name;
    ExtensionStatus status = ExtensionStatus::unknown;
    std::string_view note;  ///< the loss, in a few words
};

/// Returns all extensions that we know. The loader and the reports both use this table.
[[nodiscard]] std::span<const ExtensionSupport> known_extensions();

/// Returns the extensions that a document lists, whatever they are; entries that are no strings are
/// left out.
[[nodiscard]] std::vector<ExtensionUse> list_extensions(const JsonPlace& root);

/// Returns the extensions that a document lists. Throws `Error` (unsupported) for a required one
/// that is not supported; warns of used ones that are not.
[[nodiscard]] std::vector<ExtensionUse> check_extensions(const JsonPlace& root,
                                                         LoadContext& context);

}  // namespace bdpt::io
