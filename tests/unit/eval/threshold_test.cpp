#include <bdpt/error.h>
#include <bdpt/eval/comparison.h>

#include "catch.hpp"

namespace bdpt::eval::threshold_test {
namespace {

ComparisonReport report_of(double relmse, double psnr)
{
    ComparisonReport report;
    report.metrics = {{.metric = Metric::relmse, .mean = relmse, .deviation = {}},
                      {.metric = Metric::psnr, .mean = psnr, .deviation = {}}};
    report.bias.channels = {Estimate{0.1, {}}, Estimate{-0.3, {}}, Estimate{0.2, {}},
                            Estimate{0.0, {}}};
    return report;
}

bool passes(const ComparisonReport& report, const char* text)
{
    const auto threshold = parse_threshold(text);
    REQUIRE(threshold);
    return check_threshold(report, *threshold).passed;
}

TEST_CASE("thresholds are limits of what is good")
{
    ComparisonReport report = report_of(0.01, 30.0);
    CHECK(passes(report, "relmse=0.01"));
    CHECK_FALSE(passes(report, "relmse=0.00999"));
    CHECK(passes(report, "psnr=30"));
    CHECK_FALSE(passes(report, "psnr=30.1"));
    // The greatest channel counts, whatever its sign.
    CHECK(passes(report, "bias=0.3"));
    CHECK_FALSE(passes(report, "bias=0.29"));
    report.biased_tiles = {{.tile = {}, .p = 1e-5}, {.tile = {}, .p = 0.5}};
    CHECK(passes(report, "p=1e-6"));
    CHECK_FALSE(passes(report, "p=1e-4"));
}

TEST_CASE("only what is there can be held against a threshold")
{
    const ComparisonReport report = report_of(0.01, 30.0);
    CHECK_THROWS_AS(check_threshold(report, parse_threshold("flip=1").value()), Error);
    CHECK_THROWS_AS(check_threshold(report, parse_threshold("p=0.1").value()), Error);
}

TEST_CASE("thresholds are read strictly")
{
    for (const char* text : {"relmse", "relmse=", "=1", "frob=1", "relmse=1x", "relmse=nan",
                             "relmse=inf", "relmse =1", "relmse=1=2", ""}) {
        CAPTURE(text);
        CHECK_FALSE(parse_threshold(text));
    }
    CHECK(parse_threshold("flip_ldr=2.5e-1")->limit == 0.25);
    CHECK(parse_threshold("flip_ldr=1")->metric == Metric::flip_ldr);
}

}  // namespace
}  // namespace bdpt::eval::threshold_test
