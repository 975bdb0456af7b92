#include <bdpt/error.h>
#include <fmt/core.h>
#include <signal.h>

#include <algorithm>
#include <exception>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "commands/commands.h"
#include "machine/machine_limits.h"
#include "options/option_list.h"
#include "plan/plan.h"
#include "terminal/console.h"

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
            put_help(*parsed.text);
            return 0;
        }
        return parsed.command->run(words);
    } catch (const OptionError& error) {
        throw Error(error.code(),
                    fmt::format("{}; see \"bdpt {} --help\"", error.what(), given[1]));
    }
}

/// Runs a command and returns the exit code. All failures become messages.
int guarded_run(const std::vector<std::string>& words, Format format)
{
    const auto fail = [format](ErrorCode code, const char* message) {
        report_error(format, static_cast<int>(code), message);
        return static_cast<int>(code);
    };
    try {
        int exit_code = 0;
        within_quota([&] { exit_code = run(words); });
        return exit_code;
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
