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

/// The hash of a file that a scene is read from.
struct FileContent {
    std::string name;                 ///< that of the scene, else the URI that the scene has for it
    std::optional<ContentHash> hash;  ///< of all its bytes; none: it cannot be read
    [[nodiscard]] bool operator==(const FileContent&) const = default;
};

/// Of all bytes of `file`. Throws `Error`, whose message starts with the file's path: not_found
/// when it cannot be read, invalid_input when it is over a limit.
[[nodiscard]] BDPT_EXPORT ContentHash hash_of_file(const std::filesystem::path& file,
                                                   const ReadLimits& limits = {});

/// Of a .gltf or .glb file and then all files that it refers to, used or not, by their names: its
/// buffers, images and light profiles. Equal contents load as equal scenes, at any time of their
/// animations. Throws `Error`, whose message starts with the file's path: not_found, or
/// invalid_input for what is no glTF document or over a limit.
[[nodiscard]] BDPT_EXPORT std::vector<FileContent> gltf_file_contents(
    const std::filesystem::path& file, const ReadLimits& limits = {});

}  // namespace bdpt::io
