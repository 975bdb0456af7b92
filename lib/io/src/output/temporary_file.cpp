#include "output/temporary_file.h"

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

namespace bdpt::io {
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
