#include <bdpt/film/exact_sum.h>

#include <bit>
#include <cmath>

namespace bdpt {
namespace {

constexpr int unit_exponent = -60;  // the low word counts multiples of 2^-60

using Words = ExactSum::Words;

/// Negates in two's complement.
Words negative(const Words& words)
{
    return {.low = ~words.low + 1U, .high = ~words.high + (words.low == 0 ? 1U : 0U)};
}

/// Returns the multiple of the unit nearest to 1.m 2^e, from the float's bits.
Words magnitude(std::uint32_t bits)
{
    const auto biased_exponent = static_cast<int>((bits >> 23U) & 0xffU);
    if (biased_exponent == 0) {
        return {};  // zero or denormal: far below the unit
    }
    const std::uint64_t mantissa = (bits & 0x7fffffU) | 0x800000U;
    const int shift = biased_exponent - 150 - unit_exponent;
    if (shift >= 64) {
        return {.low = 0, .high = mantissa << (shift - 64)};
    }
    if (shift > 0) {
        return {.low = mantissa << shift, .high = mantissa >> (64 - shift)};
    }
    if (shift > -25) {
        const std::uint64_t half = shift < 0 ? std::uint64_t{1} << (-shift - 1) : 0;
        return {.low = (mantissa + half) >> -shift, .high = 0};
    }
    return {};
}

Words to_words(float value)
{
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const bool below_zero = (bits >> 31U) != 0;
    return below_zero ? negative(magnitude(bits)) : magnitude(bits);
}

}  // namespace

ExactSum& ExactSum::operator=(const ExactSum& other) noexcept
{
    low_.store(other.low_.load(std::memory_order_relaxed), std::memory_order_relaxed);
    high_.store(other.high_.load(std::memory_order_relaxed), std::memory_order_relaxed);
    return *this;
}

void ExactSum::add(float value) noexcept
{
    const Words words = to_words(value);
    add_words(words.low, words.high);
}

void ExactSum::add_alone(float value) noexcept
{
    const Words words = to_words(value);
    const std::uint64_t before = low_.load(std::memory_order_relaxed);
    const std::uint64_t low = before + words.low;
    low_.store(low, std::memory_order_relaxed);
    const std::uint64_t high = words.high + (low < before ? 1U : 0U);
    if (high != 0) {
        high_.store(high_.load(std::memory_order_relaxed) + high, std::memory_order_relaxed);
    }
}

void ExactSum::add(const Words& words) noexcept
{
    Words sum = this->words();
    sum += words;
    low_.store(sum.low, std::memory_order_relaxed);
    high_.store(sum.high, std::memory_order_relaxed);
}

void ExactSum::add_words(std::uint64_t low, std::uint64_t high) noexcept
{
    if (low != 0) {
        const std::uint64_t before = low_.fetch_add(low, std::memory_order_relaxed);
        high += before + low < before ? 1U : 0U;
    }
    if (high != 0) {
        high_.fetch_add(high, std::memory_order_relaxed);
    }
}

double ExactSum::Words::value() const noexcept
{
    Words words = *this;
    const bool below_zero = (words.high >> 63U) != 0;
    if (below_zero) {
        words = negative(words);  // otherwise small sums would be differences of large numbers
    }
    const double size = std::ldexp(static_cast<double>(words.high), 64 + unit_exponent) +
                        std::ldexp(static_cast<double>(words.low), unit_exponent);
    return below_zero ? -size : size;
}

bool ExactSum::operator==(const ExactSum& other) const noexcept
{
    return low_.load(std::memory_order_relaxed) == other.low_.load(std::memory_order_relaxed) &&
           high_.load(std::memory_order_relaxed) == other.high_.load(std::memory_order_relaxed);
}

}  // namespace bdpt
