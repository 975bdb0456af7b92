#pragma once

#include "file/bytes.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace bdpt::io {

/// What a file is that was expected to be JSON and is not, with its article ("a PNG image", "an
/// empty file"), by its first bytes; none if it may be JSON or is nothing known.
[[nodiscard]] std::optional<std::string_view> other_kind(ByteView file);

/// The same of a file that was expected to be glTF, also by the end of its name ("an STL file"),
/// and what to do with models of other formats.
[[nodiscard]] std::optional<std::string> kind_instead_of_gltf(ByteView bytes,
                                                              const std::filesystem::path& file);

}  // namespace bdpt::io
