#pragma once

#include <bdpt/error.h>
#include <bdpt/render.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace bdpt::app {

enum class Verbosity : std::uint8_t { normal, quiet };
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

/// Estimates the seconds left until `goal` by `progress`; none if nothing is done yet.
[[nodiscard]] std::optional<double> time_left(const Progress& progress, const Goal& goal);

/// Prints messages and progress for the user. Results of `info` do not use it. Thread-safe.
class Console {
public:
    Console(Format format, Verbosity verbosity);
    ~Console();
    Console(const Console&) = delete;
    Console& operator=(const Console&) = delete;

    /// Emits an event. `fields` is a JSON object, to which "event" is added. Does nothing if the
    /// format is text; if quiet, only the event "done" is emitted.
    void event(std::string_view name, const nlohmann::ordered_json& fields);
    /// Prints a line for people; nothing if the format is JSON.
    void note(std::string_view message, Repeat repeat = Repeat::always);
    /// Prints a line for people, if there is only one image.
    void detail(std::string_view message);
    void warning(std::string_view message, Repeat repeat = Repeat::never);
    /// Sets the image: further events get its "frame" and "camera", if any, and progress lines its
    /// label.
    void begin_image(const ImageLabel& label);
    /// Shows the progress of a render; rate-limited, however often it is called.
    void progress(const Progress& progress, const Goal& goal);
    /// Shows the progress of a task of many parts.
    void task(const TaskProgress& progress);
    /// Ends a progress line, so that further output starts on a new line.
    void end_progress();

private:
    void print_line(std::string_view prefix, std::string_view message);
    void put_event(std::string_view name, const nlohmann::ordered_json& fields);
    void erase_progress();
    [[nodiscard]] bool is_due(double seconds);
    void draw_progress(double fraction, const std::string& text);

    Format format_;
    Verbosity verbosity_;
    bool terminal_;  // stderr is a terminal, which can redraw a line
    bool color_;
    std::mutex mutex_;
    std::size_t drawn_ = 0;  // characters of the visible progress line
    ImageLabel label_;
    std::set<std::string, std::less<>> told_;
    double last_shown_ = -std::numeric_limits<double>::infinity();  // time of the render [s]
};

/// Prints a result on stdout, text or JSON, without control characters that a terminal would obey.
void print_text(std::string_view text);

/// Prints the line for a failure on stderr and, in JSON, an event. Throws nothing.
void report_error(Format format, int exit_code, std::string_view message) noexcept;

}  // namespace bdpt::app
