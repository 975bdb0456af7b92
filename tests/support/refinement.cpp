#include "refinement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace bdpt::test {
namespace {

constexpr int max_batches = 1 << 24;

/// Rounds up to a number of batches.
int to_batches(double wanted)
{
    return static_cast<int>(std::min(std::ceil(wanted), static_cast<double>(max_batches)));
}

/// Returns the batches that `other` needs in a cell if the remaining error has the variance `rest`.
int needed(const BatchEvidence& other, std::size_t cell, double rest)
{
    const double least = other.variance[cell] == 0.0 ? 0.0
                         : rest > 0.0                ? other.variance[cell] / rest
                                                     : std::numeric_limits<double>::infinity();
    return std::max(other.batches[cell], to_batches(least));
}

/// Numbers of batches of the cells `which`, and their cost.
struct Choice {
    int first = max_batches;  ///< batches of the first renderer, in each of those cells
    std::array<int, compared_cells> second{};
    double work = std::numeric_limits<double>::infinity();
};

/// Returns the choice if the first renderer has `first` batches.
Choice with_first(const BatchEvidence& a, const BatchEvidence& b, double variance,
                  std::span<const std::size_t> which, int first)
{
    Choice choice{.first = first};
    int most = 0;
    int sum = 0;
    for (const std::size_t i : which) {
        choice.second[i] = needed(b, i, variance - a.variance[i] / first);
        most = std::max(most, choice.second[i]);
        sum += choice.second[i];
    }
    if (b.cells == CellBatches::common) {
        choice.second.fill(most);
        sum = most * static_cast<int>(which.size());
    }
    choice.work = a.work * first * static_cast<double>(which.size()) + b.work * sum;
    return choice;
}

/// Searches the cheapest choice: the work has one minimum.
Choice cheapest(const BatchEvidence& a, const BatchEvidence& b, double variance,
                std::span<const std::size_t> which)
{
    double first = 1.0;
    for (const std::size_t i : which) {
        first = std::max({first, static_cast<double>(a.batches[i]), a.variance[i] / variance});
    }
    Choice best = with_first(a, b, variance, which, to_batches(first));
    for (int step = 0; step < 80 && first < max_batches; ++step) {
        first *= 1.1;
        const Choice choice = with_first(a, b, variance, which, to_batches(first));
        if (choice.work < best.work) {
            best = choice;
        }
    }
    return best;
}

}  // namespace

BatchPlan min_work(const BatchEvidence& a, const BatchEvidence& b, double error)
{
    if (a.cells == CellBatches::separate && b.cells == CellBatches::common) {
        const BatchPlan swapped = min_work(b, a, error);
        return {.a = swapped.b, .b = swapped.a};
    }
    constexpr std::array<std::size_t, compared_cells> all{0, 1, 2, 3};
    const std::size_t together = a.cells == CellBatches::common ? compared_cells : 1;
    BatchPlan plan{};
    for (std::size_t begin = 0; begin < compared_cells; begin += together) {
        const auto which = std::span(all).subspan(begin, together);
        const Choice choice = cheapest(a, b, error * error, which);
        for (const std::size_t i : which) {
            plan.a[i] = choice.first;
            plan.b[i] = choice.second[i];
        }
    }
    return plan;
}

}  // namespace bdpt::test
