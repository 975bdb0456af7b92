#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace bdpt::fuzz {

/// `input` with one to four small changes; the same ones for the same `seed`. Knows a little of
/// what it changes: values of JSON text become extreme ones or change places, and the chunks of a
/// GLB mostly keep lengths that fit, so that changes reach what lies behind the first checks. At
/// most `most` bytes come out.
[[nodiscard]] std::vector<std::uint8_t> mutate(std::span<const std::uint8_t> input,
                                               std::uint64_t seed, std::size_t most);

}  // namespace bdpt::fuzz
