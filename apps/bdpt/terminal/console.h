#pragma once

#include <signal.h>

#include <atomic>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <limits>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>

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

/// Turns SIGINT, SIGTERM and SIGHUP into a stop request during its lifetime: the first one requests
/// a stop if that is allowed; any other removes the temporary files and ends the process with 128 +
/// the signal's number. SIGTERM and SIGHUP wait for a stop that one of them requested, as
/// schedulers and closing terminals send them twice; but not where the process waits, or may have
/// to wait, for somebody to read what it writes. SIGUSR1 requests a checkpoint, and does nothing if
/// there are none. Create it before any other thread, so that threads inherit the blocked signals.
class SignalInterrupt final : public Interrupt {
public:
    /// `on_stop` is called on another thread when a stop is requested. It may wait for a reader.
    SignalInterrupt(PendingOutputs outputs, std::function<void()> on_stop);
    ~SignalInterrupt() override;

    void set_outputs(PendingOutputs outputs) override;
    void allow_stop() override;
    void forbid_stop() override;
    [[nodiscard]] std::stop_token stop_token() const override { return stop_.get_token(); }
    /// Returns "SIGINT", "SIGTERM" or "SIGHUP".
    [[nodiscard]] std::optional<std::string> stopped_by() const override;
    [[nodiscard]] bool take_checkpoint_request() override { return checkpoint_.exchange(false); }
    /// Returns the signal that requested the stop.
    [[nodiscard]] std::optional<int> signal() const;

private:
    void watch(const std::stop_token& finished);
    void handle(int signal_number);

    std::mutex mutex_;
    PendingOutputs outputs_;  // guarded by the mutex, as the next two
    bool stop_allowed_ = false;
    std::jthread announcer_;  // calls on_stop_
    std::function<void()> on_stop_;
    sigset_t signals_{};
    sigset_t previous_{};
    std::stop_source stop_;
    std::atomic<int> signal_{0};
    std::atomic<bool> checkpoint_{false};
    std::jthread watcher_;  // last: uses all of the above
};

}  // namespace bdpt::app
