#pragma once

#include "file/json.h"
#include "file/load_context.h"

namespace bdpt::io {

/// Checks the types, lengths and indices of all properties that the loader reads [glTF 2.0, sec.
/// 5], so that none is silently replaced by its default. Throws `Error` (invalid_input); warns of
/// textures that are broken but not used.
void check_schema(const JsonPlace& root, LoadContext& context);

}  // namespace bdpt::io
