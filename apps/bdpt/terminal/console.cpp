#include "terminal/console.h"

#include <bdpt/error.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <system_error>

#include "messages/text.h"
#include "output/values.h"

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

namespace {

using nlohmann::ordered_json;

void put_object(const ordered_json& object)
{
    print_text(object.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n");
}

bool is_set(const char* variable)
{
    const char* value = std::getenv(variable);
    return value != nullptr && *value != '\0';
}

bool stderr_redraws()
{
    const char* terminal = std::getenv("TERM");
    return ::isatty(STDERR_FILENO) == 1 && terminal != nullptr &&
           std::string_view(terminal) != "dumb";
}

std::string samples_text(const Progress& progress, const Goal& goal)
{
    return goal.samples ? fmt::format("{}/{} spp", progress.samples_done, *goal.samples)
                        : fmt::format("{} spp", progress.samples_done);
}

double samples_a_second(const Progress& progress)
{
    return progress.seconds > 0.0 ? static_cast<double>(progress.samples_done) / progress.seconds
                                  : 0.0;
}

/// Returns "3.2 spp/s", and the noise if it is known.
std::string speed_text(const Progress& progress)
{
    std::string text = fmt::format("{:.3g} spp/s", samples_a_second(progress));
    if (progress.noise && std::isfinite(*progress.noise)) {
        text += "  noise " + noise_text(*progress.noise);
    }
    return text;
}

std::string bar(double fraction)
{
    constexpr int width = 24;
    const int done = static_cast<int>(fraction * width);
    std::string result(static_cast<std::size_t>(done), '=');
    result += done < width ? ">" : "";
    result.resize(width, ' ');
    return "[" + result + "]";
}

}  // namespace

TerminalConsole::TerminalConsole(Format format, Verbosity verbosity)
    : format_(format),
      verbosity_(verbosity),
      terminal_(stderr_redraws()),
      color_(terminal_ && !is_set("NO_COLOR"))
{}

TerminalConsole::~TerminalConsole()
{
    erase_progress();
}

void TerminalConsole::put_event(std::string_view name, const ordered_json& fields)
{
    ordered_json object{{"event", name}};
    if (label().frame) {
        object["frame"] = *label().frame;
    }
    if (label().camera) {
        object["camera"] = one_line(*label().camera);
    }
    object.update(fields);
    put_object(object);
}

void TerminalConsole::show_event(std::string_view name, const ordered_json& fields)
{
    if (format_ == Format::json && (verbosity_ != Verbosity::quiet || name == "done")) {
        put_event(name, fields);
    }
}

void TerminalConsole::show_note(const Note& note)
{
    if (verbosity_ == Verbosity::quiet) {
        return;
    }
    if (format_ == Format::text) {
        print_line("bdpt: ", note.text);
    } else if (!note.code.empty()) {
        put_event("note", {{"code", note.code}, {"message", one_line(note.text)}});
    }
}

void TerminalConsole::show_verbose(const Note& note)
{
    if (verbosity_ == Verbosity::verbose) {
        show_note(note);
    }
}

void TerminalConsole::show_warning(std::string_view message)
{
    if (verbosity_ == Verbosity::quiet) {
        return;
    }
    if (format_ == Format::json) {
        put_event("warning", {{"message", one_line(message)}});
    } else {
        print_line(color_ ? "bdpt: \x1b[33mwarning:\x1b[0m " : "bdpt: warning: ", message);
    }
}

void TerminalConsole::show_progress(const Progress& progress, const Goal& goal)
{
    const std::optional<double> left = time_left(progress, goal);
    if (verbosity_ == Verbosity::quiet || !left || !is_due(progress.seconds)) {
        return;
    }
    const double fraction = fraction_done(progress, goal);
    if (format_ == Format::json) {
        ordered_json fields{{"samples", progress.samples_done}};
        fields["samples_total"] = or_null(goal.samples);
        fields.update({{"fraction", fraction},
                       {"seconds", progress.seconds},
                       {"eta_seconds", *left},
                       {"samples_per_second", samples_a_second(progress)}});
        if (progress.noise && std::isfinite(*progress.noise)) {
            fields.update({{"noise", *progress.noise}, {"noise_samples", progress.noise_samples}});
        }
        put_event("progress", fields);
        return;
    }
    draw_progress(fraction, fmt::format("{:3.0f}%  {}  {}  ETA {}  {}", 100.0 * fraction,
                                        samples_text(progress, goal), clock_time(progress.seconds),
                                        clock_time(*left), speed_text(progress)));
}

void TerminalConsole::show_task(const TaskProgress& progress)
{
    if (verbosity_ == Verbosity::quiet || !is_due(progress.seconds)) {
        return;
    }
    const double fraction = std::clamp(progress.fraction, 0.0, 1.0);
    if (format_ == Format::json) {
        ordered_json fields{{"fraction", fraction}, {"seconds", progress.seconds}};
        fields["eta_seconds"] = or_null(progress.seconds_left);
        fields["activity"] = one_line(progress.activity);
        put_event("progress", fields);
        return;
    }
    const std::string left = progress.seconds_left ? clock_time(*progress.seconds_left) : "-";
    draw_progress(fraction,
                  fmt::format("{:3.0f}%  {}  ETA {}  {}", 100.0 * fraction,
                              clock_time(progress.seconds), left, one_line(progress.activity)));
}

void TerminalConsole::draw_progress(double fraction, const std::string& text)
{
    const std::string name = label_text(label());
    const std::string labelled = name.empty() ? text : fmt::format("{}  {}", name, text);
    if (!terminal_) {
        put(stderr, fmt::format("bdpt: {}\n", labelled));
        return;
    }
    const std::string line = fmt::format("{} {}", bar(fraction), labelled);
    put(stderr, fmt::format("\r{:<{}}", line, std::max(drawn_, line.size())));
    drawn_ = line.size();
}

void TerminalConsole::finish_progress()
{
    erase_progress();
    last_shown_ = -std::numeric_limits<double>::infinity();
}

void TerminalConsole::print_line(std::string_view prefix, std::string_view message)
{
    erase_progress();
    put(stderr, fmt::format("{}{}\n", prefix, one_line(message)));
}

void TerminalConsole::erase_progress()
{
    if (drawn_ > 0) {
        put(stderr, fmt::format("\r{:{}}\r", "", drawn_));
        drawn_ = 0;
    }
}

bool TerminalConsole::is_due(double seconds)
{
    const double interval = format_ == Format::json ? 0.5 : terminal_ ? 0.1 : 5.0;
    const bool due = seconds - last_shown_ >= interval;
    // A log that nobody watches starts after the first interval: short renders leave no line.
    const bool too_early = format_ == Format::text && !terminal_ && seconds < interval;
    if (!due || too_early) {
        return false;
    }
    last_shown_ = seconds;
    return true;
}

void print_text(std::string_view text)
{
    put(stdout, escaped(text));
}

void report_error(Format format, int exit_code, std::string_view message) noexcept
{
    try {
        const std::string text = one_line(message);
        if (format == Format::json) {
            put_object({{"event", "error"}, {"code", exit_code}, {"message", text}});
        }
        put(stderr, fmt::format("bdpt: error: {}\n", text));
    } catch (...) {
        std::fputs("bdpt: error: out of memory\n", stderr);
    }
}

}  // namespace bdpt::app
