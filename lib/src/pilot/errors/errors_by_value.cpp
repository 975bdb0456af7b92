#include "pilot/errors/errors_by_value.h"

#include <algorithm>
#include <cmath>

namespace bdpt {

void ErrorsByValue::add(double value, double number, double error) noexcept
{
    if (!(number > 0.0)) {
        never_found_ += error;
        return;
    }
    const int last = static_cast<int>(octaves_.size()) - 1;
    // ilogb of zero is less than all exponents, and that of infinity is greater.
    const int exponent = std::clamp(std::ilogb(value), least_exponent, least_exponent + last);
    Octave& octave = octaves_[static_cast<std::size_t>(exponent - least_exponent)];
    octave.number += number;
    octave.light += number * value;
    octave.errors += error;
}

void ErrorsByValue::add(const ErrorsByValue& other) noexcept
{
    for (std::size_t i = 0; i < octaves_.size(); ++i) {
        octaves_[i].number += other.octaves_[i].number;
        octaves_[i].light += other.octaves_[i].light;
        octaves_[i].errors += other.octaves_[i].errors;
    }
    never_found_ += other.never_found_;
}

double ErrorsByValue::without_brightest(double number, double light) const noexcept
{
    double errors = never_found_;
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
        errors += (1.0 - excluded) * octave.errors;
    }
    return errors;
}

}  // namespace bdpt
