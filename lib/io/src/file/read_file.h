#pragma once

#include <bdpt/io/read_limits.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace bdpt::io {

using Bytes = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;

/// Tests whether the bytes from `offset` on begin with `magic`.
[[nodiscard]] bool begins_with(ByteView bytes, std::string_view magic, std::size_t offset = 0);

/// Reads a regular file, or its first `most` bytes. Throws `Error`: not_found if it is missing, not
/// a regular file or unreadable, invalid_input if it is larger than `limit` bytes. Messages do not
/// name the file. Throws as `memory` does if that does not have the bytes.
[[nodiscard]] Bytes read_file(const std::filesystem::path& file, std::uint64_t limit,
                              std::uint64_t most = std::numeric_limits<std::uint64_t>::max(),
                              const MemoryBudget* memory = nullptr);

/// Passes all of a regular file to `visit` in blocks, so that it is never in memory as a whole.
/// Throws `Error` as `read_file`.
void for_each_block(const std::filesystem::path& file, std::uint64_t limit,
                    const std::function<void(ByteView)>& visit);

/// Formats a number of bytes for people, such as "48 TB".
[[nodiscard]] std::string human_bytes(long double bytes);

/// Returns how many bytes of a stream that starts with these are worth reading.
using WorthReading = std::function<std::uint64_t(ByteView start)>;

/// Reads an input named by the caller: a file like `read_file`, or all of the standard input, "-",
/// which is read once and kept, so that it can be requested again. URIs in files are not read by
/// this function: "-" is a file for them. Throws `Error` as `read_file`, also not_found if the
/// standard input is a terminal. An endless standard input is read no further than `worth` says.
[[nodiscard]] Bytes read_named(const std::filesystem::path& file, std::uint64_t limit,
                               const WorthReading& worth = {},
                               const MemoryBudget* memory = nullptr);

/// Names the kind of a file that should be JSON but is not, with an article ("a PNG image", "an
/// empty file"), by its first bytes; none if it may be JSON or is of no known kind.
[[nodiscard]] std::optional<std::string_view> other_kind(ByteView file);

/// Names the kind of a file that should be glTF but is not, also by its extension ("an STL file"),
/// and what to do with models of other formats; none if it may be JSON.
[[nodiscard]] std::optional<std::string> kind_instead_of_gltf(ByteView bytes,
                                                              const std::filesystem::path& file);

/// Returns the folder of the library or program that contains this code; empty where the system
/// does not tell.
[[nodiscard]] std::filesystem::path own_folder();

/// Returns the path of a file installed beside this library, such as a module or a program that is
/// started on demand. Throws `Error` (unsupported) that names the searched places if it is at none
/// of them.
[[nodiscard]] std::filesystem::path companion_file(std::string_view name);

/// Returns the path of such a file; none if it is at none of these places.
[[nodiscard]] std::optional<std::filesystem::path> find_companion(std::string_view name);

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
