#include "light/learned/learned_light.h"

#include "catch.hpp"
#include "statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace bdpt::group_shares_test {
namespace {

using Finding = GroupShares::Finding;

constexpr auto even_part = static_cast<float>(GroupShares::even_part);

/// From the cube [-1, 1]^3: group 1 brings twice as much as group 0 where x > 0, and half as much
/// where x < 0, where all is `dimness` times as bright.
std::vector<Finding> findings_of_two_halves(int count, float dimness)
{
    test::Random random(1);
    std::vector<Finding> findings;
    for (int i = 0; i < count; ++i) {
        const Vec3 p = 2.0f * Vec3(random.next(), random.next(), random.next()) - 1.0f;
        const auto group = static_cast<std::uint32_t>(i % 2);
        const bool more = (group == 1) == (p.x > 0.0f);
        findings.push_back({.p = p,
                            .group = group,
                            .value = (more ? 2.0f : 1.0f) * (p.x > 0.0f ? 1.0f : dimness)});
    }
    return findings;
}

}  // namespace

TEST_CASE("groups: without findings, or light, shares are equal", "[light][groups]")
{
    const std::vector<Finding> dark(50, Finding{.p = Vec3(1.0f), .group = 2, .value = 0.0f});
    for (const auto& findings : {std::vector<Finding>{}, dark}) {
        const GroupShares shares(findings, 4);
        CHECK(shares.cells() == 1);
        for (std::size_t group = 0; group < GroupShares::max_groups; ++group) {
            CHECK(shares.at(Vec3(-1e9f, 0.0f, 3.0f))[group] == (group < 4 ? 0.25f : 0.0f));
        }
    }
}

TEST_CASE("groups: a cell shares by roots of mean squares", "[light][groups]")
{
    // Of 40 findings of each group; groups 3 and 4 are the two that bring nothing.
    std::vector<Finding> findings;
    double squares_of_2 = 0.0;
    for (int i = 0; i < 40; ++i) {
        const Vec3 p(static_cast<float>(i));
        const float value = static_cast<float>(i % 4);
        squares_of_2 += static_cast<double>(value * value);
        findings.push_back({.p = p, .group = 0, .value = 3.0f});
        findings.push_back({.p = p, .group = 1, .value = i == 7 ? 3.0f * std::sqrt(40.0f) : 0.0f});
        findings.push_back({.p = p, .group = 2, .value = value});
        findings.push_back({.p = p, .group = 3, .value = 0.0f});
    }
    const GroupShares shares(findings, 5);
    REQUIRE(shares.cells() == 1);
    const GroupShares::Shares& here = shares.at(Vec3(0.0f));
    const std::array<float, 5> roots{3.0f, 3.0f, static_cast<float>(std::sqrt(squares_of_2 / 40.0)),
                                     0.0f, 0.0f};
    const float sum = roots[0] + roots[1] + roots[2];
    for (std::size_t group = 0; group < roots.size(); ++group) {
        CHECK(here[group] ==
              Approx((1.0f - even_part) * roots[group] / sum + even_part / 5.0f).epsilon(1e-5));
    }
}

TEST_CASE("groups: cells know places, dark ones beside bright ones", "[light][groups]")
{
    for (const float dimness : {1.0f, 1e-12f}) {
        const GroupShares shares(findings_of_two_halves(40000, dimness), 2);
        CHECK(shares.cells() > 30);
        test::Random random(2);
        int right = 0;
        constexpr int points = 2000;
        for (int i = 0; i < points; ++i) {
            const Vec3 p = 2.0f * Vec3(random.next(), random.next(), random.next()) - 1.0f;
            const GroupShares::Shares& here = shares.at(p);
            REQUIRE(here[0] + here[1] == Approx(1.0f));
            REQUIRE(std::min(here[0], here[1]) >= 0.999f * even_part / 2.0f);
            const float expected =
                (1.0f - even_part) * (p.x > 0.0f ? 2.0f : 1.0f) / 3.0f + even_part / 2.0f;
            right += std::abs(here[1] - expected) < 0.05f ? 1 : 0;
        }
        CHECK(right > 0.8 * points);  // but near the border
    }
}

TEST_CASE("groups: the order of findings does not matter", "[light][groups]")
{
    std::vector<Finding> findings = findings_of_two_halves(20000, 1e-3f);
    test::Random random(3);
    for (Finding& finding : findings) {
        finding.value *= random.next();
    }
    const GroupShares one(findings, 3);
    std::reverse(findings.begin(), findings.end());
    std::rotate(findings.begin(), findings.begin() + 777, findings.end());
    const GroupShares other(findings, 3);
    REQUIRE(one.cells() == other.cells());
    for (int i = 0; i < 3000; ++i) {
        const Vec3 p = 2.4f * Vec3(random.next(), random.next(), random.next()) - 1.2f;
        REQUIRE(one.at(p) == other.at(p));
    }
}

}  // namespace bdpt::group_shares_test
