#pragma once

#include "profile/sample_timer.h"

#include <tbb/combinable.h>

#include <chrono>

namespace bdpt {

/// Computes the profile of samples from the times on the sheets. `clock_ticks` is the duration of
/// reading the clock; a tick takes `tick_seconds`. Excludes the times of pixels.
[[nodiscard]] TimeProfile compute_profile(const SampleTicks& samples, double clock_ticks,
                                          double tick_seconds);

/// Collects the times of all threads of a render.
class TimeRecorder {
public:
    /// Stores times of the pixels of `region`. Takes some microseconds to measure the duration of
    /// reading the clock.
    explicit TimeRecorder(const PixelRect& region);

    /// Returns the sheet of the calling thread.
    [[nodiscard]] TimeSheet sheet();
    /// Returns the profile of all samples so far; `samples_of_pixel` is the number of samples of
    /// each pixel, at least one. No thread may be at work.
    [[nodiscard]] TimeProfile profile(std::int64_t samples_of_pixel);

private:
    /// Returns the current estimate.
    [[nodiscard]] double seconds_a_tick() const;

    std::uint64_t start_ticks_;
    std::chrono::steady_clock::time_point start_;
    double clock_ticks_;
    double suspicious_ticks_;
    PixelTicks pixels_;
    tbb::combinable<SampleTicks> samples_;
};

}  // namespace bdpt
