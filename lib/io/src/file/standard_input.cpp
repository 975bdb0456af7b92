#include "file/standard_input.h"

#include "file/read_file.h"

#include <bdpt/error.h>

#include <unistd.h>

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <mutex>
#include <optional>
#include <span>
#include <system_error>

namespace bdpt::io {
namespace {

constexpr std::uint64_t no_end = std::numeric_limits<std::uint64_t>::max();

/// Reads the next bytes, at most `block.size()`; returns 0 at the end.
std::size_t read_some(std::span<std::uint8_t> block)
{
    ssize_t count = -1;
    do {
        count = ::read(STDIN_FILENO, block.data(), block.size());
    } while (count < 0 && errno == EINTR);
    if (count < 0) {
        throw Error(ErrorCode::not_found,
                    "standard input cannot be read: " + std::generic_category().message(errno));
    }
    return static_cast<std::size_t>(count);
}

/// Reads all bytes, or as many as are worth reading.
Bytes read_all(std::uint64_t limit, const WorthReading& worth, const MemoryBudget* memory)
{
    constexpr std::size_t start_size = 4096;  // enough to recognize its kind
    Bytes bytes;
    std::array<std::uint8_t, 65536> block{};
    std::uint64_t end = no_end;
    bool judged = !worth;
    for (std::size_t count = read_some(block); count > 0; count = read_some(block)) {
        if (memory != nullptr && bytes.size() + count > bytes.capacity()) {
            // Growing copies it to twice the room.
            memory->check("standard input", 3 * bytes.size());
        }
        bytes.insert(bytes.end(), block.begin(),
                     block.begin() + static_cast<std::ptrdiff_t>(count));
        if (!judged && bytes.size() >= start_size) {
            end = worth(bytes);
            judged = true;
        }
        if (bytes.size() > limit) {
            throw Error(ErrorCode::invalid_input,
                        fmt::format("standard input has more than {} bytes, the limit", limit));
        }
        if (bytes.size() >= end) {
            break;
        }
    }
    return bytes;
}

Bytes standard_input(std::uint64_t limit, const WorthReading& worth, const MemoryBudget* memory)
{
    static std::mutex mutex;
    static std::optional<Bytes> all;
    const std::lock_guard lock(mutex);
    if (::isatty(STDIN_FILENO) != 0) {
        throw Error(ErrorCode::not_found, "standard input is a terminal, not a file or pipe");
    }
    if (!all) {
        all = read_all(limit, worth, memory);
    }
    return *all;
}

}  // namespace

Bytes read_named(const std::filesystem::path& file, std::uint64_t limit, const WorthReading& worth,
                 const MemoryBudget* memory)
{
    return file == "-" ? standard_input(limit, worth, memory)
                       : read_file(file, limit, no_end, memory);
}

}  // namespace bdpt::io
