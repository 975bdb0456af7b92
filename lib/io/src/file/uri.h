#pragma once

#include "file/bytes.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bdpt::io {

/// Folders in which the files of a scene may be.
struct SceneFolders {
    std::filesystem::path own{};  ///< of the scene, to which URIs are relative; may be empty
    std::vector<std::filesystem::path> allowed{};  ///< others
};

/// Tests whether `uri` is a data URI [RFC 2397].
[[nodiscard]] bool is_data_uri(std::string_view uri);

/// Decodes a data URI in base64 or percent-encoding. Throws `Error` (invalid_input) if it is
/// malformed or holds more than `limit` bytes.
[[nodiscard]] Bytes decode_data_uri(std::string_view uri, std::uint64_t limit);

/// Replaces %XX [RFC 3986, sec. 2.1]; a % that is not followed by two hexadecimal digits is kept.
[[nodiscard]] std::string percent_decode(std::string_view text);

/// Throws `Error` (not_found) for the first of the allowed folders that is none.
void check_folders(const SceneFolders& folders);

/// Returns the file that a relative `uri` of a scene names, with symbolic links followed. The file
/// need not exist. A backslash is a slash if that leads to a file and the backslash does not.
/// Throws `Error` (invalid_input) for absolute URIs, URIs with a scheme, and everything outside
/// `folders`, reached by ".." or by a symbolic link.
[[nodiscard]] std::filesystem::path resolve_uri(const SceneFolders& folders, std::string_view uri);

/// Returns a URI for a message: short and without control characters.
[[nodiscard]] std::string quote(std::string_view text);

}  // namespace bdpt::io
