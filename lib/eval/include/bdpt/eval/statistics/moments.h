#pragma once

/// @file
/// Finds the mean and the spread of a stream of numbers.
///
/// @code{.cpp}
/// bdpt::eval::Moments errors;
/// for (const double error : {0.11, 0.09, 0.10}) {
///     errors.add(error);
/// }
/// std::cout << errors.mean() << " +- " << errors.standard_error() << '\n';
/// @endcode

#include <cmath>
#include <cstdint>

namespace bdpt::eval {

/// Running mean and variance of a stream of numbers [Welford 1962].
class Moments {
public:
    void add(double x)
    {
        ++count_;
        const double delta = x - mean_;
        mean_ += delta / static_cast<double>(count_);
        squares_ += delta * (x - mean_);
    }

    [[nodiscard]] std::int64_t count() const { return count_; }
    [[nodiscard]] double mean() const { return mean_; }
    /// Returns the unbiased variance; needs two numbers.
    [[nodiscard]] double variance() const { return squares_ / static_cast<double>(count_ - 1); }
    /// Returns the standard error of the mean.
    [[nodiscard]] double standard_error() const
    {
        return std::sqrt(variance() / static_cast<double>(count_));
    }

private:
    std::int64_t count_ = 0;
    double mean_ = 0.0;
    double squares_ = 0.0;
};

}  // namespace bdpt::eval
