#include <bdpt/error.h>
#include <bdpt/thread_limit.h>
#include <fmt/core.h>
#include <signal.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <exception>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "commands/command_line.h"
#include "options/option_list.h"
#include "plan/planned_words.h"
#include "terminal/cgroup_limits.h"
#include "terminal/console.h"
#include "terminal/standard_streams.h"

namespace bdpt::app {
namespace {

int run(const std::vector<std::string>& given)
{
    CommandLine line;
    if (given.size() < 2) {
        put(stderr, help_text(line.program, ""));
        return static_cast<int>(ErrorCode::usage);
    }
    try {
        const std::vector<std::string> words = with_planned_words(given);
        const ParsedLine parsed = parse(line.program, {words.begin() + 1, words.end()});
        if (parsed.text) {
            print_text(*parsed.text);
            return 0;
        }
        return line.run(parsed, words);
    } catch (const OptionError& error) {
        throw Error(error.code(),
                    fmt::format("{}; see \"bdpt {} --help\"", error.what(), given[1]));
    }
}

/// Runs `work` with as many threads as the quota of a container allows, and as the system lets
/// start: oneTBB knows only the processors that the process may run on, not such limits.
template <typename Work>
int within_quota(const Work& work)
{
    const int quota = cgroup_limits().processors.value_or(int{tbb::task_arena::automatic});
    const int available = tbb::this_task_arena::max_concurrency();
    const int allowed = limit_threads(quota > 0 ? std::min(quota, available) : available).allowed;
    return allowed < available ? tbb::task_arena(allowed).execute(work) : work();
}

/// Runs a command and returns the exit code. All failures become messages.
int guarded_run(const std::vector<std::string>& words, Format format)
{
    const auto fail = [format](ErrorCode code, const char* message) {
        report_error(format, static_cast<int>(code), message);
        return static_cast<int>(code);
    };
    try {
        return within_quota([&] { return run(words); });
    } catch (const Error& error) {
        return fail(error.code(), error.what());
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::out_of_memory, "out of memory");
    } catch (const std::system_error& error) {
        return error.code() == std::errc::resource_unavailable_try_again
                   ? fail(ErrorCode::out_of_memory,
                          "no thread can be started: the system limits how many this user or "
                          "container may have")
                   : fail(ErrorCode::internal, error.what());
    } catch (const std::exception& error) {
        return fail(ErrorCode::internal, error.what());
    }
}

}  // namespace
}  // namespace bdpt::app

int main(int argc, char** argv)
{
    using namespace bdpt;
    app::guard_standard_streams();
    // A closed pipe must not end the render.
    ::signal(SIGPIPE, SIG_IGN);
    const std::span<char*> words(argv, static_cast<std::size_t>(argc));
    const bool json = std::any_of(words.begin(), words.end(), [](const char* word) {
        return std::string_view(word) == "--json";
    });
    return app::finish_standard_streams(app::guarded_run(
        {words.begin(), words.end()}, json ? app::Format::json : app::Format::text));
}
