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

/// Returns the images to compare with `reference`: `path` itself, or if it is a folder, all .exr
/// and .hdr files in it except the reference and hidden ones, sorted by name. Throws `Error`
/// (not_found) if the folder cannot be read or holds none.
[[nodiscard]] BDPT_EXPORT std::vector<std::filesystem::path> seed_files(
    const std::filesystem::path& path, const std::filesystem::path& reference);

}  // namespace bdpt::eval
