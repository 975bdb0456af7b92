#include "profile/wait_watch.h"

#include "profile/phase_clock.h"

#include <algorithm>
#include <chrono>
#include <ctime>

namespace bdpt {
namespace {

std::int64_t wall_nanoseconds() noexcept
{
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/// Returns the CPU time of the thread; without a thread clock the wall time, so that no time is
/// ever lost.
std::int64_t thread_nanoseconds() noexcept
{
#if defined(CLOCK_THREAD_CPUTIME_ID)
    timespec time{};
    if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time) == 0) {
        constexpr std::int64_t nanoseconds_a_second = 1'000'000'000;
        return std::int64_t{time.tv_sec} * nanoseconds_a_second + time.tv_nsec;
    }
#endif
    return wall_nanoseconds();
}

}  // namespace

void WaitWatch::note_now() noexcept
{
    ticks_ = read_ticks();
    wall_ = wall_nanoseconds();
    cpu_ = thread_nanoseconds();
}

double WaitWatch::lost_ticks() noexcept
{
    const WaitWatch before = *this;
    note_now();
    const auto wall = static_cast<double>(wall_ - before.wall_);
    const auto ran = static_cast<double>(cpu_ - before.cpu_);
    return wall > 0.0 ? static_cast<double>(ticks_ - before.ticks_) *
                            std::clamp(1.0 - ran / wall, 0.0, 1.0)
                      : 0.0;
}

}  // namespace bdpt
