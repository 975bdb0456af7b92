#include "file/read_file.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <system_error>

namespace bdpt::io {

namespace {

/// A file read from its start.
class OpenFile {
public:
    OpenFile(const std::filesystem::path& file, std::uint64_t limit)
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
        size_ = std::filesystem::file_size(file, error);
        if (error) {
            throw Error(ErrorCode::not_found, "cannot be read: " + error.message());
        }
        if (size_ > limit) {
            throw Error(ErrorCode::invalid_input,
                        fmt::format("{} bytes, but the limit is {}", size_, limit));
        }
        errno = 0;
        stream_.open(file, std::ios::binary);
        if (!stream_) {
            throw Error(ErrorCode::not_found,
                        "cannot be read: " + std::generic_category().message(errno));
        }
    }

    [[nodiscard]] std::uint64_t size() const { return size_; }

    /// Reads the next `size` bytes.
    [[nodiscard]] Bytes read(std::uint64_t size)
    {
        Bytes bytes(static_cast<std::size_t>(size));
        stream_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
        done_ += static_cast<std::uint64_t>(stream_.gcount());
        if (static_cast<std::uint64_t>(stream_.gcount()) != size) {
            throw Error(ErrorCode::not_found,
                        fmt::format("cannot be read: ends after {} of {} bytes", done_, size_));
        }
        return bytes;
    }

private:
    std::ifstream stream_;
    std::uint64_t size_ = 0;
    std::uint64_t done_ = 0;
};

}  // namespace

Bytes read_file(const std::filesystem::path& file, std::uint64_t limit, std::uint64_t most,
                const MemoryBudget* memory)
{
    OpenFile open(file, limit);
    const std::uint64_t size = std::min(open.size(), most);
    if (memory != nullptr) {
        memory->check("the file", size);
    }
    return open.read(size);
}

void for_each_block(const std::filesystem::path& file, std::uint64_t limit,
                    const std::function<void(ByteView)>& visit)
{
    constexpr std::uint64_t block = std::uint64_t{1} << 20U;
    OpenFile open(file, limit);
    for (std::uint64_t left = open.size(); left > 0; left -= std::min(left, block)) {
        visit(open.read(std::min(left, block)));
    }
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
