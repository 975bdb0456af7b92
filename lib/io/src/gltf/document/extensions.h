#pragma once

#include "file/json.h"
#include "file/load_context.h"

#include <bdpt/io/gltf.h>

#include <span>
#include <string_view>
#include <vector>

namespace bdpt::io {

/// What we make of one glTF extension.
struct ExtensionSupport {
    std::string_view name;
    ExtensionStatus status = ExtensionStatus::unknown;
    std::string_view note;  ///< what is lost, in a few words
};

/// All extensions that we know. The loader and the reports both go by this table.
[[nodiscard]] std::span<const ExtensionSupport> known_extensions();

/// The extensions that a document lists, whatever they are; what is no string is left out.
[[nodiscard]] std::vector<ExtensionUse> list_extensions(const JsonPlace& root);

/// The extensions that a document lists. Throws `Error` (unsupported) for a required one that is
/// not supported; warns of used ones that are not.
[[nodiscard]] std::vector<ExtensionUse> check_extensions(const JsonPlace& root,
                                                         LoadContext& context);

}  // namespace bdpt::io
