#pragma once

#include <cstdint>

namespace bdpt {

/// Tells how long the calling thread had no processor, because others had it. Reading it is a call
/// of the system, so it is for the rare sample that took suspiciously long.
class WaitWatch {
public:
    /// Watches from now on.
    WaitWatch() noexcept { note_now(); }

    /// Ticks since the last call, or the begin, in which the thread did not run; 0 where the system
    /// has no clock of threads. By the thread that made this object.
    [[nodiscard]] double lost_ticks() noexcept;

private:
    void note_now() noexcept;

    std::uint64_t ticks_ = 0;
    std::int64_t wall_ = 0;  // [ns]
    std::int64_t cpu_ = 0;   // of the thread [ns]
};

}  // namespace bdpt
