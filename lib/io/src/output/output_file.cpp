#include <bdpt/io/output_file.h>

#include <bdpt/error.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <string>
#include <system_error>

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

int create(const fs::path& temporary)
{
    constexpr int flags = O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC;
    constexpr mode_t mode = 0666;  // less the umask, as for any new file
    const int descriptor = ::open(temporary.c_str(), flags, mode);
    if (descriptor >= 0 || errno != EEXIST) {
        return descriptor;
    }
    // Left over by a process that had our id and was killed.
    ::unlink(temporary.c_str());
    return ::open(temporary.c_str(), flags, mode);
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

/// While it lives, a write beyond the process' limit of file sizes (ulimit -f) fails with EFBIG
/// instead of ending the process. Of the calling thread only, so that the host's handling of the
/// signal stays as it is.
class SizeSignalBlock {
public:
    SizeSignalBlock()
    {
        ::sigemptyset(&signal_);
        ::sigaddset(&signal_, SIGXFSZ);
        sigset_t pending;
        ::sigpending(&pending);
        was_pending_ = ::sigismember(&pending, SIGXFSZ) == 1;
        ::pthread_sigmask(SIG_BLOCK, &signal_, &before_);
    }
    ~SizeSignalBlock()
    {
        const timespec no_time{};
        while (!was_pending_ && ::sigtimedwait(&signal_, nullptr, &no_time) < 0 && errno == EINTR) {
        }
        ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }
    SizeSignalBlock(const SizeSignalBlock&) = delete;
    SizeSignalBlock& operator=(const SizeSignalBlock&) = delete;

private:
    sigset_t signal_{};
    sigset_t before_{};
    bool was_pending_ = false;
};

}  // namespace

fs::path OutputFile::temporary_path(const fs::path& file)
{
    fs::path temporary = resolve_link(file);
    temporary += fmt::format(".tmp-{}", ::getpid());
    return temporary;
}

OutputFile::OutputFile(const fs::path& file)
    : name_(file), target_(resolve_link(file)), temporary_(temporary_path(file))
{
    check_target(name_, target_);
    descriptor_ = create(temporary_);
    if (descriptor_ < 0) {
        fail(name_, reason_of(errno));
    }
}

OutputFile::~OutputFile()
{
    if (descriptor_ >= 0) {
        ::close(descriptor_);
        ::unlink(temporary_.c_str());
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
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
}

void OutputFile::commit()
{
    if (first_error_ != 0) {
        fail(name_, reason_of(first_error_));
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
