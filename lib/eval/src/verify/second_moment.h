#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace bdpt::eval {

/// Sum of squares of observed or expected samples, binned by their size in steps of a factor of 4.
class SecondMoment {
public:
    /// Adds `moment`, the contribution of samples of `size` to the second moment; both are at least
    /// 0.
    void add(double size, double moment)
    {
        if (moment > 0.0) {
            sums_[bin(size)] += std::min(moment, most);
        }
    }
    SecondMoment& operator+=(const SecondMoment& other)
    {
        for (std::size_t i = 0; i < sums_.size(); ++i) {
            sums_[i] += other.sums_[i];
        }
        return *this;
    }
    /// Returns the second moment of samples of at least this size; includes some that are smaller
    /// by a factor of up to 4.
    [[nodiscard]] double above(double size) const
    {
        double sum = 0.0;
        for (std::size_t i = bin(size); i < sums_.size(); ++i) {
            sum += sums_[i];
        }
        return sum;
    }

private:
    static constexpr double most = 1e150;  // greater than in any scene; sums of it are finite
    static constexpr int bins = 48;

    /// Returns the bin of a size from 4^-24 to 4^23 nit.
    static std::size_t bin(double size)
    {
        int exponent = 0;
        std::frexp(size, &exponent);
        return static_cast<std::size_t>(std::clamp((exponent + bins) / 2, 0, bins - 1));
    }

    std::array<double, bins> sums_{};
};

}  // namespace bdpt::eval
