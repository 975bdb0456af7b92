#include "part/part_contents.h"

#include <bdpt/error.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace bdpt::io {
namespace {

constexpr std::string_view seal_name = "bdpt part, v. 1.";
constexpr std::size_t seal_size = seal_name.size() + 3 * sizeof(std::uint64_t);
constexpr std::size_t block_size = std::size_t{1} << 20;

using Seal = std::array<char, seal_size>;

/// Writes a number in little-endian order.
void put(Seal& seal, std::size_t place, std::uint64_t number)
{
    for (std::size_t i = 0; i < 8; ++i) {
        seal[place + i] = static_cast<char>(number >> (8 * i));
    }
}

Seal make_seal(std::uint64_t size, const ContentHash& hash)
{
    Seal seal{};
    std::copy(seal_name.begin(), seal_name.end(), seal.begin());
    put(seal, seal_name.size(), size);
    put(seal, seal_name.size() + 8, hash.low);
    put(seal, seal_name.size() + 16, hash.high);
    return seal;
}

template <typename File>
ContentHash hash_file(const File& file, std::uint64_t size)
{
    ContentHasher hasher;
    std::vector<char> block(static_cast<std::size_t>(std::min<std::uint64_t>(block_size, size)));
    for (std::uint64_t done = 0; done < size; done += block_size) {
        const std::size_t count =
            static_cast<std::size_t>(std::min<std::uint64_t>(block_size, size - done));
        file.read(done, {block.data(), count});
        hasher.add(block.data(), count);
    }
    return hasher.hash();
}

}  // namespace

SealedFile::SealedFile(const std::filesystem::path& file)
{
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0) {
        throw Error(ErrorCode::not_found,
                    errno == ENOENT ? "no such file"
                                    : "cannot be read: " + std::generic_category().message(errno));
    }
    // Reading a pipe or a device could wait for ever.
    if (!S_ISREG(status.st_mode)) {
        throw Error(ErrorCode::not_found, "cannot be read: not a regular file");
    }
    descriptor_ = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_ < 0 || ::fstat(descriptor_, &status) != 0) {
        const int reason = errno;
        ::close(descriptor_);
        throw Error(ErrorCode::not_found,
                    "cannot be read: " + std::generic_category().message(reason));
    }
    size_ = static_cast<std::uint64_t>(status.st_size);
    try {
        check();
    } catch (...) {
        ::close(descriptor_);
        throw;
    }
}

SealedFile::~SealedFile()
{
    ::close(descriptor_);
}

void SealedFile::check()
{
    const auto fail = [] {
        throw Error(ErrorCode::invalid_input,
                    "is not a part of a render, or was cut off or changed");
    };
    if (size_ < seal_size) {
        fail();
    }
    size_ -= seal_size;
    Seal found{};
    read(size_, found);
    if (!std::equal(seal_name.begin(), seal_name.end(), found.begin())) {
        fail();  // before all of a large file is read
    }
    hash_ = hash_file(*this, size_);
    if (found != make_seal(size_, hash_)) {
        fail();
    }
}

void SealedFile::read(std::uint64_t position, std::span<char> bytes) const
{
    while (!bytes.empty()) {
        const ssize_t count =
            ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(position));
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count < 0) {
            throw Error(ErrorCode::not_found,
                        "cannot be read: " + std::generic_category().message(errno));
        }
        if (count == 0) {
            throw Error(ErrorCode::invalid_input, "the file is truncated");
        }
        position += static_cast<std::uint64_t>(count);
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
}

void seal(OutputFile& file, std::uint64_t size)
{
    const Seal seal = make_seal(size, hash_file(file, size));
    file.seek(size);
    file.write(seal);
}

}  // namespace bdpt::io
