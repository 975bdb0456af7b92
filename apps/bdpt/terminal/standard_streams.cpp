#include "terminal/standard_streams.h"

#include <bdpt/error.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <system_error>

namespace bdpt::app {
namespace {

/// errno of the first failure on a stream; 0: none.
struct StreamFailure {
    std::atomic<int> error_number{0};
    std::atomic<bool> may_lose_reader{false};

    void note(int number)
    {
        int none = 0;
        error_number.compare_exchange_strong(none, number != 0 ? number : EIO);
    }
};

StreamFailure& find_failure(std::FILE* stream)
{
    static StreamFailure of_output;
    static StreamFailure of_errors;
    return stream == stdout ? of_output : of_errors;
}

/// Closes a stream; returns whether all output was written.
bool close(std::FILE* stream)
{
    StreamFailure& failure = find_failure(stream);  // `stream` is invalid after fclose()
    errno = 0;
    const bool had_failed = std::ferror(stream) != 0;
    if (std::fclose(stream) != 0 || had_failed) {
        failure.note(errno);
    }
    return failure.error_number == 0 || (failure.error_number == EPIPE && failure.may_lose_reader);
}

}  // namespace

void guard_standard_streams()
{
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(descriptor, F_GETFD) == -1 && errno == EBADF) {
            // open() returns the lowest free descriptor, which is this one.
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
        find_failure(stream).note(errno);
    }
}

void put_help(std::string_view text)
{
    find_failure(stdout).may_lose_reader = true;
    put(stdout, text);
}

std::optional<int> output_columns()
{
    winsize size{};
    const bool is_known = ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return is_known ? std::optional(int{size.ws_col}) : std::nullopt;
}

int finish_standard_streams(int exit_code)
{
    constexpr int lost = static_cast<int>(ErrorCode::output);
    const StreamFailure& output_failure = find_failure(stdout);
    if (!close(stdout) && exit_code == 0) {
        exit_code = lost;
        put(stderr, fmt::format("bdpt: error: standard output: cannot write: {}\n",
                                std::generic_category().message(output_failure.error_number)));
    }
    return !close(stderr) && exit_code == 0 ? lost : exit_code;
}

}  // namespace bdpt::app
