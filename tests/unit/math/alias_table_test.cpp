#include "math/distributions.h"

#include "catch.hpp"
#include "chi_square.h"

#include <limits>
#include <numeric>
#include <vector>

namespace bdpt::test::alias_table_test {
namespace {

/// Counts of `samples` draws.
std::vector<double> draw(const AliasTable& table, int samples, std::uint64_t seed)
{
    test::Random random(seed);
    std::vector<double> counts(table.size());
    for (int i = 0; i < samples; ++i) {
        counts[table.sample(fine_uniform(random.next_2d())).index] += 1.0;
    }
    return counts;
}

std::vector<double> probabilities(const AliasTable& table)
{
    std::vector<double> result(table.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i] = static_cast<double>(table.probability(i));
    }
    return result;
}

}  // namespace

TEST_CASE("AliasTable draws in proportion to the weights")
{
    constexpr int samples = 400000;
    constexpr double significance = 1e-3;
    test::Random random(7);
    std::vector<std::vector<float>> sets{
        {1.0f}, {1.0f, 2.0f, 3.0f, 4.0f}, {0.0f, 5.0f, 0.0f, 1e-3f}, {1e30f, 2e30f, 0.5e30f}};
    std::vector<float> wild(101);
    for (float& weight : wild) {
        weight = random.next() < 0.3f ? 0.0f : std::exp(8.0f * random.next());
    }
    sets.push_back(wild);
    for (const std::vector<float>& weights : sets) {
        CAPTURE(weights.size());
        const AliasTable table(weights);
        const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
        CHECK(table.total() == Approx(sum));
        std::vector<double> expected(weights.size());
        for (std::size_t i = 0; i < weights.size(); ++i) {
            expected[i] = static_cast<double>(weights[i]) / sum;
            CHECK(table.probability(i) == Approx(expected[i]).epsilon(1e-6));
        }
        const test::ChiSquare test = test::chi_square(draw(table, samples, 11), expected);
        if (weights.size() > 1) {
            CHECK(test.p_value > significance);
            CHECK(test.min_detectable(significance) < 0.03);
        }
    }
}

TEST_CASE("AliasTable never draws what has no weight")
{
    // Sums and thresholds of this set are not exact, which is where leftovers could slip through.
    std::vector<float> weights(1000, 0.0f);
    for (std::size_t i = 0; i < weights.size(); i += 3) {
        weights[i] = 0.1f + 0.01f * static_cast<float>(i % 7);
    }
    weights[999] = 0.0f;
    const AliasTable table(weights);
    constexpr int steps = 1 << 20;
    for (int i = 0; i < steps; ++i) {
        const AliasTable::Choice choice = table.sample(static_cast<double>(i) / steps);
        REQUIRE(weights[choice.index] > 0.0f);
        REQUIRE(choice.probability == table.probability(choice.index));
    }
    CHECK(weights[table.sample(1.0 - 0x1p-48).index] > 0.0f);
}

TEST_CASE("AliasTable hands on a fresh uniform number")
{
    const AliasTable table(std::vector<float>{1.0f, 5.0f, 2.0f});
    constexpr int bins = 20;
    constexpr int samples = 300000;
    std::vector<double> counts(3 * bins);
    std::vector<double> expected(3 * bins);
    test::Random random(3);
    for (int i = 0; i < samples; ++i) {
        const AliasTable::Choice choice = table.sample(fine_uniform(random.next_2d()));
        REQUIRE(choice.u_remapped >= 0.0f);
        REQUIRE(choice.u_remapped < 1.0f);
        counts[choice.index * bins + static_cast<std::size_t>(choice.u_remapped * bins)] += 1.0;
    }
    for (std::size_t i = 0; i < expected.size(); ++i) {
        expected[i] = static_cast<double>(table.probability(i / bins)) / bins;
    }
    const test::ChiSquare test = test::chi_square(counts, expected);
    CHECK(test.p_value > 1e-3);
    CHECK(test.min_detectable(1e-3) < 0.03);
}

TEST_CASE("AliasTable of two million items is not coarse")
{
    // Two random floats give 48 bits; one of 24 would make every bucket 12 % too long or too short.
    constexpr std::size_t count = 2100000;
    std::vector<float> weights(count, 1.0f);
    for (std::size_t i = 0; i < count; i += 2) {
        weights[i] = 3.0f;
    }
    const AliasTable table(weights);
    constexpr std::size_t groups = 100;
    constexpr int samples = 1000000;
    std::vector<double> counts(groups);
    test::Random random(5);
    for (int i = 0; i < samples; ++i) {
        counts[table.sample(fine_uniform(random.next_2d())).index % groups] += 1.0;
    }
    std::vector<double> expected(groups);
    for (std::size_t i = 0; i < groups; ++i) {
        expected[i] = (i % 2 == 0 ? 0.75 : 0.25) / (groups / 2);
    }
    CHECK(test::chi_square(counts, expected).p_value > 1e-3);
}

TEST_CASE("AliasTable without weight is empty")
{
    CHECK(AliasTable().empty());
    for (const std::vector<float>& weights :
         {std::vector<float>{}, std::vector<float>{0.0f, 0.0f},
          std::vector<float>{-1.0f, std::numeric_limits<float>::quiet_NaN(),
                             std::numeric_limits<float>::infinity()}}) {
        const AliasTable table(weights);
        CHECK(table.empty());
        CHECK(table.sample(0.5).probability == 0.0f);
        CHECK(table.sample(0.5).index == 0);
    }
    const AliasTable some(std::vector<float>{-1.0f, 2.0f, std::numeric_limits<float>::quiet_NaN()});
    CHECK(some.probability(1) == 1.0f);
    CHECK(probabilities(some)[0] == 0.0);
}

}  // namespace bdpt::test::alias_table_test
