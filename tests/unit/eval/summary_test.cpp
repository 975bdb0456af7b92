#include <bdpt/eval/bench_report.h>
#include <bdpt/eval/statistics.h>

#include <cmath>
#include <vector>

#include "catch.hpp"

namespace bdpt::eval::summary_test {
namespace {

/// Errors that fall from `first` with the inverse of the samples, at `seconds` each.
BenchRun run_of(IntegratorKind kind, std::uint64_t seed, double first, double seconds)
{
    BenchRun run;
    run.integrator = kind;
    run.seed = seed;
    for (const std::int64_t samples : {1, 2, 4, 8}) {
        const auto n = static_cast<double>(samples);
        run.checkpoints.push_back({.samples = samples,
                                   .cpu_seconds = n * seconds,
                                   .wall_seconds = n * seconds / 2.0,
                                   .relmse = first / n,
                                   .relmse_scales = 0.4 * first / n,
                                   .mape = std::sqrt(first / n)});
    }
    run.stats.rays = {.camera = 160, .light = 80, .shadow = 40, .aov = 0};
    return run;
}

SceneResult two_integrators(double noise)
{
    SceneResult scene;
    scene.reference_noise = noise;
    scene.goals = {{.integrator = IntegratorKind::pt, .equal_time = 8, .equal_samples = 4},
                   {.integrator = IntegratorKind::bdpt, .equal_time = 4, .equal_samples = 4}};
    for (const std::uint64_t seed : {0u, 1u, 2u}) {
        const double luck = seed == 0 ? 0.5 : seed == 1 ? 1.0 : 3.0;
        scene.runs.push_back(run_of(IntegratorKind::pt, seed, luck * 8.0, 0.1));
        scene.runs.push_back(run_of(IntegratorKind::bdpt, seed, luck * 1.0, 0.25));
    }
    return scene;
}

std::vector<CurvePoint> curve(const std::vector<std::pair<double, double>>& points)
{
    std::vector<CurvePoint> result;
    for (const auto& [seconds, error] : points) {
        result.push_back({.samples = 1,
                          .cpu_seconds = seconds,
                          .error = {.median = error, .least = error, .greatest = error}});
    }
    return result;
}

TEST_CASE("a spread has the middle and the ends")
{
    const Spread odd = spread({5.0, 1.0, 3.0});
    CHECK(odd.median == 3.0);
    CHECK(odd.least == 1.0);
    CHECK(odd.greatest == 5.0);
    CHECK(spread({4.0, 1.0, 2.0, 8.0}).median == 3.0);
    CHECK(spread({7.0}).median == 7.0);
}

TEST_CASE("the time to an error lies on straight lines of a log-log plot")
{
    const auto points = curve({{1.0, 100.0}, {2.0, 25.0}, {8.0, 1.0}});
    const auto time = [&](double error) { return time_to_error(points, error); };
    CHECK(time(25.0).seconds == Approx(2.0));
    CHECK(time(50.0).seconds == Approx(std::sqrt(2.0)));  // the geometric middle of both
    CHECK(time(5.0).seconds == Approx(4.0));
    CHECK_FALSE(time(5.0).extrapolated);
    CHECK(time(1.0).seconds == Approx(8.0));
    CHECK_FALSE(time(1.0).extrapolated);

    SECTION("beyond the ends the error falls with the inverse of the time")
    {
        CHECK(time(0.1).seconds == Approx(80.0));
        CHECK(time(0.1).extrapolated);
        CHECK(time(400.0).seconds == Approx(0.25));
        CHECK(time(400.0).extrapolated);
        CHECK(time(100.0).seconds == Approx(1.0));
        CHECK_FALSE(time(100.0).extrapolated);
    }
    SECTION("an error that comes back counts from where it stays away")
    {
        const auto lucky = curve({{1.0, 4.0}, {2.0, 1.0}, {4.0, 4.0}, {8.0, 1.0}});
        CHECK(time_to_error(lucky, 2.0).seconds == Approx(4.0 * std::sqrt(2.0)));
    }
}

TEST_CASE("a summary tells of equal time, equal samples and equal error")
{
    const auto all = summarize(two_integrators(0.0), 0.8);
    REQUIRE(all.size() == 2);
    const IntegratorSummary& pt = all[0];
    const IntegratorSummary& bdpt = all[1];
    CHECK(pt.seeds == 3);
    CHECK(pt.equal_time.error.median == Approx(1.0));
    CHECK(pt.equal_time.error.least == Approx(0.5));
    CHECK(pt.equal_time.error.greatest == Approx(3.0));
    // Four samples take 1 s, so after 0.8 s there would be 5/4 of the error.
    CHECK(bdpt.equal_time.error.median == Approx(0.25 * 1.0 / 0.8));
    CHECK(bdpt.equal_time.cpu_seconds == Approx(1.0));
    CHECK(bdpt.equal_time.wall_seconds == Approx(0.5));
    CHECK(pt.equal_samples.error.median == Approx(2.0));
    CHECK(bdpt.equal_samples.error.median == Approx(0.25));
    CHECK(bdpt.equal_samples.mape.median == Approx(0.5));
    CHECK(bdpt.equal_samples.error_scales.median == Approx(0.4 * 0.25));
    CHECK(bdpt.equal_time.error_scales.median == Approx(0.4 * 0.25 * 1.0 / 0.8));
    CHECK(pt.efficiency == Approx(1.0 / 0.8));
    CHECK(bdpt.efficiency == Approx(1.0 / (0.3125 * 0.8)));

    SECTION("pt has the error 1 after 0.8 s, bdpt after 0.25 s")
    {
        REQUIRE(pt.speed_up);
        CHECK(pt.speed_up->factor == 1.0);
        REQUIRE(bdpt.speed_up);
        CHECK(bdpt.speed_up->factor == Approx(0.8 / 0.25));
        CHECK_FALSE(bdpt.speed_up->extrapolated);
    }
    SECTION("rates are those of the clock at the wall")
    {
        CHECK(pt.samples_per_second == Approx(8.0 / 0.4));
        CHECK(pt.camera_rays_per_second == Approx(160.0 / 0.4));
        CHECK(pt.light_rays_per_second == Approx(80.0 / 0.4));
        CHECK(pt.shadow_rays_per_second == Approx(40.0 / 0.4));
    }
    SECTION("curves have all checkpoints")
    {
        REQUIRE(bdpt.curve.size() == 4);
        CHECK(bdpt.curve[1].samples == 2);
        CHECK(bdpt.curve[1].cpu_seconds == Approx(0.5));
        CHECK(bdpt.curve[1].error.median == Approx(0.5));
        CHECK(bdpt.curve[1].error.greatest == Approx(1.5));
    }
}

TEST_CASE("the noise of the reference is not an error of the image")
{
    const auto all = summarize(two_integrators(0.2), 0.8);
    CHECK(all[0].equal_time.error.median == Approx(0.8));
    CHECK_FALSE(all[0].equal_time.near_noise);
    // Of pixels that are independent; averages over squares have less of it.
    CHECK(all[0].equal_time.error_scales.median == Approx(0.4 - 0.2 * 341.0 / 256.0 / 5.0));
    CHECK(all[1].equal_samples.error.median == Approx(0.05));
    CHECK(all[1].equal_samples.near_noise);
    // The luckiest run is below the noise: no logarithm of a negative number.
    CHECK(all[1].equal_samples.error.least == Approx(0.02));
}

TEST_CASE("without pt there is no speed-up, without runs no summary")
{
    SceneResult scene = two_integrators(0.0);
    std::erase_if(scene.runs,
                  [](const BenchRun& run) { return run.integrator == IntegratorKind::pt; });
    const auto all = summarize(scene, 0.8);
    REQUIRE(all.size() == 1);
    CHECK(all[0].integrator == IntegratorKind::bdpt);
    CHECK_FALSE(all[0].speed_up);
}

}  // namespace
}  // namespace bdpt::eval::summary_test
