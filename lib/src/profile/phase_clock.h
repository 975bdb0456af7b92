#pragma once

#include <bdpt/time_profile.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace bdpt {

/// Returns the time in ticks of a fixed but unknown length: the time stamp counter, which takes
/// less than half of the time of std::chrono's clock, or that clock if there is none.
[[nodiscard]] inline std::uint64_t read_ticks() noexcept
{
#if defined(__x86_64__) && defined(__GNUC__)
    return __builtin_ia32_rdtsc();
#else
    return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
#endif
}

/// Ticks in a phase, and the number of intervals.
struct PhaseTicks {
    std::uint64_t ticks = 0;
    std::uint64_t pieces = 0;
};

/// Measures how long a thread spends in each phase.
class PhaseClock {
public:
    PhaseClock() noexcept : since_(read_ticks()) {}

    /// Attributes the time since the last call to the current phase, and starts `phase`.
    void enter(Phase phase) noexcept
    {
        const std::uint64_t now = read_ticks();
        PhaseTicks& spent = spent_[static_cast<std::size_t>(phase_)];
        spent.ticks += now - since_;
        ++spent.pieces;
        since_ = now;
        phase_ = phase;
    }
    [[nodiscard]] Phase phase() const noexcept { return phase_; }
    /// Returns the ticks up to the last call of enter().
    [[nodiscard]] const std::array<PhaseTicks, all_phases.size()>& spent() const noexcept
    {
        return spent_;
    }

private:
    std::array<PhaseTicks, all_phases.size()> spent_{};
    std::uint64_t since_;
    Phase phase_ = Phase::walk;
};

/// Enters a phase, and returns to the previous one at its end. Does nothing without a clock.
class PhaseScope {
public:
    PhaseScope(PhaseClock* clock, Phase phase) noexcept
        : clock_(clock), before_(clock != nullptr ? clock->phase() : phase)
    {
        if (clock_ != nullptr) [[unlikely]] {
            clock_->enter(phase);
        }
    }
    ~PhaseScope()
    {
        if (clock_ != nullptr) [[unlikely]] {
            clock_->enter(before_);
        }
    }
    PhaseScope(const PhaseScope&) = delete;
    PhaseScope& operator=(const PhaseScope&) = delete;

private:
    PhaseClock* clock_;
    Phase before_;
};

}  // namespace bdpt
