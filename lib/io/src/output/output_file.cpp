#include <bdpt/io/output_file.h>

#include "output/size_signal_block.h"
#include "output/temporary_file.h"

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
#include <string>
#include <system_error>
#include <utility>

namespace bdpt::io {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& name, const std::string& reason)
{
    throw Error(ErrorCode::output, fmt::format("{}: cannot write: {}", name.string(), reason));
}

std::string reason_of(int error_number)
{
    return std::generic_category().message(error_number);
}

bool is_standard_output(const fs::path& file)
{
    return file == "-";
}

fs::path resolve_link(const fs::path& file)
{
    std::error_code ignored;
    if (!fs::is_symlink(file, ignored)) {
        return file;
    }
    const fs::path target = fs::weakly_canonical(file, ignored);
    return target.empty() ? file : target;
}

void check_target(const fs::path& name, const fs::path& target)
{
    if (!target.has_filename()) {
        fail(name, "this names no file");
    }
    std::error_code ignored;
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    if (!fs::exists(folder, ignored)) {
        fail(name, fmt::format("there is no folder \"{}\"", folder.string()));
    }
    if (fs::is_directory(target, ignored)) {
        fail(name, "this is a folder");
    }
    if (fs::exists(target, ignored) && ::access(target.c_str(), W_OK) != 0) {
        fail(name, reason_of(errno));
    }
}

/// So that the new name survives a power cut too. File systems that cannot do it need not.
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
    if (is_standard_output(file)) {
        return {};
    }
    fs::path temporary = resolve_link(file);
    temporary += ".tmp-" + process_name();
    return temporary;
}

OutputFile::OutputFile(const fs::path& file) : name_(file)
{
    if (is_standard_output(file)) {
        name_ = "standard output";
        if (::isatty(STDOUT_FILENO) != 0) {
            fail(name_, "this is a terminal");
        }
        descriptor_ = ::memfd_create("bdpt output", MFD_CLOEXEC);
        if (descriptor_ < 0) {
            fail(name_, reason_of(errno));
        }
        return;
    }
    target_ = resolve_link(file);
    check_target(name_, target_);
    TemporaryFile created = create_temporary(temporary_path(file));
    descriptor_ = created.descriptor;
    temporary_ = std::move(created.path);
    if (descriptor_ < 0) {
        fail(name_, reason_of(errno));
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
            fail(name_, reason_of(error_number));
        }
        position_ += static_cast<std::uint64_t>(count);
        size_ = std::max(size_, position_);
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
}

void OutputFile::copy_to_standard_output() const
{
    const SizeSignalBlock no_signal;
    std::array<char, 65536> block{};
    for (std::uint64_t done = 0; done < size_;) {
        const auto length = std::min<std::uint64_t>(block.size(), size_ - done);
        const std::span<char> bytes(block.data(), static_cast<std::size_t>(length));
        read(done, bytes);
        for (std::size_t written = 0; written < bytes.size();) {
            const ssize_t count =
                ::write(STDOUT_FILENO, bytes.data() + written, bytes.size() - written);
            if (count < 0 && errno != EINTR) {
                fail(name_, reason_of(errno));
            }
            written += count > 0 ? static_cast<std::size_t>(count) : 0;
        }
        done += length;
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
            fail(name_, count < 0 ? reason_of(errno) : "what was written is not there");
        }
        position += static_cast<std::uint64_t>(count);
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
}

void OutputFile::commit()
{
    if (first_error_ != 0) {
        fail(name_, reason_of(first_error_));
    }
    if (temporary_.empty()) {
        copy_to_standard_output();
        return;
    }
    // EINVAL: a file system that has nothing to bring to a disk.
    if (::fsync(descriptor_) != 0 && errno != EINVAL) {
        fail(name_, reason_of(errno));
    }
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) {
        fail(name_, reason_of(errno));
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
