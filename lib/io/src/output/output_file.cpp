#include <bdpt/io/output_file.h>

#include "output/output_target.h"

#include <bdpt/error.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <utility>

namespace bdpt::io {
namespace {

namespace fs = std::filesystem;

/// Syncs the folder, so that the new name survives a power failure. File systems without this are
/// accepted.
void sync_folder(const fs::path& target)
{
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor >= 0) {
        ::fsync(descriptor);
        ::close(descriptor);
    }
}

}  // namespace

fs::path OutputFile::temporary_path(const fs::path& file)
{
    return file == "-" ? fs::path() : temporary_name(follow_links(file));
}

OutputFile::OutputFile(const fs::path& file)
    : name_(file == "-" ? fs::path("standard output") : file)
{
    OutputTarget found = find_target(file);
    target_ = std::move(found.path);
    stream_ = found.descriptor;
    if (found.kind == TargetKind::file) {
        TemporaryFile created = create_temporary(temporary_name(target_), found.access);
        descriptor_ = created.descriptor;
        temporary_ = std::move(created.path);
    } else {
        descriptor_ = ::memfd_create("bdpt output", MFD_CLOEXEC);
    }
    if (descriptor_ < 0) {
        const int reason = errno;
        close_stream();
        refuse_output(name_, error_text(reason));
    }
}

OutputFile::~OutputFile()
{
    if (descriptor_ >= 0) {
        ::close(descriptor_);
        if (!temporary_.empty()) {
            ::unlink(temporary_.c_str());
        }
    }
    close_stream();
}

void OutputFile::close_stream()
{
    if (stream_ >= 0) {
        ::close(std::exchange(stream_, -1));
    }
}

void OutputFile::write(std::span<const char> bytes)
{
    const SizeSignalBlock no_signal;
    while (!bytes.empty()) {
        const ssize_t count =
            ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(position_));
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count <= 0) {
            const int error_number = count < 0 ? errno : ENOSPC;
            first_error_ = first_error_ != 0 ? first_error_ : error_number;
            refuse_output(name_, error_text(error_number));
        }
        position_ += static_cast<std::uint64_t>(count);
        size_ = std::max(size_, position_);
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
}

void OutputFile::send()
{
    const SizeSignalBlock no_signal;
    while (stream_ < 0) {
        stream_ = ::open(target_.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC);
        if (stream_ < 0 && errno != EINTR) {
            refuse_output(name_, error_text(errno));
        }
    }
    std::array<char, 65536> block{};
    for (std::uint64_t done = 0; done < size_;) {
        const auto length = std::min<std::uint64_t>(block.size(), size_ - done);
        const std::span<char> bytes(block.data(), static_cast<std::size_t>(length));
        read(done, bytes);
        for (std::size_t written = 0; written < bytes.size();) {
            const ssize_t count = ::write(stream_, bytes.data() + written, bytes.size() - written);
            if (count < 0 && errno != EINTR) {
                refuse_output(name_, error_text(errno));
            }
            written += count > 0 ? static_cast<std::size_t>(count) : 0;
        }
        done += length;
    }
    // Some file systems report a full disk only now.
    if (::close(std::exchange(stream_, -1)) != 0) {
        refuse_output(name_, error_text(errno));
    }
}

void OutputFile::read(std::uint64_t position, std::span<char> bytes) const
{
    while (!bytes.empty()) {
        const ssize_t count =
            ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(position));
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count <= 0) {
            refuse_output(name_,
                          count < 0 ? error_text(errno) : "the written data cannot be read back");
        }
        position += static_cast<std::uint64_t>(count);
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
}

void OutputFile::commit()
{
    if (first_error_ != 0) {
        refuse_output(name_, error_text(first_error_));
    }
    if (temporary_.empty()) {
        send();
        return;
    }
    // EINVAL: a file system without a disk to sync.
    if (::fsync(descriptor_) != 0 && errno != EINVAL) {
        refuse_output(name_, error_text(errno));
    }
    struct stat now {};
    if (::stat(target_.c_str(), &now) == 0 && !S_ISREG(now.st_mode)) {
        refuse_output(name_, "this is no longer a regular file");
    }
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) {
        refuse_output(name_, error_text(errno));
    }
    ::close(descriptor_);
    descriptor_ = -1;
    sync_folder(target_);
}

void check_writable(const fs::path& file)
{
    const OutputFile probe(file);
}

}  // namespace bdpt::io
