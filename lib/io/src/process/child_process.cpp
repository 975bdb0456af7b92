#include "process/child_process.h"

#include <bdpt/error.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <string_view>
#include <system_error>

namespace bdpt::io {

namespace {

[[noreturn]] void fail(std::string_view what, int error)
{
    const std::string reason = std::generic_category().message(error);
    if (error == EAGAIN) {
        throw Error(
            ErrorCode::out_of_memory,
            fmt::format("{}: {}: the system limits how many processes this user or container "
                        "may have",
                        what, reason));
    }
    throw Error(error == ENOMEM ? ErrorCode::out_of_memory : ErrorCode::unsupported,
                fmt::format("{}: {}", what, reason));
}

/// Moves `descriptor` to a number above those of the standard streams.
int above_streams(int descriptor)
{
    if (descriptor < 0 || descriptor > STDERR_FILENO) {
        return descriptor;
    }
    const int other = ::fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    ::close(descriptor);
    return other;
}

/// Redirection of the standard streams of a new process, which gets no other descriptor.
class Streams {
public:
    /// `input` -1: there is none.
    Streams(int input, int output, int errors)
    {
        posix_spawn_file_actions_init(&actions_);
        if (input < 0) {
            posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        } else {
            posix_spawn_file_actions_adddup2(&actions_, input, STDIN_FILENO);
        }
        posix_spawn_file_actions_adddup2(&actions_, output, STDOUT_FILENO);
        posix_spawn_file_actions_adddup2(&actions_, errors, STDERR_FILENO);
        posix_spawn_file_actions_addclosefrom_np(&actions_, STDERR_FILENO + 1);
    }
    ~Streams() { posix_spawn_file_actions_destroy(&actions_); }
    Streams(const Streams&) = delete;
    Streams& operator=(const Streams&) = delete;

    [[nodiscard]] const posix_spawn_file_actions_t* get() const { return &actions_; }

private:
    posix_spawn_file_actions_t actions_{};
};

/// Default signal actions for a new process: it ends when its output is not read, and when its time
/// is over, whatever this process does about such signals.
class Signals {
public:
    Signals()
    {
        posix_spawnattr_init(&attributes_);
        sigset_t none;
        sigemptyset(&none);
        posix_spawnattr_setsigmask(&attributes_, &none);
        sigset_t ends;
        sigemptyset(&ends);
        sigaddset(&ends, SIGPIPE);
        sigaddset(&ends, SIGXCPU);
        posix_spawnattr_setsigdefault(&attributes_, &ends);
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    }
    ~Signals() { posix_spawnattr_destroy(&attributes_); }
    Signals(const Signals&) = delete;
    Signals& operator=(const Signals&) = delete;

    [[nodiscard]] const posix_spawnattr_t* get() const { return &attributes_; }

private:
    posix_spawnattr_t attributes_{};
};

/// Returns the environment of a new process.
std::vector<std::string> make_environment()
{
    std::vector<std::string> result{fmt::format("{}={}", parent_variable, ::getpid())};
    // Where libraries are, and the options of sanitizers.
    for (const char* name : {"LD_LIBRARY_PATH", "ASAN_OPTIONS", "UBSAN_OPTIONS", "LSAN_OPTIONS"}) {
        if (const char* const value = std::getenv(name)) {
            result.push_back(fmt::format("{}={}", name, value));
        }
    }
    return result;
}

/// Returns pointers to the texts, and a null pointer behind them.
std::vector<char*> pointers(std::vector<std::string>& texts)
{
    std::vector<char*> result;
    for (std::string& text : texts) {
        result.push_back(text.data());
    }
    result.push_back(nullptr);
    return result;
}

/// Returns the last line of the file, or of its first bytes if it is long.
std::string last_line(int file)
{
    std::string text(16384, '\0');
    const ssize_t size = ::pread(file, text.data(), text.size(), 0);
    text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    while (!text.empty() && text.back() == '\n') {
        text.pop_back();
    }
    return text.substr(text.rfind('\n') + 1);
}

/// Creates a file in memory that holds `bytes`, to be read from its start; -1 if there are none.
int make_memory_file(std::span<const std::uint8_t> bytes)
{
    if (bytes.empty()) {
        return -1;
    }
    Descriptor file(above_streams(::memfd_create("input", MFD_CLOEXEC)));
    while (file.number() >= 0 && !bytes.empty()) {
        const ssize_t count = ::write(file.number(), bytes.data(), bytes.size());
        if (count < 0 && errno != EINTR) {
            break;
        }
        bytes = bytes.subspan(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    }
    if (!bytes.empty() || ::lseek(file.number(), 0, SEEK_SET) != 0) {
        fail("no file in memory for a new process", errno);
    }
    return file.release();
}

}  // namespace

void Descriptor::close()
{
    if (number_ >= 0) {
        ::close(number_);
        number_ = -1;
    }
}

ChildProcess::ChildProcess(const std::filesystem::path& program,
                           const std::vector<std::string>& arguments,
                           std::span<const std::uint8_t> input)
    : output_(-1), errors_(above_streams(::memfd_create("errors", MFD_CLOEXEC)))
{
    std::array<int, 2> ends{};
    if (errors_.number() < 0 || ::pipe2(ends.data(), O_CLOEXEC) != 0) {
        fail("no pipe to a new process", errno);
    }
    output_.adopt(above_streams(ends[0]));
    const Descriptor written(above_streams(ends[1]));
    if (output_.number() < 0 || written.number() < 0) {
        fail("no pipe to a new process", errno);
    }
    const Descriptor given(make_memory_file(input));
    std::vector<std::string> words{program.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<std::string> environment = make_environment();
    const Streams streams(given.number(), written.number(), errors_.number());
    const int error = ::posix_spawn(&id_, program.c_str(), streams.get(), Signals().get(),
                                    pointers(words).data(), pointers(environment).data());
    if (error != 0) {
        id_ = -1;
        fail(program.string() + " cannot be started", error);
    }
}

ChildProcess::~ChildProcess()
{
    if (id_ > 0) {
        ::kill(id_, SIGKILL);
        static_cast<void>(wait());
    }
}

std::size_t ChildProcess::read(void* bytes, std::size_t size)
{
    std::size_t done = 0;
    while (done < size) {
        const ssize_t count =
            ::read(output_.number(), static_cast<char*>(bytes) + done, size - done);
        if (count > 0) {
            done += static_cast<std::size_t>(count);
        } else if (count == 0 || errno != EINTR) {
            break;
        }
    }
    return done;
}

ProcessEnd ChildProcess::wait()
{
    output_.close();  // so that the process ends if it writes more than is read
    int status = 0;
    pid_t ended = -1;
    do {
        ended = ::waitpid(id_, &status, 0);
    } while (ended < 0 && errno == EINTR);
    const bool known = ended == id_;  // false if SIGCHLD is ignored
    id_ = -1;
    ProcessEnd end{.message = last_line(errors_.number())};
    if (known && WIFEXITED(status)) {
        end.exit_code = WEXITSTATUS(status);
    } else if (known && WIFSIGNALED(status)) {
        end.signal = WTERMSIG(status);
    }
    return end;
}

}  // namespace bdpt::io
