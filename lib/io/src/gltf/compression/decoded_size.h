#pragma once

#include "file/json.h"
#include "file/load_context.h"

#include <cstdint>

namespace bdpt::io {

/// Counts what compressed meshes of a file become, before memory is spent on it.
class DecodedSize {
public:
    explicit DecodedSize(LoadContext& context)
        : limits_(context.limits), memory_(context.budget.memory())
    {}

    /// Counts `count` elements of `size` bytes that `encoded` bytes hold. Throws `Error`
    /// (invalid_input) at `place` when that is more than the limits allow in all, or is packed more
    /// tightly than they believe.
    void add(const JsonPlace& place, std::uint64_t count, std::uint64_t size,
             std::uint64_t encoded);

    /// What may still be added [bytes].
    [[nodiscard]] std::uint64_t left() const { return limits_.buffer_bytes - total_; }

private:
    const ReadLimits& limits_;
    MemoryBudget& memory_;
    std::uint64_t total_ = 0;  // [bytes]
};

}  // namespace bdpt::io
