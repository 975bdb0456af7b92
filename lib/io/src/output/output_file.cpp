#include <bdpt/io/output_file.h>

#include <bdpt/error.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstddef>
#include <random>
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

std::string host_name()
{
    std::array<char, 33> name{};  // the first 32 letters
    ::gethostname(name.data(), name.size() - 1);
    std::string result = name.data();
    std::replace_if(
        result.begin(), result.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return result;
}

/// Tells this process from all others that may write to the same folder. Its number does not:
/// processes of two containers, or of two machines, may have the same.
const std::string& process_name()
{
    static const std::string name = [] {
        std::random_device random;
        return fmt::format("{}-{}-{:08x}{:08x}", host_name(), ::getpid(), random(), random());
    }();
    return name;
}

struct Created {
    int descriptor = -1;
    fs::path path;
};

/// A new file, named `temporary`. It is there already if this process has another `OutputFile` for
/// the same target: then the name gets a number.
Created create(const fs::path& temporary)
{
    constexpr int flags = O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC;
    constexpr mode_t mode = 0666;  // less the umask, as for any new file
    constexpr int most_writers = 1000;
    Created result{.path = temporary};
    for (int i = 1; i <= most_writers; ++i) {
        result.descriptor = ::open(result.path.c_str(), flags, mode);
        if (result.descriptor >= 0 || errno != EEXIST) {
            break;
        }
        result.path = temporary;
        result.path += fmt::format("-{}", i);
    }
    return result;
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
    temporary += ".tmp-" + process_name();
    return temporary;
}

OutputFile::OutputFile(const fs::path& file) : name_(file), target_(resolve_link(file))
{
    check_target(name_, target_);
    Created created = create(temporary_path(file));
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
        size_ = std::max(size_, position_);
        bytes = bytes.subspan(static_cast<std::size_t>(count));
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
