#pragma once

#include "file/bytes.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace bdpt::io {

/// Whether `uri` carries its data in itself [RFC 2397].
[[nodiscard]] bool is_data_uri(std::string_view uri);

/// What a data URI holds, in base64 or percent-encoded. Throws `Error` (invalid_input) when it is
/// malformed or holds more than `limit` bytes.
[[nodiscard]] Bytes decode_data_uri(std::string_view uri, std::uint64_t limit);

/// Replaces %XX [RFC 3986, sec. 2.1]; a % that no two hexadecimal digits follow stays as it is.
[[nodiscard]] std::string percent_decode(std::string_view text);

/// The file that a relative `uri` of a scene in `folder` names. The file need not exist. Throws
/// `Error` (invalid_input) for absolute URIs, URIs with a scheme, and everything that leaves
/// `folder`, be it by ".." or by a symbolic link.
[[nodiscard]] std::filesystem::path resolve_uri(const std::filesystem::path& folder,
                                                std::string_view uri);

/// A URI as it may stand in a message: short and without control characters.
[[nodiscard]] std::string quote(std::string_view text);

}  // namespace bdpt::io
