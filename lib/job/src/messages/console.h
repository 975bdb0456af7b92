#pragma once

#include <bdpt/render.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace bdpt::job {

// What surrounds a job: who hears of it (`Console`), and who stops it (`Interrupt`).

/// Which messages are shown.
enum class Verbosity : std::uint8_t { normal, quiet, verbose };
/// Form of messages.
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

/// Returns the time since `start` [s].
[[nodiscard]] inline double seconds_since(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

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

/// Receives the messages and the progress of a job, and decides which of them are news.
/// Thread-safe. This one shows nothing.
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
    virtual void show_event(std::string_view /*name*/, const nlohmann::ordered_json& /*fields*/) {}
    virtual void show_note(const Note& /*note*/) {}
    virtual void show_verbose(const Note& /*note*/) {}
    virtual void show_warning(std::string_view /*message*/) {}
    virtual void show_progress(const Progress& /*progress*/, const Goal& /*goal*/) {}
    virtual void show_task(const TaskProgress& /*progress*/) {}
    virtual void finish_progress() {}

    std::mutex mutex_;
    ImageLabel label_;
    std::set<std::string, std::less<>> told_;
};

/// What an early end of the process means for its outputs.
struct PendingOutputs {
    std::vector<std::filesystem::path> temporaries;  ///< removed if the process ends early
    bool have_readers = false;                       ///< one is a pipe, which may wait for a reader
};

/// Asks a render to stop.
class Interrupt {
public:
    Interrupt() = default;
    virtual ~Interrupt() = default;
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    virtual void set_outputs(PendingOutputs outputs) = 0;
    /// Allows stops: from now on there is a result worth finishing.
    virtual void allow_stop() = 0;
    /// Forbids stops, until they are allowed again: there is nothing worth finishing.
    virtual void forbid_stop() = 0;
    [[nodiscard]] virtual std::stop_token stop_token() const = 0;
    /// Returns what requested the stop, such as "SIGINT"; none if nothing did.
    [[nodiscard]] virtual std::optional<std::string> stopped_by() const = 0;
    /// Returns whether a checkpoint was requested since the last call.
    [[nodiscard]] virtual bool take_checkpoint_request() = 0;
};

}  // namespace bdpt::job
