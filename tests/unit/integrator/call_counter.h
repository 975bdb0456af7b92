#pragma once

#include <cstdint>

namespace bdpt::test {

/// What a thread has asked the C and C++ runtime for.
struct RuntimeCalls {
    std::uint64_t allocations = 0;  ///< malloc and its kin, `new` among them
    std::uint64_t locks = 0;        ///< POSIX mutexes and the like, std::mutex among them
    std::uint64_t throws = 0;       ///< exceptions

    [[nodiscard]] bool operator==(const RuntimeCalls&) const = default;
};

[[nodiscard]] inline RuntimeCalls operator-(const RuntimeCalls& a, const RuntimeCalls& b)
{
    return {.allocations = a.allocations - b.allocations,
            .locks = a.locks - b.locks,
            .throws = a.throws - b.throws};
}

/// Of the calling thread, since it started. The executable defines the runtime's functions itself,
/// so the calls of all libraries that are not inside of libc count.
[[nodiscard]] RuntimeCalls runtime_calls() noexcept;

}  // namespace bdpt::test
