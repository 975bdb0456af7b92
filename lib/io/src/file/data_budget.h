#pragma once

#include <bdpt/io/read_limits.h>

#include <cstdint>
#include <memory>
#include <string>

namespace bdpt::io {

/// Budget of the decoded vertices, triangles, key frames, light profiles and instances of one file,
/// and of all its memory. An accessor counts each time it is used: a few bytes of JSON may name one
/// of gigabytes a thousand times.
class DataBudget {
public:
    /// `memory` is the budget for everything in the file; null: a budget of
    /// `ReadLimits::memory_bytes`.
    explicit DataBudget(const ReadLimits& limits, std::shared_ptr<MemoryBudget> memory = nullptr);

    /// Charges `count` elements of `size` bytes. `place` is the JSON pointer to their user. Throws
    /// `Error` (invalid_input) that names place, need and limit if the budget is exceeded.
    void spend(const std::string& place, std::uint64_t count, std::uint64_t size);

    /// Returns the budget for everything other than vertices, key frames, light profiles and
    /// instances.
    [[nodiscard]] MemoryBudget& memory() { return *memory_; }
    [[nodiscard]] const MemoryBudget& memory() const { return *memory_; }

private:
    std::uint64_t limit_ = 0;  // [bytes]
    std::uint64_t spent_ = 0;  // [bytes]
    std::shared_ptr<MemoryBudget> memory_;
};

}  // namespace bdpt::io
