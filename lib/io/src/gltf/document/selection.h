#pragma once

#include "file/json.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace bdpt::io {

/// Returns the `name` of each element of `array`; empty if it has none. An array that is null or
/// missing has no elements.
[[nodiscard]] std::vector<std::string> names_in(const Json& array);

/// Returns the array at members `path` of `document`, or null.
[[nodiscard]] const Json& array_at(const Json& document, const Json::json_pointer& path);

/// Returns the index of the element named `wanted`, or else `wanted` as an index. Throws `Error`
/// (not_found) that lists the available `what` ("scene").
[[nodiscard]] std::size_t select(std::string_view what, const std::vector<std::string>& names,
                                 const std::string& wanted);

}  // namespace bdpt::io
