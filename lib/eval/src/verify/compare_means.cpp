#include "verify/compare_means.h"

#include <bdpt/eval/statistics.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace bdpt::eval {

MeanComparison compare_means(const Difference& difference)
{
    MeanComparison result;
    result.found = difference.found;
    result.expected = difference.expected;
    const double distance = difference.found - difference.expected;
    if (distance == 0.0) {
        return result;
    }
    const double tolerance = indifference * std::abs(difference.expected);
    result.error =
        std::sqrt(difference.sample_variance + difference.rare_variance + tolerance * tolerance);
    result.z = result.error > 0.0
                   ? distance / result.error
                   : std::copysign(std::numeric_limits<double>::infinity(), distance);
    const double bound = std::min(1.0, 2.0 * std::exp(-0.5 * result.z * result.z));
    result.p = std::max(bound, student_two_sided_p(result.z, difference.freedom));
    return result;
}

double welch_freedom(const Moments& a, const Moments& b)
{
    const double x = a.variance() / static_cast<double>(a.count());
    const double y = b.variance() / static_cast<double>(b.count());
    const double sum = x + y;
    if (!(sum > 0.0)) {
        return static_cast<double>(std::min(a.count(), b.count()) - 1);
    }
    return sum * sum /
           (x * x / static_cast<double>(a.count() - 1) +
            y * y / static_cast<double>(b.count() - 1));
}

double critical_z(double false_alarm, std::size_t tests)
{
    return std::sqrt(
        2.0 * std::log(2.0 * static_cast<double>(std::max<std::size_t>(tests, 1)) / false_alarm));
}

double detectable_z(double critical, double freedom)
{
    constexpr double ninety_percent = 1.2816;  // quantile of a normal distribution
    return critical + ninety_percent * std::sqrt(1.0 + critical * critical / (2.0 * freedom));
}

}  // namespace bdpt::eval
