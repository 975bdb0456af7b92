#include "output/output_target.h"

#include <bdpt/error.h>
#include <bdpt/io/output_file.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
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

}  // namespace bdpt::io
