// How batches are shared out between two renderers that are compared.

#include "refinement.h"

#include "catch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace bdpt::test::refinement_test {
namespace {

constexpr std::array<int, compared_cells> some{32, 32, 32, 32};
constexpr double error = 0.01;

double variance_after(const BatchEvidence& a, const BatchEvidence& b, const BatchPlan& plan,
                      std::size_t cell)
{
    return a.variance[cell] / plan.a[cell] + b.variance[cell] / plan.b[cell];
}

double work_of(const BatchEvidence& a, const BatchEvidence& b, const BatchPlan& plan)
{
    double work = 0.0;
    for (std::size_t i = 0; i < compared_cells; ++i) {
        work += a.work * plan.a[i] + b.work * plan.b[i];
    }
    return work;
}

/// The same number for both, in all cells, as one would do without thinking.
BatchPlan equal_shares(const BatchEvidence& a, const BatchEvidence& b)
{
    double most = 0.0;
    for (std::size_t i = 0; i < compared_cells; ++i) {
        most = std::max(most, a.variance[i] + b.variance[i]);
    }
    BatchPlan plan{};
    plan.a.fill(static_cast<int>(std::ceil(most / (error * error))));
    plan.b = plan.a;
    return plan;
}

}  // namespace

TEST_CASE("batches go where they help most for their work", "[statistics]")
{
    const auto a_cells = GENERATE(CellBatches::separate, CellBatches::common);
    const auto b_cells = GENERATE(CellBatches::separate, CellBatches::common);
    const BatchEvidence a{
        .variance = {0.9, 0.1, 0.2, 0.5}, .batches = some, .work = 1.0, .cells = a_cells};
    const BatchEvidence b{
        .variance = {0.04, 0.02, 0.02, 0.08}, .batches = some, .work = 3.0, .cells = b_cells};
    const BatchPlan plan = min_work(a, b, error);
    for (std::size_t i = 0; i < compared_cells; ++i) {
        INFO("cell " << i << ": " << plan.a[i] << " and " << plan.b[i]);
        CHECK(variance_after(a, b, plan, i) <= error * error * (1.0 + 1e-9));
        CHECK(plan.a[i] >= some[i]);
        CHECK((a_cells == CellBatches::separate || plan.a[i] == plan.a[0]));
        CHECK((b_cells == CellBatches::separate || plan.b[i] == plan.b[0]));
    }
    CHECK(plan.a[0] > 2 * plan.b[0]);
    CHECK(work_of(a, b, plan) < 0.6 * work_of(a, b, equal_shares(a, b)));
    const BatchPlan swapped = min_work(b, a, error);
    CHECK(work_of(b, a, swapped) == Approx(work_of(a, b, plan)).epsilon(0.02));
}

TEST_CASE("the least work of one cell is where its derivatives are zero", "[statistics]")
{
    // n_a / n_b = sqrt(variance_a / variance_b * work_b / work_a), by Lagrange.
    BatchEvidence a{.work = 1.0};
    BatchEvidence b{.work = 4.0};
    a.variance.fill(0.09);
    b.variance.fill(0.16);
    const BatchPlan plan = min_work(a, b, error);
    // (0.3 + 0.8) 0.3 and (0.3 + 0.8) 0.4 / 2 over the error squared.
    CHECK(plan.a[2] == Approx(3300).epsilon(0.06));
    CHECK(plan.b[2] == Approx(2200).epsilon(0.06));
    CHECK(work_of(a, b, plan) == Approx(4.0 * (3300 + 4.0 * 2200)).epsilon(0.005));
}

TEST_CASE("batches that are there are used, and a known mean needs none", "[statistics]")
{
    BatchEvidence a{.batches = {40, 5000, 40, 40}, .work = 1.0};
    BatchEvidence b{.batches = some, .work = 1.0};
    a.variance.fill(0.01);
    b.variance.fill(0.01);
    const BatchPlan plan = min_work(a, b, error);
    CHECK(plan.a[1] == 5000);
    CHECK(plan.b[1] == 103);  // 1 / (1 - 100 / 5000), in hundreds
    CHECK(plan.a[0] == Approx(200).epsilon(0.06));
    CHECK(min_work(b, a, error).b[1] == 5000);
    const BatchPlan alone = min_work(a, BatchEvidence{}, error);
    CHECK(alone.a[0] == Approx(100).margin(1));
    CHECK(alone.a[1] == 5000);
}

}  // namespace bdpt::test::refinement_test
