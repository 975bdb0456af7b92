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
    json,  ///< one JSON object a line on stdout, for programs
};

/// When a render ends; what comes first counts.
struct Goal {
    std::optional<std::int64_t> samples;  ///< per pixel
    double seconds = std::numeric_limits<double>::infinity();
    std::optional<double> noise{};  ///< as noise_of()
};

/// How far a task of many parts is.
struct TaskProgress {
    double fraction = 0.0;  ///< [0, 1]
    double seconds = 0.0;   ///< that have passed
    std::optional<double> seconds_left{};
    std::string activity;  ///< what is being done
};

/// How often a message is shown.
enum class Repeat : std::uint8_t {
    never,   ///< the same message is shown once
    always,  ///< each time is news
};

/// Which of several images is rendered.
struct ImageLabel {
    std::optional<int> frame{};
    std::optional<std::string> camera{};
    std::size_t index = 0;
    std::size_t count = 1;
};

/// "frame 12 (3 of 24)", "frame 12, camera front (7 of 48)"; empty when there is one image only.
[[nodiscard]] std::string label_text(const ImageLabel& label);

/// "2.3 %", or "unknown" of an infinite one.
[[nodiscard]] std::string noise_text(double noise);

/// Seconds that are left until `goal`, judged by `progress`; none when nothing is done yet.
[[nodiscard]] std::optional<double> time_left(const Progress& progress, const Goal& goal);

/// Tells the user what happens. Results of `info` do not come through here. Safe from any thread.
class Console {
public:
    Console(Format format, Verbosity verbosity);
    ~Console();
    Console(const Console&) = delete;
    Console& operator=(const Console&) = delete;

    /// `fields` is a JSON object; "event" is added. Does nothing when the format is text, and when
    /// the user wants quiet, but for the event "done".
    void event(std::string_view name, const nlohmann::ordered_json& fields);
    /// A line for people; nothing when the format is JSON.
    void note(std::string_view message, Repeat repeat = Repeat::always);
    /// A line for people, if there is one image only.
    void detail(std::string_view message);
    void warning(std::string_view message, Repeat repeat = Repeat::never);
    /// From now on events have "frame" and "camera", as far as there are any, and progress lines
    /// begin with the label.
    void begin_image(const ImageLabel& label);
    /// Shows how far a render is; as often as suits the reader, however often it is called.
    void progress(const Progress& progress, const Goal& goal);
    /// The same for a task of many parts.
    void task(const TaskProgress& progress);
    /// Ends a progress line, so that whatever prints next starts on its own.
    void end_progress();

private:
    void print_line(std::string_view prefix, std::string_view message);
    void put_event(std::string_view name, const nlohmann::ordered_json& fields);
    void erase_progress();
    [[nodiscard]] bool is_due(double seconds);
    void draw_progress(double fraction, const std::string& text);

    Format format_;
    Verbosity verbosity_;
    bool terminal_;  // stderr is one, and can redraw a line
    bool color_;
    std::mutex mutex_;
    std::size_t drawn_ = 0;  // characters of the progress line on the screen
    ImageLabel label_;
    std::set<std::string, std::less<>> told_;
    double last_shown_ = -std::numeric_limits<double>::infinity();  // [s] of the render
};

/// Prints a result on stdout, text or JSON, without what a terminal would obey.
void print_text(std::string_view text);

/// The one line on stderr for a failure and, in JSON, an event. Throws nothing.
void report_error(Format format, int exit_code, std::string_view message) noexcept;

}  // namespace bdpt::app
