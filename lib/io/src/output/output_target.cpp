#include "output/output_target.h"

#include <bdpt/error.h>
#include <bdpt/io/output_file.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstddef>
#include <random>
#include <system_error>

namespace bdpt::io {

namespace {

namespace fs = std::filesystem;

fs::path find_folder(const fs::path& file)
{
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// Returns the descriptor of this process that `file` names, such as /dev/fd/N and /dev/stdout.
std::optional<int> own_descriptor(const fs::path& file)
{
    const std::string name = file.filename().string();
    constexpr std::size_t max_digits = 9;
    if (name.empty() || name.size() > max_digits ||
        !std::all_of(name.begin(), name.end(),
                     [](unsigned char c) { return std::isdigit(c) != 0; })) {
        return std::nullopt;
    }
    std::error_code missing;
    const std::string folder = fs::canonical(find_folder(file), missing).string();
    const std::string process = fmt::format("/proc/{}/", ::getpid());
    const bool lists_descriptors =
        folder == process + "fd" ||
        (folder.starts_with(process + "task/") && folder.ends_with("/fd"));
    return !missing && lists_descriptors ? std::optional(std::stoi(name)) : std::nullopt;
}

/// Returns a copy of `descriptor`, if it is writable.
int writable_copy(const fs::path& name, int descriptor)
{
    const int flags = ::fcntl(descriptor, F_GETFL);
    if (flags < 0) {
        refuse_output(name, error_text(errno));
    }
    if ((flags & O_ACCMODE) == O_RDONLY) {
        refuse_output(name, "it is closed or read-only");
    }
    if (::isatty(descriptor) != 0) {
        refuse_output(name, "this is a terminal");
    }
    const int copy = ::fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    if (copy < 0) {
        refuse_output(name, error_text(errno));
    }
    return copy;
}

/// Opens a device. This is done at once, as only then it is known not to be a terminal.
int open_device(const fs::path& name, const fs::path& path)
{
    // A serial line would wait for the other end.
    const int device = ::open(path.c_str(), O_WRONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (device < 0) {
        refuse_output(name, error_text(errno));
    }
    if (::isatty(device) != 0) {
        ::close(device);
        refuse_output(name, "this is a terminal");
    }
    ::fcntl(device, F_SETFL, O_WRONLY);
    return device;
}

/// Returns the target for a path that is no regular file.
OutputTarget special_target(const fs::path& name, const fs::path& path, mode_t mode)
{
    if (S_ISDIR(mode)) {
        refuse_output(name, "this is a folder");
    }
    if (S_ISCHR(mode)) {
        return {
            .kind = TargetKind::descriptor, .path = path, .descriptor = open_device(name, path)};
    }
    if (S_ISFIFO(mode)) {
        return {.kind = TargetKind::pipe, .path = path};
    }
    refuse_output(name, S_ISSOCK(mode)  ? "this is a socket"
                        : S_ISBLK(mode) ? "this is a block device"
                                        : "this is not a file");
}

}  // namespace

void refuse_output(const fs::path& name, const std::string& reason)
{
    throw Error(ErrorCode::output, fmt::format("{}: cannot write: {}", name.string(), reason));
}

std::string error_text(int error_number)
{
    return std::generic_category().message(error_number);
}

fs::path follow_links(const fs::path& file)
{
    constexpr int max_links = 40;  // as in Linux
    fs::path result = file;
    for (int i = 0; i < max_links && !own_descriptor(result); ++i) {
        std::error_code no_link;
        const fs::path next = fs::read_symlink(result, no_link);
        if (no_link) {
            return result;
        }
        result = result.parent_path() / next;
    }
    return result;
}

OutputTarget find_target(const fs::path& name)
{
    if (name == "-") {
        return {.kind = TargetKind::descriptor,
                .path = {},
                .descriptor = writable_copy("standard output", STDOUT_FILENO)};
    }
    if (!name.has_filename()) {
        refuse_output(name, "this is not a file name");
    }
    fs::path path = follow_links(name);
    if (const std::optional<int> descriptor = own_descriptor(path)) {
        return {.kind = TargetKind::descriptor,
                .path = {},
                .descriptor = writable_copy(name, *descriptor)};
    }
    struct stat status {};
    if (::stat(name.c_str(), &status) != 0) {
        if (errno != ENOENT) {
            refuse_output(name, error_text(errno));
        }
        std::error_code ignored;
        if (const fs::path folder = find_folder(path); !fs::exists(folder, ignored)) {
            refuse_output(name, fmt::format("there is no folder \"{}\"", folder.string()));
        }
        return {.path = std::move(path)};
    }
    const int writable = ::access(name.c_str(), W_OK);
    const int reason = errno;
    if (!S_ISDIR(status.st_mode) && writable != 0) {
        refuse_output(name, error_text(reason));
    }
    if (!S_ISREG(status.st_mode)) {
        return special_target(name, name, status.st_mode);
    }
    return {.path = std::move(path),
            .access =
                FileAccess{.mode = status.st_mode, .owner = status.st_uid, .group = status.st_gid}};
}

namespace {

std::string host_name()
{
    std::array<char, 33> name{};  // the first 32 letters
    ::gethostname(name.data(), name.size() - 1);
    std::string result = name.data();
    std::replace_if(
        result.begin(), result.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return result;
}

/// Sets owner and mode as far as the process may: only root can give files away.
void give_access(int descriptor, const FileAccess& access)
{
    constexpr mode_t everything = 0777;
    constexpr mode_t group_part = 0070;
    mode_t mode = access.mode & everything;
    if (::fchown(descriptor, access.owner, access.group) != 0 &&
        ::fchown(descriptor, static_cast<uid_t>(-1), access.group) != 0) {
        // Another group gets no more rights than everybody.
        mode &= ~group_part | (mode & 0007U) << 3U;
    }
    ::fchmod(descriptor, mode);
}

}  // namespace

const std::string& process_name()
{
    static const std::string name = [] {
        std::random_device random;
        return fmt::format("{}-{}-{:08x}{:08x}", host_name(), ::getpid(), random(), random());
    }();
    return name;
}

std::filesystem::path temporary_name(const std::filesystem::path& target)
{
    constexpr std::size_t number_length = 5;  // "-1000"
    constexpr long usual_length = 255;
    const std::filesystem::path folder =
        target.has_parent_path() ? target.parent_path() : std::filesystem::path(".");
    const long known = ::pathconf(folder.c_str(), _PC_NAME_MAX);
    const auto longest = static_cast<std::size_t>(known > 0 ? known : usual_length);
    const std::string tail = ".tmp-" + process_name();
    std::string name = target.filename().string();
    std::size_t size = longest - std::min(longest, tail.size() + number_length);
    if (size < name.size()) {
        // Some file systems accept only whole characters of UTF-8.
        while (size > 0 && (static_cast<unsigned char>(name[size]) & 0xc0U) == 0x80U) {
            --size;
        }
        name.resize(size);
    }
    return target.parent_path() / (name + tail);
}

TemporaryFile create_temporary(const std::filesystem::path& name,
                               const std::optional<FileAccess>& access)
{
    constexpr int flags = O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC;
    // Less the umask, as for any new file; a file that will be more private is not readable
    // meanwhile.
    const mode_t mode = access ? S_IRUSR | S_IWUSR : 0666;
    constexpr int max_writers = 1000;
    TemporaryFile result{.path = name};
    for (int i = 1; i <= max_writers; ++i) {
        result.descriptor = ::open(result.path.c_str(), flags, mode);
        if (result.descriptor >= 0 || errno != EEXIST) {
            break;
        }
        result.path = name;
        result.path += fmt::format("-{}", i);
    }
    if (result.descriptor >= 0 && access) {
        give_access(result.descriptor, *access);
    }
    return result;
}

}  // namespace bdpt::io
