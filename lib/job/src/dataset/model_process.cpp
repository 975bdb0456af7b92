#include "dataset/dataset.h"

#include <bdpt/error.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace bdpt::job {
namespace {

struct Pipe {
    std::array<int, 2> ends{-1, -1};

    Pipe()
    {
        if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
            throw Error(ErrorCode::out_of_memory,
                        fmt::format("no pipe can be opened: {}", std::strerror(errno)));
        }
        ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
    }
    ~Pipe()
    {
        for (const int end : ends) {
            if (end >= 0) {
                ::close(end);
            }
        }
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;

    int take_reader() { return std::exchange(ends[0], -1); }
};

/// Appends what can be read now; closes the descriptor at the end.
void drain(int& descriptor, std::string& text)
{
    std::array<char, 4096> bytes{};
    while (descriptor >= 0) {
        const ssize_t count = ::read(descriptor, bytes.data(), bytes.size());
        if (count > 0) {
            text.append(bytes.data(), static_cast<std::size_t>(count));
        } else if (count == 0) {
            ::close(std::exchange(descriptor, -1));
        } else if (errno != EINTR) {
            return;  // nothing yet
        }
    }
}

std::string last_line(std::string text)
{
    while (!text.empty() && text.back() == '\n') {
        text.pop_back();
    }
    const std::size_t start = text.rfind('\n');
    text = start == std::string::npos ? text : text.substr(start + 1);
    constexpr std::string_view prefix = "bdpt: error: ";
    return text.starts_with(prefix) ? text.substr(prefix.size()) : text;
}

}  // namespace

ModelProcess::ModelProcess(const std::vector<std::string>& arguments)
{
    Pipe output;
    Pipe errors;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, output.ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, errors.ends[1], STDERR_FILENO);
    std::vector<std::string> words{"bdpt", "dataset"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) {
        argv.push_back(word.data());
    }
    argv.push_back(nullptr);
    std::string parent = fmt::format("{}={}", dataset_parent, ::getpid());
    std::vector<char*> variables{parent.data()};
    for (char** variable = environ; *variable != nullptr; ++variable) {
        variables.push_back(*variable);
    }
    variables.push_back(nullptr);
    const int failure =
        ::posix_spawn(&id_, "/proc/self/exe", &actions, nullptr, argv.data(), variables.data());
    posix_spawn_file_actions_destroy(&actions);
    if (failure != 0) {
        throw Error(ErrorCode::out_of_memory,
                    fmt::format("no process can be started: {} (--isolate=false needs none)",
                                std::strerror(failure)));
    }
    output_ = output.take_reader();
    errors_ = errors.take_reader();
}

ModelProcess::~ModelProcess()
{
    if (id_ > 0) {
        ::kill(id_, SIGKILL);
        ::waitpid(id_, nullptr, 0);
    }
    for (const int descriptor : {output_, errors_}) {
        if (descriptor >= 0) {
            ::close(descriptor);
        }
    }
}

ModelProcess::ModelProcess(ModelProcess&& other) noexcept
    : id_(std::exchange(other.id_, -1)),
      output_(std::exchange(other.output_, -1)),
      errors_(std::exchange(other.errors_, -1)),
      line_(std::move(other.line_)),
      message_(std::move(other.message_)),
      killed_(other.killed_),
      start_(other.start_)
{}

std::vector<std::string> ModelProcess::new_lines()
{
    drain(output_, line_);
    drain(errors_, message_);
    std::vector<std::string> lines;
    for (std::size_t end = line_.find('\n'); end != std::string::npos; end = line_.find('\n')) {
        lines.push_back(line_.substr(0, end));
        line_.erase(0, end + 1);
    }
    return lines;
}

std::optional<ModelEnd> ModelProcess::end(const std::optional<double>& limit)
{
    if (limit && seconds() > *limit && !killed_) {
        ::kill(id_, SIGKILL);
        killed_ = true;
    }
    int status = 0;
    if (::waitpid(id_, &status, WNOHANG) != id_) {
        return std::nullopt;
    }
    id_ = -1;
    drain(errors_, message_);
    constexpr int of_signals = 128;
    return ModelEnd{
        .exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : of_signals + WTERMSIG(status),
        .message = last_line(message_),
        .timed_out = killed_};
}

void ModelProcess::stop() const
{
    ::kill(id_, SIGTERM);
}

std::vector<int> ModelProcess::descriptors() const
{
    std::vector<int> result;
    for (const int descriptor : {output_, errors_}) {
        if (descriptor >= 0) {
            result.push_back(descriptor);
        }
    }
    return result;
}

double ModelProcess::seconds() const
{
    return seconds_since(start_);
}

void wait_for_any(const std::vector<int>& descriptors)
{
    std::vector<pollfd> events;
    for (const int descriptor : descriptors) {
        events.push_back({.fd = descriptor, .events = POLLIN, .revents = 0});
    }
    constexpr int briefly = 50;  // [ms]
    ::poll(events.data(), events.size(), briefly);
}

bool end_with_dataset()
{
    const char* const parent = std::getenv(dataset_parent);
    if (parent == nullptr) {
        return false;
    }
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (std::to_string(::getppid()) != parent) {
        std::_Exit(static_cast<int>(ErrorCode::internal));  // it ended before
    }
    return true;
}

}  // namespace bdpt::job
