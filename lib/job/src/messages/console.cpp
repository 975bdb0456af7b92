#include "messages/console.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "messages/text.h"

namespace bdpt::job {

using nlohmann::ordered_json;

std::string noise_text(double noise)
{
    if (!std::isfinite(noise)) {
        return "unknown";
    }
    return noise < 0.1 ? fmt::format("{:.2g} %", 100.0 * noise)
                       : fmt::format("{:.0f} %", 100.0 * noise);
}

std::string label_text(const ImageLabel& label)
{
    if (label.count == 1) {
        return "";
    }
    std::string text = label.frame ? fmt::format("frame {}", *label.frame) : "";
    if (label.camera) {
        text += fmt::format("{}camera {}", text.empty() ? "" : ", ", one_line(*label.camera));
    }
    return fmt::format("{} ({} of {})", text, label.index + 1, label.count);
}

double fraction_done(const Progress& progress, const Goal& goal)
{
    const double by_time = progress.seconds / goal.seconds;
    const double by_samples = goal.samples ? static_cast<double>(progress.samples_done) /
                                                 static_cast<double>(*goal.samples)
                                           : 0.0;
    return std::clamp(std::max(by_time, by_samples), 0.0, 1.0);
}

std::optional<double> time_left(const Progress& progress, const Goal& goal)
{
    if (progress.samples_done <= 0) {
        return std::nullopt;
    }
    double left = goal.seconds - progress.seconds;
    if (goal.samples) {
        const double per_sample = progress.seconds / static_cast<double>(progress.samples_done);
        left =
            std::min(left, per_sample * static_cast<double>(*goal.samples - progress.samples_done));
    }
    return std::max(left, 0.0);
}

void Console::event(std::string_view name, const ordered_json& fields)
{
    const std::lock_guard lock(mutex_);
    show_event(name, fields);
}

void Console::note(std::string_view message, Repeat repeat)
{
    note(Note{.code = "", .text = std::string(message)}, repeat);
}

void Console::note(const Note& note, Repeat repeat)
{
    const std::lock_guard lock(mutex_);
    if (told_.insert(note.text).second || repeat == Repeat::always) {
        show_note(note);
    }
}

void Console::verbose(const Note& note)
{
    const std::lock_guard lock(mutex_);
    if (told_.emplace(note.code).second) {
        show_verbose(note);
    }
}

void Console::detail(std::string_view message)
{
    if (label_.count == 1) {
        note(message);
    }
}

void Console::begin_image(const ImageLabel& label)
{
    const std::lock_guard lock(mutex_);
    label_ = label;
}

void Console::warning(std::string_view message, Repeat repeat)
{
    const std::lock_guard lock(mutex_);
    if (told_.emplace(message).second || repeat == Repeat::always) {
        show_warning(message);
    }
}

void Console::progress(const Progress& progress, const Goal& goal)
{
    const std::lock_guard lock(mutex_);
    show_progress(progress, goal);
}

void Console::task(const TaskProgress& progress)
{
    const std::lock_guard lock(mutex_);
    show_task(progress);
}

void Console::end_progress()
{
    const std::lock_guard lock(mutex_);
    finish_progress();
}

}  // namespace bdpt::job
