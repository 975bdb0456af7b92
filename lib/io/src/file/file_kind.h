#pragma once

#include "file/bytes.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace bdpt::io {

/// Names the kind of a file that should be JSON but is not, with an article ("a PNG image", "an
/// empty file"), by its first bytes; none if it may be JSON or is of no known kind.
[[nodiscard]] std::optional<std::string_view> other_kind(ByteView file);

/// Names the kind of a file that should be glTF but is not, also by its extension ("an STL file"),
/// and what to do with models of other formats; none if it may be JSON.
[[nodiscard]] std::optional<std::string> kind_instead_of_gltf(ByteView bytes,
                                                              const std::filesystem::path& file);

}  // namespace bdpt::io
