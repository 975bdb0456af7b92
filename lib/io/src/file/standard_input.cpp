#include "file/standard_input.h"

#include "file/read_file.h"

#include <bdpt/error.h>

#include <unistd.h>

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <mutex>
#include <system_error>

namespace bdpt::io {
namespace {

/// Appends what is left, but not more than makes it longer than `limit`.
void read_rest(Bytes& bytes, std::uint64_t limit)
{
    std::array<std::uint8_t, 65536> block{};
    while (bytes.size() <= limit) {
        const ssize_t count = ::read(STDIN_FILENO, block.data(), block.size());
        if (count == 0) {
            return;
        }
        if (count < 0 && errno != EINTR) {
            throw Error(ErrorCode::not_found,
                        "standard input cannot be read: " + std::generic_category().message(errno));
        }
        if (count > 0) {
            bytes.insert(bytes.end(), block.begin(), block.begin() + count);
        }
    }
}

Bytes standard_input(std::uint64_t limit)
{
    static std::mutex mutex;
    static Bytes all;
    const std::lock_guard lock(mutex);
    if (::isatty(STDIN_FILENO) != 0) {
        throw Error(ErrorCode::not_found, "standard input is a terminal: nothing comes from it");
    }
    read_rest(all, limit);
    if (all.size() > limit) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("standard input has more than {} bytes, the limit", limit));
    }
    return all;
}

}  // namespace

Bytes read_named(const std::filesystem::path& file, std::uint64_t limit)
{
    return file == "-" ? standard_input(limit) : read_file(file, limit);
}

}  // namespace bdpt::io
