#include "subprocess.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <stdexcept>
#include <utility>

namespace bdpt::test {
namespace {

struct Channel {
    int ours = -1;
    int theirs = -1;
};

Channel make_pipe()
{
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
        throw std::runtime_error("cannot make a pipe");
    }
    return {ends[0], ends[1]};
}

Channel make_terminal()
{
    const int ours = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (ours < 0 || ::grantpt(ours) != 0 || ::unlockpt(ours) != 0) {
        throw std::runtime_error("cannot make a terminal");
    }
    return {ours, ::open(::ptsname(ours), O_RDWR | O_NOCTTY | O_CLOEXEC)};
}

void limit(int resource, const std::optional<rlim_t>& value)
{
    if (value) {
        const rlimit both{*value, *value};
        ::setrlimit(static_cast<__rlimit_resource>(resource), &both);
    }
}

/// So that a command that never ends fails its test; far beyond what any test takes.
constexpr unsigned max_run_seconds = 300;  // [s]

/// In the child.
[[noreturn]] void become_command(const Launch& launch, const Channel& out, const Channel& err)
{
    ::dup2(out.theirs, STDOUT_FILENO);
    ::dup2(err.theirs, STDERR_FILENO);
    ::signal(SIGINT, SIG_DFL);
    ::signal(SIGTERM, SIG_DFL);
    ::signal(SIGXFSZ, SIG_IGN);
    ::unsetenv("NO_COLOR");
    for (const auto& [name, value] : launch.environment) {
        ::setenv(name.c_str(), value.c_str(), 1);
    }
    ::alarm(max_run_seconds);
    if (!launch.folder.empty() && ::chdir(launch.folder.c_str()) != 0) {
        ::_exit(98);
    }
    limit(RLIMIT_AS, launch.address_space);
    limit(RLIMIT_FSIZE, launch.file_size);

    std::string command = BDPT_COMMAND;
    std::vector<std::string> words = launch.arguments;
    std::vector<char*> pointers{command.data()};
    for (std::string& word : words) {
        pointers.push_back(word.data());
    }
    pointers.push_back(nullptr);
    ::execv(command.c_str(), pointers.data());
    ::_exit(99);
}

/// Appends to `text`; closes the stream, and says false, at its end.
bool drain(int& descriptor, std::string& text)
{
    std::array<char, 4096> bytes{};
    const ssize_t count = ::read(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) {
        return true;
    }
    if (count <= 0) {
        ::close(descriptor);
        descriptor = -1;
        return false;
    }
    text.append(bytes.data(), static_cast<std::size_t>(count));
    return true;
}

}  // namespace

Subprocess::Subprocess(const Launch& launch)
{
    const Channel out = make_pipe();
    const Channel err = launch.stderr_kind == StderrKind::terminal ? make_terminal() : make_pipe();
    id_ = ::fork();
    if (id_ < 0) {
        throw std::runtime_error("cannot fork");
    }
    if (id_ == 0) {
        become_command(launch, out, err);
    }
    ::close(out.theirs);
    ::close(err.theirs);
    out_ = out.ours;
    err_ = err.ours;
}

Subprocess::~Subprocess()
{
    if (id_ > 0) {
        ::kill(id_, SIGKILL);
        ::waitpid(id_, nullptr, 0);
    }
    for (const int descriptor : {out_, err_}) {
        if (descriptor >= 0) {
            ::close(descriptor);
        }
    }
}

bool Subprocess::read_some()
{
    if (out_ < 0 && err_ < 0) {
        return false;
    }
    // poll() passes over negative descriptors.
    std::array<pollfd, 2> streams{{{out_, POLLIN, 0}, {err_, POLLIN, 0}}};
    ::poll(streams.data(), streams.size(), -1);
    if (streams[0].revents != 0) {
        drain(out_, outcome_.out);
    }
    if (streams[1].revents != 0) {
        drain(err_, outcome_.err);
    }
    return true;
}

void Subprocess::wait_for(std::string_view text)
{
    while (outcome_.out.find(text) == std::string::npos &&
           outcome_.err.find(text) == std::string::npos) {
        if (!read_some()) {
            throw std::runtime_error("bdpt ended without \"" + std::string(text) +
                                     "\": " + outcome_.out + outcome_.err);
        }
    }
}

void Subprocess::send(int signal_number) const
{
    ::kill(id_, signal_number);
}

Outcome Subprocess::finish()
{
    while (read_some()) {
    }
    int status = 0;
    ::waitpid(id_, &status, 0);
    id_ = -1;
    outcome_.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return outcome_;
}

Outcome run(const Launch& launch)
{
    return Subprocess(launch).finish();
}

Outcome run(std::vector<std::string> arguments)
{
    return run(Launch{.arguments = std::move(arguments)});
}

}  // namespace bdpt::test
