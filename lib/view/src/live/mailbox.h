#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <stop_token>

#include "live/live_render.h"

namespace bdpt::view {

/// Effect of a new task on the pass in flight.
enum class Urgency : std::uint8_t {
    when_idle,  ///< none: the pass completes
    soon,       ///< the pass ends as soon as its samples can be kept
    now,        ///< the pass ends at once: its result is obsolete
};

/// Queue of tasks from other threads for the render thread.
class Mailbox {
public:
    using Task = std::function<void()>;

    /// Adds a task. Thread-safe.
    void post(Task task, Urgency urgency);
    /// Runs all queued tasks. If there are none and `waits` is set, it waits for one. Returns false
    /// if closed.
    [[nodiscard]] bool work_off(bool waits);
    /// Waits for a task, for at most `time`. Returns false if none came.
    [[nodiscard]] bool wait_for(std::chrono::milliseconds time);
    /// Stops the pass in flight and all waiting. Thread-safe.
    void close();

    /// Returns the stop tokens of the next pass, which completes unless `may_be_abandoned`. Queued
    /// tasks that would stop it do so.
    [[nodiscard]] PassStops begin_pass(bool may_be_abandoned);

private:
    void stop_pass(Urgency urgency);

    std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<Task> tasks_;
    Urgency urgency_ = Urgency::when_idle;  ///< maximum of the tasks
    bool closed_ = false;
    bool may_be_abandoned_ = false;
    std::stop_source soon_;
    std::stop_source now_;
};

}  // namespace bdpt::view
