#pragma once

#include <cstdint>
#include <optional>

namespace bdpt::eval {

/// Forgets the peak of memory, so that the next one is that of what comes now. Linux only.
void reset_peak_memory();

/// The most memory that this process had since then [bytes]; none where it cannot be told.
[[nodiscard]] std::optional<std::uint64_t> peak_memory();

}  // namespace bdpt::eval
