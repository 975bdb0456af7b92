#pragma once

#include <cstdint>
#include <optional>

namespace bdpt::eval {

/// Resets the peak memory, so that the next peak is measured from here on. Linux only.
void reset_peak_memory();

/// Returns the peak memory of this process since the reset [bytes]; none where it is unknown.
[[nodiscard]] std::optional<std::uint64_t> peak_memory();

}  // namespace bdpt::eval
