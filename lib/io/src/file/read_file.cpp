#include "file/read_file.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <system_error>

namespace bdpt::io {

Bytes read_file(const std::filesystem::path& file, std::uint64_t limit, std::uint64_t most)
{
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(file, error);
    if (status.type() == std::filesystem::file_type::not_found) {
        throw Error(ErrorCode::not_found, "no such file");
    }
    // Reading a pipe or a device could wait for ever.
    if (!std::filesystem::is_regular_file(status)) {
        throw Error(ErrorCode::not_found, "cannot be read: not a regular file");
    }
    const std::uint64_t whole = std::filesystem::file_size(file, error);
    if (error) {
        throw Error(ErrorCode::not_found, "cannot be read: " + error.message());
    }
    if (whole > limit) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("{} bytes, but the limit is {}", whole, limit));
    }
    const std::uint64_t size = std::min(whole, most);
    errno = 0;
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        throw Error(ErrorCode::not_found,
                    "cannot be read: " + std::generic_category().message(errno));
    }
    Bytes bytes(static_cast<std::size_t>(size));
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    if (static_cast<std::uint64_t>(stream.gcount()) != size) {
        throw Error(ErrorCode::not_found, fmt::format("cannot be read: ends after {} of {} bytes",
                                                      stream.gcount(), size));
    }
    return bytes;
}

std::string human_bytes(long double bytes)
{
    static constexpr std::array units{"B", "kB", "MB", "GB", "TB", "PB", "EB", "ZB", "YB"};
    std::size_t unit = 0;
    while (bytes >= 1000.0L && unit + 1 < units.size()) {
        bytes /= 1000.0L;
        ++unit;
    }
    return fmt::format("{:.3g} {}", static_cast<double>(bytes), units[unit]);
}

}  // namespace bdpt::io
