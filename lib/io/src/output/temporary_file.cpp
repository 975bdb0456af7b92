#include "output/temporary_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
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

}  // namespace

const std::string& process_name()
{
    static const std::string name = [] {
        std::random_device random;
        return fmt::format("{}-{}-{:08x}{:08x}", host_name(), ::getpid(), random(), random());
    }();
    return name;
}

TemporaryFile create_temporary(const std::filesystem::path& name)
{
    constexpr int flags = O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC;
    constexpr mode_t mode = 0666;  // less the umask, as for any new file
    constexpr int most_writers = 1000;
    TemporaryFile result{.path = name};
    for (int i = 1; i <= most_writers; ++i) {
        result.descriptor = ::open(result.path.c_str(), flags, mode);
        if (result.descriptor >= 0 || errno != EEXIST) {
            break;
        }
        result.path = name;
        result.path += fmt::format("-{}", i);
    }
    return result;
}

}  // namespace bdpt::io
