#pragma once

#include "file/json.h"
#include "file/load_context.h"

#include <bdpt/io/gltf.h>

#include <string_view>
#include <vector>

namespace bdpt::io {

/// Returns the extensions that a document lists, whatever they are; entries that are no strings are
/// left out.
[[nodiscard]] std::vector<ExtensionUse> list_extensions(const JsonPlace& root);

/// Returns the extensions that a document lists. Throws `Error` (unsupported) for a required one
/// that is not supported; warns of used ones that are not.
[[nodiscard]] std::vector<ExtensionUse> check_extensions(const JsonPlace& root,
                                                         LoadContext& context);

}  // namespace bdpt::io
