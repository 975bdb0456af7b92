#pragma once

/// @file
/// Finds the images of a folder that belong to a reference.
///
/// @code{.cpp}
/// for (const auto& file : bdpt::eval::seed_files("seeds", "seeds/reference.exr")) {
///     std::cout << file.filename().string() << '\n';
/// }
/// @endcode

#include <bdpt/export.h>

#include <filesystem>
#include <vector>

namespace bdpt::eval {

/// The images that are to be held against `reference`: `path` itself, or, when it is a folder,
/// all .exr and .hdr files in it but the reference and hidden ones, by name. Throws `Error`
/// (not_found) when the folder cannot be read or holds none.
[[nodiscard]] BDPT_EXPORT std::vector<std::filesystem::path> seed_files(
    const std::filesystem::path& path, const std::filesystem::path& reference);

}  // namespace bdpt::eval
