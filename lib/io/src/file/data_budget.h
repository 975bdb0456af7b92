#pragma once

#include <bdpt/io/memory_budget.h>
#include <bdpt/io/read_limits.h>

#include <cstdint>
#include <memory>
#include <string>

namespace bdpt::io {

/// What the decoded vertices, triangles, key frames, light profiles and instances of one file cost,
/// and all that it takes together. An accessor counts each time it is used: a few bytes of JSON may
/// name one of gigabytes a thousand times.
class DataBudget {
public:
    /// `memory` is for all that the file takes; null: one of `ReadLimits::memory_bytes` alone.
    explicit DataBudget(const ReadLimits& limits, std::shared_ptr<MemoryBudget> memory = nullptr);

    /// Takes `count` elements of `size` bytes. `place` is the JSON pointer to what needs them.
    /// Throws `Error` (invalid_input) that names place, need and limit when there is no more.
    void spend(const std::string& place, std::uint64_t count, std::uint64_t size);

    /// For what is no vertex, key frame, light profile or instance.
    [[nodiscard]] MemoryBudget& memory() { return *memory_; }
    [[nodiscard]] const MemoryBudget& memory() const { return *memory_; }

private:
    std::uint64_t limit_ = 0;  // [bytes]
    std::uint64_t spent_ = 0;  // [bytes]
    std::shared_ptr<MemoryBudget> memory_;
};

}  // namespace bdpt::io
