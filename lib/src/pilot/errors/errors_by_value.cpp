#include "pilot/errors/errors_by_value.h"

#include <algorithm>
#include <cmath>

namespace bdpt {
namespace {

void accumulate(ErrorsByValue::Sums& to, const ErrorsByValue::Sums& sums, double factor = 1.0)
{
    to.errors += factor * sums.errors;
    to.squares += factor * sums.squares;
}

}  // namespace

void ErrorsByValue::add(double value, double number, double error) noexcept
{
    const Sums sums{.errors = error, .squares = error * error};
    if (!(number > 0.0)) {
        accumulate(never_found_, sums);
        return;
    }
    const int last = static_cast<int>(octaves_.size()) - 1;
    // ilogb of zero is less than all exponents, and that of infinity is greater.
    const int exponent = std::clamp(std::ilogb(value), least_exponent, least_exponent + last);
    Octave& octave = octaves_[static_cast<std::size_t>(exponent - least_exponent)];
    octave.number += number;
    octave.light += number * value;
    accumulate(octave.sums, sums);
}

void ErrorsByValue::add(const ErrorsByValue& other) noexcept
{
    for (std::size_t i = 0; i < octaves_.size(); ++i) {
        octaves_[i].number += other.octaves_[i].number;
        octaves_[i].light += other.octaves_[i].light;
        accumulate(octaves_[i].sums, other.octaves_[i].sums);
    }
    accumulate(never_found_, other.never_found_);
}

ErrorsByValue::Sums ErrorsByValue::without_brightest(double number, double light) const noexcept
{
    Sums result = never_found_;
    double excluded = 1.0;  // fraction of the octave
    for (std::size_t i = octaves_.size(); i-- > 0;) {
        const Octave& octave = octaves_[i];
        if (!(octave.number > 0.0)) {
            continue;
        }
        // Below the octave that reached the limit, everything counts.
        excluded =
            excluded < 1.0 ? 0.0 : std::min({1.0, number / octave.number, light / octave.light});
        number -= excluded * octave.number;
        light -= excluded * octave.light;
        accumulate(result, octave.sums, 1.0 - excluded);
    }
    return result;
}

}  // namespace bdpt
