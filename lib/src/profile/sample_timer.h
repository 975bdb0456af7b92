#pragma once

#include "profile/phase_clock.h"
#include "profile/wait_watch.h"

#include <bdpt/pixel_rect.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace bdpt {

/// What the samples of a thread took [ticks].
struct SampleTicks {
    std::array<PhaseTicks, all_phases.size()> phases{};  ///< of clocked samples
    PhaseTicks clocked;  ///< samples that are clocked in phases, a piece each
    PhaseTicks others;   ///< the others
    /// Samples that should have been clocked, but whose thread lost the processor meanwhile: nobody
    /// knows in which phase.
    std::uint64_t interrupted = 0;
};

/// Ticks of all samples of each pixel of a region. A pixel is one thread's at a time.
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
    /// Top row first.
    [[nodiscard]] const std::vector<double>& ticks() const { return ticks_; }

private:
    PixelRect region_;
    std::vector<double> ticks_;
};

/// Where a thread notes what its samples take.
struct TimeSheet {
    PixelTicks& pixels;
    SampleTicks& samples;
    double clock_ticks;       ///< what reading the clock takes
    double suspicious_ticks;  ///< samples above may have waited for a processor
    WaitWatch wait{};
};

/// Times one sample of a pixel, from here to its end, if there is a sheet to note it on.
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

    /// The clock that this sample is to tell its phases, if it was chosen.
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
