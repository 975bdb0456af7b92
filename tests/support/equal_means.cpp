#include "equal_means.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

namespace bdpt::test {
namespace {

constexpr double ninety_percent = 1.2816;  // quantile of the normal distribution
constexpr int first_batches = 32;

/// Returns the two-sided quantile of the normal distribution at tail probability `p`, by bisection.
double critical_value(double p)
{
    double low = 0.0;
    double high = 20.0;
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (std::erfc(middle / std::sqrt(2.0)) > p ? low : high) = middle;
    }
    return low;
}

/// Returns the quantile of Student's t distribution, given that of the normal one [Abramowitz and
/// Stegun 1964, 26.7.5]. With 32 batches a normal quantile would raise six times the promised false
/// alarms.
double critical_t(double z, double degrees_of_freedom)
{
    const double n = degrees_of_freedom;
    const double z2 = z * z;
    return z * (1.0 + (z2 + 1.0) / (4.0 * n) + ((5.0 * z2 + 16.0) * z2 + 3.0) / (96.0 * n * n) +
                (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / (384.0 * n * n * n));
}

/// Comparison in one cell.
struct Cell {
    double difference;
    double error;               // standard error of `difference`
    double size;                // reference value of a relative bias
    double degrees_of_freedom;  // of `error`
};

/// Returns the degrees of freedom of the standard error of a difference [Welch 1947].
double degrees_of_freedom(const Moments& x, const Moments& y)
{
    const double a = std::pow(x.standard_error(), 2);
    const double b = std::pow(y.standard_error(), 2);
    const double spread =
        a * a / static_cast<double>(x.count() - 1) + b * b / static_cast<double>(y.count() - 1);
    return spread > 0.0 ? (a + b) * (a + b) / spread
                        : static_cast<double>(std::min(x.count(), y.count()) - 1);
}

MeanComparison compare_cells(const std::function<Cell(std::size_t)>& cell,
                             const Sharpness& sharpness)
{
    const double each = 1.0 - std::pow(1.0 - sharpness.false_alarm, 1.0 / TileMeans::cells);
    const double normal = critical_value(each);
    MeanComparison result{.equal = true};
    std::size_t black = 0;
    for (std::size_t i = 0; i < TileMeans::cells; ++i) {
        const Cell c = cell(i);
        if (!(c.size > 0.0)) {
            ++black;
            continue;
        }
        result.max_bias = std::max(result.max_bias, std::abs(c.difference) / c.size);
        if (c.error == 0.0 && c.difference == 0.0) {
            continue;
        }
        const double z = std::abs(c.difference) / std::max(c.error, 1e-7 * c.size);
        const double critical = critical_t(normal, c.degrees_of_freedom);
        result.critical_z = std::max(result.critical_z, critical);
        if (z > critical) {
            result.equal = false;
            result.found_bias = std::max(result.found_bias, std::abs(c.difference) / c.size);
        }
        if (z > result.worst_z) {
            result.worst_z = z;
            result.worst_bias = c.difference / c.size;
        }
        result.detectable_bias =
            std::max(result.detectable_bias, (critical + ninety_percent) * c.error / c.size);
    }
    if (black == TileMeans::cells) {
        result.detectable_bias = std::max(result.detectable_bias, 1.0);  // nothing can be found
    }
    result.sharp_enough = result.detectable_bias <= sharpness.detectable_bias;
    return result;
}

/// Returns the joint means of both, or 0 where they are not above 0.
std::array<double, TileMeans::cells> common_means(const TileMeans& a, const TileMeans& b)
{
    std::array<double, TileMeans::cells> means{};
    for (std::size_t i = 0; i < means.size(); ++i) {
        means[i] = std::max(0.0, 0.5 * (a.cell_moments()[i].mean() + b.cell_moments()[i].mean()));
    }
    return means;
}

/// Renders the batches missing from `wanted`: at most four times the existing ones, as errors are
/// estimates, and at most `most`. Each cell gets at least a quarter of the noisiest cell's, as rare
/// light that was seen there may be in the others too. Returns false if all batches are there.
bool refine(TileMeans& means, const std::array<int, TileMeans::cells>& wanted, int most)
{
    std::array<int, TileMeans::cells> next{};
    bool more = false;
    for (std::size_t i = 0; i < next.size(); ++i) {
        const int have = static_cast<int>(means.cell_moments()[i].count());
        next[i] = have;
        if (wanted[i] > have && have < most) {
            next[i] = std::min({std::max(wanted[i], have + 8), 4 * have, most});
            more = true;
        }
    }
    const int least = *std::max_element(next.begin(), next.end()) / 4;
    for (int& batches : next) {
        batches = std::max(batches, least);
    }
    means.refine_to(next);
    return more;
}

/// Returns the standard error to aim at, relative to the mean: a little less than needed.
double wanted_error(const MeanComparison& result, const Sharpness& sharpness)
{
    return sharpness.detectable_bias / (result.critical_z + ninety_percent) / std::sqrt(1.1);
}

}  // namespace

std::string MeanComparison::text() const
{
    std::ostringstream out;
    out << "worst tile differs by " << 100.0 * worst_bias << " % (z = " << worst_z << ", critical "
        << critical_z << "); detectable bias " << 100.0 * detectable_bias << " % after " << batches
        << " batches";
    return out.str();
}

MeanComparison compare_means(TileMeans& a, TileMeans& b, const Sharpness& sharpness)
{
    a.refine_to(first_batches);
    b.refine_to(first_batches);
    for (;;) {
        MeanComparison result = compare_cells(
            [&](std::size_t i) {
                const Moments& x = a.cell_moments()[i];
                const Moments& y = b.cell_moments()[i];
                return Cell{.difference = y.mean() - x.mean(),
                            .error = std::hypot(x.standard_error(), y.standard_error()),
                            .size = 0.5 * (x.mean() + y.mean()),
                            .degrees_of_freedom = degrees_of_freedom(x, y)};
            },
            sharpness);
        result.batches = std::min(a.batches(), b.batches());
        if (result.sharp_enough) {
            return result;
        }
        const auto means = common_means(a, b);
        const BatchPlan plan =
            min_work(a.evidence(means), b.evidence(means), wanted_error(result, sharpness));
        const bool more_of_a = refine(a, plan.a, sharpness.max_batches);
        const bool more_of_b = refine(b, plan.b, sharpness.max_batches);
        if (!more_of_a && !more_of_b) {
            return result;
        }
    }
}

MeanComparison compare_means(TileMeans& a, double expected, const Sharpness& sharpness)
{
    a.refine_to(first_batches);
    std::array<double, TileMeans::cells> means{};
    means.fill(expected);
    for (;;) {
        MeanComparison result = compare_cells(
            [&](std::size_t i) {
                const Moments& x = a.cell_moments()[i];
                return Cell{.difference = x.mean() - expected,
                            .error = x.standard_error(),
                            .size = expected,
                            .degrees_of_freedom = static_cast<double>(x.count() - 1)};
            },
            sharpness);
        result.batches = a.batches();
        const BatchPlan plan =
            min_work(a.evidence(means), BatchEvidence{}, wanted_error(result, sharpness));
        if (result.sharp_enough || !refine(a, plan.a, sharpness.max_batches)) {
            return result;
        }
    }
}

}  // namespace bdpt::test
