#pragma once

#include "profile/phase_clock.h"
#include "profile/wait_watch.h"

#include <bdpt/pixel_rect.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace bdpt {

/// Time of the samples of a thread [ticks].
struct SampleTicks {
    std::array<PhaseTicks, all_phases.size()> phases{};  ///< of samples timed by phase
    PhaseTicks clocked;  ///< samples that are timed by phase, one interval each
    PhaseTicks others;   ///< all other samples
    /// Samples that should have been timed, but whose thread was preempted: their phases are
    /// unknown.
    std::uint64_t interrupted = 0;
};

/// Ticks of all samples of each pixel of a region. A pixel belongs to one thread at a time.
class PixelTicks {
public:
    explicit PixelTicks(const PixelRect& region)
        : region_(region),
          ticks_(static_cast<std::size_t>(region.width()) *
                 static_cast<std::size_t>(region.height()))
    {}

    void add(int x, int y, double ticks) noexcept
    {
        if (region_.contains(x, y)) {
            const auto row = static_cast<std::size_t>(y - region_.y0);
            ticks_[row * static_cast<std::size_t>(region_.width()) +
                   static_cast<std::size_t>(x - region_.x0)] += ticks;
        }
    }
    [[nodiscard]] const PixelRect& region() const { return region_; }
    /// Returns the ticks, top row first.
    [[nodiscard]] const std::vector<double>& ticks() const { return ticks_; }

private:
    PixelRect region_;
    std::vector<double> ticks_;
};

/// Storage for the times of a thread's samples.
struct TimeSheet {
    PixelTicks& pixels;
    SampleTicks& samples;
    double clock_ticks;       ///< duration of reading the clock
    double suspicious_ticks;  ///< longer samples may have waited for a processor
    WaitWatch wait{};
};

/// Times one sample of a pixel, from construction to destruction, if there is a sheet.
class SampleTimer {
public:
    SampleTimer(TimeSheet* sheet, int x, int y, std::int64_t index) noexcept
        : sheet_(sheet), x_(x), y_(y)
    {
        if (sheet_ != nullptr) {
            start(index);
        }
    }
    ~SampleTimer()
    {
        if (sheet_ != nullptr) {
            finish();
        }
    }
    SampleTimer(const SampleTimer&) = delete;
    SampleTimer& operator=(const SampleTimer&) = delete;

    /// Returns the clock for the phases of this sample, if it was chosen; else null.
    [[nodiscard]] PhaseClock* clock() noexcept { return clock_ ? &*clock_ : nullptr; }

private:
    void start(std::int64_t index) noexcept;
    void finish() noexcept;
    void note_phases() noexcept;

    TimeSheet* sheet_;
    int x_;
    int y_;
    std::optional<PhaseClock> clock_;
    std::uint64_t begin_ = 0;
};

}  // namespace bdpt
