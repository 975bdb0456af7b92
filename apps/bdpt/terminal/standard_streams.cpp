#include "terminal/standard_streams.h"

#include <bdpt/error.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <system_error>

namespace bdpt::app {
namespace {

/// errno of the first failure on a stream; 0: there was none.
std::atomic<int>& first_failure(std::FILE* stream)
{
    static std::atomic<int> of_output{0};
    static std::atomic<int> of_errors{0};
    return stream == stdout ? of_output : of_errors;
}

void note_failure(std::FILE* stream, int error_number)
{
    int none = 0;
    first_failure(stream).compare_exchange_strong(none, error_number != 0 ? error_number : EIO);
}

/// Whether all that was printed has arrived.
bool close(std::FILE* stream)
{
    errno = 0;
    const bool had_failed = std::ferror(stream) != 0;
    if (std::fclose(stream) != 0 || had_failed) {
        note_failure(stream, errno);
    }
    return first_failure(stream) == 0;
}

}  // namespace

void guard_standard_streams()
{
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(descriptor, F_GETFD) == -1 && errno == EBADF) {
            // The free descriptor of the lowest number is this one.
            static_cast<void>(
                ::open("/dev/null", descriptor == STDOUT_FILENO ? O_RDONLY : O_WRONLY));
        }
    }
}

void put(std::FILE* stream, std::string_view text)
{
    errno = 0;
    if (std::fwrite(text.data(), 1, text.size(), stream) != text.size() ||
        std::fflush(stream) != 0) {
        note_failure(stream, errno);
    }
}

int finish_standard_streams(int exit_code)
{
    constexpr int lost = static_cast<int>(ErrorCode::output);
    if (!close(stdout) && exit_code == 0) {
        exit_code = lost;
        put(stderr, fmt::format("bdpt: error: standard output: cannot write: {}\n",
                                std::generic_category().message(first_failure(stdout))));
    }
    return !close(stderr) && exit_code == 0 ? lost : exit_code;
}

}  // namespace bdpt::app
