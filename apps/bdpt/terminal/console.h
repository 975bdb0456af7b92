#pragma once

#include <bdpt/render.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <limits>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace bdpt::app {

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

enum class Verbosity : std::uint8_t { normal, quiet, verbose };
enum class Format : std::uint8_t {
    text,  ///< lines for people on stderr
    json,  ///< one JSON object per line on stdout, for programs
};

/// Conditions that end a render; the first one met counts.
struct Goal {
    std::optional<std::int64_t> samples;  ///< per pixel
    double seconds = std::numeric_limits<double>::infinity();
    std::optional<double> noise{};  ///< as by estimate_noise()
};

/// Progress of a task of many parts.
struct TaskProgress {
    double fraction = 0.0;  ///< [0, 1]
    double seconds = 0.0;   ///< elapsed
    std::optional<double> seconds_left{};
    std::string activity;  ///< current activity
};

/// Repetition of messages.
enum class Repeat : std::uint8_t {
    never,   ///< the same message is shown once
    always,  ///< the message is shown each time
};

/// Label of one of several images.
struct ImageLabel {
    std::optional<int> frame{};
    std::optional<std::string> camera{};
    std::size_t index = 0;
    std::size_t count = 1;
};

/// Returns "frame 12 (3 of 24)", "frame 12, camera front (7 of 48)"; empty if there is only one
/// image.
[[nodiscard]] std::string label_text(const ImageLabel& label);

/// Returns "2.3 %", or "unknown" for an infinite noise.
[[nodiscard]] std::string noise_text(double noise);

/// Returns the fraction of the way to `goal`, in [0, 1], by samples or time.
[[nodiscard]] double fraction_done(const Progress& progress, const Goal& goal);

/// Estimates the seconds left until `goal` by `progress`; none if nothing is done yet.
[[nodiscard]] std::optional<double> time_left(const Progress& progress, const Goal& goal);

/// A line for people that programs get, too.
struct Note {
    std::string_view code;  ///< its kind, such as "default_sky"; stable
    std::string text;
};

/// Receives the messages and the progress of a command, and decides which of them are news.
/// Thread-safe.
class Console {
public:
    Console() = default;
    virtual ~Console() = default;
    Console(const Console&) = delete;
    Console& operator=(const Console&) = delete;

    /// Emits an event for programs. `fields` is a JSON object, to which "event" is added.
    void event(std::string_view name, const nlohmann::ordered_json& fields);
    /// Shows a line for people; programs have an event that says the same.
    void note(std::string_view message, Repeat repeat = Repeat::always);
    /// Shows a line for people, and emits it as an event "note" for programs.
    void note(const Note& note, Repeat repeat = Repeat::always);
    /// Shows the first note of its code, with --verbose only.
    void verbose(const Note& note);
    /// Shows a line for people, if there is only one image.
    void detail(std::string_view message);
    void warning(std::string_view message, Repeat repeat = Repeat::never);
    /// Sets the image that all further messages are about.
    void begin_image(const ImageLabel& label);
    /// Shows the progress of a render.
    void progress(const Progress& progress, const Goal& goal);
    /// Shows the progress of a task of many parts.
    void task(const TaskProgress& progress);
    /// Ends a progress line, so that further output starts on a new line.
    void end_progress();

protected:
    [[nodiscard]] const ImageLabel& label() const { return label_; }

private:
    // Called by one thread at a time.
    virtual void show_event(std::string_view name, const nlohmann::ordered_json& fields) = 0;
    virtual void show_note(const Note& note) = 0;
    virtual void show_verbose(const Note& /*note*/) {}
    virtual void show_warning(std::string_view message) = 0;
    virtual void show_progress(const Progress& progress, const Goal& goal) = 0;
    virtual void show_task(const TaskProgress& progress) = 0;
    virtual void finish_progress() = 0;

    std::mutex mutex_;
    ImageLabel label_;
    std::set<std::string, std::less<>> told_;
};

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
