#pragma once

/// @file
/// Adds floats in any order, from any thread, to the same bits.
///
/// @code{.cpp}
/// bdpt::ExactSum sum;
/// for (const float value : {1e9f, 1e-9f, -1e9f}) {
///     sum.add(value);
/// }
/// std::cout << sum.value() << '\n';  // 1e-09, where floats would add up to 0
/// @endcode

#include <bdpt/export.h>

#include <atomic>
#include <cstdint>

namespace bdpt {

/// A sum of floats of both signs that is independent of their order: a 128-bit fixed-point number
/// in two's complement, made of two atomic words, the low one with unit 2^-60. A carry out of the
/// low word is added to the high word; both additions commute and wrap around, so any interleaving
/// of threads gives the same bits.
class BDPT_EXPORT ExactSum {
public:
    /// Largest magnitude that may be added. The sum is correct below 2^67: 2^25 times this value.
    static constexpr float max_value = 0x1p42f;

    /// The 128-bit number in multiples of 2^-60, in two's complement. Addition wraps around.
    struct Words {
        std::uint64_t low = 0;
        std::uint64_t high = 0;
        Words& operator+=(const Words& other) noexcept
        {
            low += other.low;
            high += other.high + (low < other.low ? 1U : 0U);
            return *this;
        }
        [[nodiscard]] double value() const noexcept;
        [[nodiscard]] bool operator==(const Words&) const = default;
    };

    ExactSum() = default;
    ExactSum(const ExactSum& other) noexcept { *this = other; }
    ExactSum& operator=(const ExactSum& other) noexcept;

    /// Adds `value`, whose magnitude is at most `max_value`. Safe from any thread.
    void add(float value) noexcept;
    /// Adds `value` several times faster, while no other thread adds.
    void add_alone(float value) noexcept;
    /// Adds another sum. Not safe while other threads add.
    void add(const ExactSum& other) noexcept { add(other.words()); }
    void add(const Words& words) noexcept;
    [[nodiscard]] Words words() const noexcept
    {
        return {.low = low_.load(std::memory_order_relaxed),
                .high = high_.load(std::memory_order_relaxed)};
    }
    [[nodiscard]] double value() const noexcept { return words().value(); }
    [[nodiscard]] bool operator==(const ExactSum& other) const noexcept;

private:
    void add_words(std::uint64_t low, std::uint64_t high) noexcept;

    std::atomic<std::uint64_t> low_{0};
    std::atomic<std::uint64_t> high_{0};
};

}  // namespace bdpt
