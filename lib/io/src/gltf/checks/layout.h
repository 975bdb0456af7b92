#pragma once

#include "file/json.h"
#include "file/load_context.h"

#include <cstdint>
#include <string_view>

namespace bdpt::io {

/// Returns the size of one component [bytes]; 0 for a type that glTF does not have [glTF 2.0, sec.
/// 5.1.3].
[[nodiscard]] std::uint64_t component_size(std::uint64_t component_type);

/// Returns the number of components of an accessor's type; 0 for one that glTF does not have [glTF
/// 2.0, sec. 5.1.4].
[[nodiscard]] std::uint64_t component_count(std::string_view type);

/// Checks that views lie within their buffers, and accessors and their sparse parts within their
/// views, in arithmetic that cannot overflow. Relies on check_schema. Throws `Error`
/// (invalid_input).
void check_layout(const JsonPlace& root, LoadContext& context);

}  // namespace bdpt::io
