#pragma once

#include "file/json.h"

namespace bdpt::io {

/// Checks the types, lengths and indices of all properties that the loader reads [glTF 2.0,
/// sec. 5], so that none is silently taken for its default. Throws `Error` (invalid_input).
void check_schema(const JsonPlace& root);

}  // namespace bdpt::io
