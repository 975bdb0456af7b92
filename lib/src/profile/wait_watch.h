#pragma once

#include <cstdint>

namespace bdpt {

/// Measures how long the calling thread was preempted. Reading it is a system call, so it is used
/// only for rare samples that took suspiciously long.
class WaitWatch {
public:
    /// Starts watching.
    WaitWatch() noexcept { note_now(); }

    /// Returns the ticks since the last call, or the start, in which the thread did not run; 0 if
    /// the system has no thread clock. To be called by the thread that constructed this object.
    [[nodiscard]] double lost_ticks() noexcept;

private:
    void note_now() noexcept;

    std::uint64_t ticks_ = 0;
    std::int64_t wall_ = 0;  // [ns]
    std::int64_t cpu_ = 0;   // CPU time of the thread [ns]
};

}  // namespace bdpt
