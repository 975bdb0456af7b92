#pragma once

#include "file/json.h"
#include "file/load_context.h"

#include <cstddef>
#include <span>

namespace bdpt::io {

/// Checks that animations have all data needed to play them [glTF 2.0, sec. 5.5 to 5.8]; a channel
/// without a target needs no sampler. Warns of properties that are not animated. Relies on
/// check_schema. Throws `Error` (invalid_input).
void check_animations(const JsonPlace& root, std::span<const std::size_t> played,
                      LoadContext& context);

}  // namespace bdpt::io
