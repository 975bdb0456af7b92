#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <stop_token>

#include "view/live_render.h"

namespace bdpt::app {

/// What happens to the pass in flight when a task comes.
enum class Urgency : std::uint8_t {
    when_idle,  ///< it goes on to its end
    soon,       ///< it ends as soon as what it has can be kept
    now,        ///< nobody wants to see it any more
};

/// Tasks of other threads for the one that renders.
class Mailbox {
public:
    using Task = std::function<void()>;

    /// From any thread.
    void post(Task task, Urgency urgency);
    /// Does all tasks that are there. Without any it waits for one first, if that is asked for.
    /// False: it is closed.
    [[nodiscard]] bool work_off(bool waits);
    /// Waits for a task, for at most `time`. False: none came.
    [[nodiscard]] bool wait_for(std::chrono::milliseconds time);
    /// Stops the pass in flight, and whoever waits. From any thread.
    void close();

    /// For the next pass, which is left alone until it ends unless `may_be_abandoned`. If there are
    /// tasks by now that would stop it, they do.
    [[nodiscard]] PassStops begin_pass(bool may_be_abandoned);

private:
    void stop_pass(Urgency urgency);

    std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<Task> tasks_;
    Urgency urgency_ = Urgency::when_idle;  ///< the greatest of the tasks
    bool closed_ = false;
    bool may_be_abandoned_ = false;
    std::stop_source soon_;
    std::stop_source now_;
};

}  // namespace bdpt::app
