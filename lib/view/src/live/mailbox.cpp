#include "live/live_render.h"

#include <algorithm>
#include <utility>

namespace bdpt::view {

void Mailbox::stop_pass(Urgency urgency)
{
    if (urgency == Urgency::when_idle) {
        return;
    }
    soon_.request_stop();
    if (urgency == Urgency::now && may_be_abandoned_) {
        now_.request_stop();
    }
}

void Mailbox::post(Task task, Urgency urgency)
{
    const std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(task));
    urgency_ = std::max(urgency_, urgency);
    stop_pass(urgency);
    wake_.notify_one();
}

bool Mailbox::work_off(bool waits)
{
    std::unique_lock lock(mutex_);
    if (waits) {
        wake_.wait(lock, [this] { return closed_ || !tasks_.empty(); });
    }
    while (!tasks_.empty() && !closed_) {
        const Task task = std::move(tasks_.front());
        tasks_.pop_front();
        lock.unlock();
        task();
        lock.lock();
    }
    urgency_ = Urgency::when_idle;
    return !closed_;
}

bool Mailbox::wait_for(std::chrono::milliseconds time)
{
    std::unique_lock lock(mutex_);
    return wake_.wait_for(lock, time, [this] { return closed_ || !tasks_.empty(); });
}

void Mailbox::close()
{
    const std::lock_guard lock(mutex_);
    closed_ = true;
    soon_.request_stop();
    now_.request_stop();
    wake_.notify_one();
}

PassStops Mailbox::begin_pass(bool may_be_abandoned)
{
    const std::lock_guard lock(mutex_);
    soon_ = {};
    now_ = {};
    may_be_abandoned_ = may_be_abandoned;
    stop_pass(urgency_);
    if (closed_) {
        soon_.request_stop();
        now_.request_stop();
    }
    return {.soon = soon_.get_token(), .now = now_.get_token()};
}

}  // namespace bdpt::view
