#pragma once

#include <cstddef>
#include <cstdio>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string_view>

#include "messages/console.h"

/// The command, which is written in the terms of the library of jobs.
namespace bdpt::app {

using namespace job;

/// Opens /dev/null for standard streams that are closed, so that no file opened later gets their
/// number. Writes to a closed standard output still fail; a closed standard error suppresses
/// messages. Call it before any other code runs.
void guard_standard_streams();

/// Prints at once. Failures, by a full disk or a reader that left, must not end a render, so
/// `finish_standard_streams` reports them at the end.
void put(std::FILE* stream, std::string_view text);

/// Prints help on the standard output. A reader that leaves early, such as head, is no failure.
void put_help(std::string_view text);

/// Returns the width of the standard output's terminal; none: it is no terminal.
[[nodiscard]] std::optional<int> output_columns();

/// Closes both streams. Returns `exit_code`, or that of a failed output, with a message, if all
/// else succeeded but printed text was lost.
[[nodiscard]] int finish_standard_streams(int exit_code);

/// Prints messages and progress for the user. Results of `info` do not use it.
class TerminalConsole final : public Console {
public:
    TerminalConsole(Format format, Verbosity verbosity);
    ~TerminalConsole() override;

private:
    /// Prints nothing if the format is text; if quiet, only the event "done". Events of one of
    /// several images get its "frame" and "camera".
    void show_event(std::string_view name, const nlohmann::ordered_json& fields) override;
    /// In JSON, prints nothing for a note without a code.
    void show_note(const Note& note) override;
    void show_verbose(const Note& note) override;
    void show_warning(std::string_view message) override;
    /// Rate-limited, however often it is called.
    void show_progress(const Progress& progress, const Goal& goal) override;
    void show_task(const TaskProgress& progress) override;
    void finish_progress() override;

    void print_line(std::string_view prefix, std::string_view message);
    void put_event(std::string_view name, const nlohmann::ordered_json& fields);
    void erase_progress();
    [[nodiscard]] bool is_due(double seconds);
    void draw_progress(double fraction, const std::string& text);

    Format format_;
    Verbosity verbosity_;
    bool terminal_;  // stderr is a terminal, which can redraw a line
    bool color_;
    std::size_t drawn_ = 0;  // characters of the visible progress line
    double last_shown_ = -std::numeric_limits<double>::infinity();  // time of the render [s]
};

/// Prints a result on stdout, text or JSON, without control characters that a terminal would obey.
void print_text(std::string_view text);

/// Prints the line for a failure on stderr and, in JSON, an event. Throws nothing.
void report_error(Format format, int exit_code, std::string_view message) noexcept;

}  // namespace bdpt::app
