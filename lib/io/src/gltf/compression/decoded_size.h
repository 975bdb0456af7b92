#pragma once

#include "file/json.h"
#include "file/load_context.h"

#include <cstdint>

namespace bdpt::io {

/// Tracks the decoded size of compressed meshes of a file, before memory is allocated for it.
class DecodedSize {
public:
    explicit DecodedSize(LoadContext& context)
        : limits_(context.limits), memory_(context.budget.memory())
    {}

    /// Counts `count` elements of `size` bytes that `encoded` bytes hold. Throws `Error`
    /// (invalid_input) at `place` if the total exceeds the limits, or the compression ratio does.
    void add(const JsonPlace& place, std::uint64_t count, std::uint64_t size,
             std::uint64_t encoded);

    /// Returns how much may still be added [bytes].
    [[nodiscard]] std::uint64_t left() const { return limits_.buffer_bytes - total_; }

private:
    const ReadLimits& limits_;
    MemoryBudget& memory_;
    std::uint64_t total_ = 0;  // [bytes]
};

}  // namespace bdpt::io
