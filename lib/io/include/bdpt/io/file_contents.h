#pragma once

/// @file
/// Hashes the files of a scene, to tell whether one has changed.
///
/// @code{.cpp}
/// for (const bdpt::io::FileContent& file : bdpt::io::gltf_file_contents("room.gltf")) {
///     const std::string hash = file.hash ? bdpt::to_string(*file.hash) : "not readable";
///     std::cout << file.name << ": " << hash << '\n';
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/io/read_limits.h>
#include <bdpt/part/content_hash.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace bdpt::io {

/// Content hash of a file that a scene is read from.
struct FileContent {
    std::string name;  ///< file name of the scene; of other files the URI in the scene
    std::optional<ContentHash> hash;  ///< hash of all its bytes; none: it cannot be read
    [[nodiscard]] bool operator==(const FileContent&) const = default;
};

/// Hashes all bytes of `file`. Throws `Error`, whose message starts with the file's path: not_found
/// if it cannot be read, invalid_input if it is over a limit.
[[nodiscard]] BDPT_EXPORT ContentHash hash_of_file(const std::filesystem::path& file,
                                                   const ReadLimits& limits = {});

/// Hashes a .gltf or .glb file and then all files that it refers to, used or not, by name: buffers,
/// images and light profiles, also in the `allowed` folders (`GltfOptions::allowed_folders`). Equal
/// contents load as equal scenes, at any time of their animations. Throws `Error`, whose message
/// starts with the file's path: not_found, or invalid_input for a file that is no glTF document or
/// over a limit.
[[nodiscard]] BDPT_EXPORT std::vector<FileContent> gltf_file_contents(
    const std::filesystem::path& file, const ReadLimits& limits = {},
    const std::vector<std::filesystem::path>& allowed = {});

}  // namespace bdpt::io
