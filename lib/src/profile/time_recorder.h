#pragma once

#include "profile/sample_timer.h"

#include <tbb/combinable.h>

#include <chrono>

namespace bdpt {

/// What samples took, from what was noted on the sheets. `clock_ticks`: reading the clock; a tick
/// takes `tick_seconds`. The times of pixels are not in it.
[[nodiscard]] TimeProfile profile_of(const SampleTicks& samples, double clock_ticks,
                                     double tick_seconds);

/// Where all threads of a render note their times, and what comes of it.
class TimeRecorder {
public:
    /// Times of the pixels of `region` are kept. Takes some microseconds to see how long reading
    /// the clock takes.
    explicit TimeRecorder(const PixelRect& region);

    /// That of the calling thread.
    [[nodiscard]] TimeSheet sheet();
    /// Of all samples so far; `samples_of_pixel` is how many each pixel has, at least one. No
    /// thread is at work.
    [[nodiscard]] TimeProfile profile(std::int64_t samples_of_pixel);

private:
    /// As well as it is known by now.
    [[nodiscard]] double seconds_a_tick() const;

    std::uint64_t start_ticks_;
    std::chrono::steady_clock::time_point start_;
    double clock_ticks_;
    double suspicious_ticks_;
    PixelTicks pixels_;
    tbb::combinable<SampleTicks> samples_;
};

}  // namespace bdpt
