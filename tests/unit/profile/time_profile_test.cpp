#include "camera/moving_camera.h"
#include "integrator/integrator.h"
#include "profile/sample_timer.h"
#include "profile/time_recorder.h"
#include "scene/world.h"

#include <bdpt/render.h>

#include "catch.hpp"
#include "scene_builder.h"

#include <chrono>
#include <cmath>
#include <functional>
#include <thread>

namespace bdpt::time_profile_test {
namespace {

constexpr int columns = 24;
constexpr int rows = 16;

/// A closed room, in which every ray of a walk hits something.
SceneDesc closed_room()
{
    test::SceneBuilder builder;
    const MaterialDesc wall = test::lambertian(Rgb(0.7f));
    const auto side = [&](Vec3 a, Vec3 b, Vec3 c, Vec3 d) { builder.quad(a, b, c, d, wall); };
    side({-2, -2, -2}, {2, -2, -2}, {2, 2, -2}, {-2, 2, -2});
    side({-2, -2, 2}, {2, -2, 2}, {2, 2, 2}, {-2, 2, 2});
    side({-2, -2, -2}, {-2, -2, 2}, {-2, 2, 2}, {-2, 2, -2});
    side({2, -2, -2}, {2, -2, 2}, {2, 2, 2}, {2, 2, -2});
    side({-2, -2, -2}, {2, -2, -2}, {2, -2, 2}, {-2, -2, 2});
    side({-2, 2, -2}, {2, 2, -2}, {2, 2, 2}, {-2, 2, 2});
    builder.lamp(1.5f, 0.5f, Rgb(6.0f));
    return builder.desc;
}

RenderOptions options_for(IntegratorKind kind)
{
    RenderOptions options;
    options.integrator = kind;
    options.film.width = columns;
    options.film.height = rows;
    options.sampling.samples = {.begin = 0, .end = 8};
    options.transport.max_depth = 5;
    return options;
}

RenderResult profiled(const Scene& scene, const RenderOptions& options)
{
    RenderControl control;
    control.profiling = Profiling::on;
    return render(scene, CameraDesc{}, options, control);
}

std::uint64_t pieces(const SampleTicks& ticks, Phase phase)
{
    return ticks.phases[static_cast<std::size_t>(phase)].pieces;
}

/// Calls `check(ticks, stats)` for each sample of the image that is clocked; how many are.
int for_clocked_samples(const RenderOptions& options,
                        const std::function<void(const SampleTicks&, const RenderStats&)>& check)
{
    const Scene scene(closed_room());
    const MovingCamera camera(Camera(CameraDesc{}, columns, rows));
    const auto integrator = make_integrator(scene.world(), camera, options);
    const PixelRect whole{.x0 = 0, .y0 = 0, .x1 = columns, .y1 = rows};
    Film film({.width = columns, .height = rows, .region = whole, .splats = SplatImage::present});
    StrategyFilm strategies(whole, {});
    PixelTicks pixels(whole);
    const std::function<void(const PathContribution&)> nobody;
    int clocked = 0;
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            SampleTicks ticks;
            TimeSheet sheet{
                .pixels = pixels, .samples = ticks, .clock_ticks = 0.0, .suspicious_ticks = 1e30};
            const RenderStats stats = integrator->render_tile(
                {x, x + 1, y, y + 1}, {.begin = 0, .end = 1},
                {.film = &film, .strategies = strategies, .on_path = nobody, .times = &sheet});
            REQUIRE(ticks.clocked.pieces + ticks.others.pieces == 1);
            if (ticks.clocked.pieces == 1) {
                ++clocked;
                check(ticks, stats);
            }
        }
    }
    return clocked;
}

}  // namespace

TEST_CASE("an image is the same, to the bit, when the time of its samples is measured", "[profile]")
{
    const Scene scene(closed_room());
    const auto kind = GENERATE(IntegratorKind::pt, IntegratorKind::nee, IntegratorKind::mis,
                               IntegratorKind::lt, IntegratorKind::bdpt);
    RenderOptions options = options_for(kind);
    options.bidirectional.strategy_depth = kind == IntegratorKind::bdpt ? 3 : 0;
    const RenderResult plain = render(scene, CameraDesc{}, options);
    const RenderResult measured = profiled(scene, options);
    CAPTURE(static_cast<int>(kind));
    CHECK(plain.film.develop().pixels == measured.film.develop().pixels);
    CHECK(plain.stats == measured.stats);
    if (options.bidirectional.strategy_depth > 0) {
        const Strategy strategy{.s = 2, .t = 2};
        CHECK(plain.strategies.unweighted(strategy).pixels ==
              measured.strategies.unweighted(strategy).pixels);
    }
    CHECK_FALSE(plain.profile);
    CHECK(measured.profile);
}

TEST_CASE("a profile is of all samples, of which one of sixteen is clocked", "[profile]")
{
    const Scene scene(closed_room());
    RenderOptions options = options_for(IntegratorKind::bdpt);
    options.sampling.samples.end = 64;
    options.system.threads = GENERATE(1, 3);
    const TimeProfile profile = profiled(scene, options).profile.value();
    constexpr double all = 64.0 * columns * rows;
    CHECK(static_cast<double>(profile.samples) == all);
    // Five standard deviations of chance.
    CHECK(std::abs(static_cast<double>(profile.clocked_samples) - all / 16.0) <
          5.0 * std::sqrt(all / 16.0));
    double shares = 0.0;
    for (const Phase phase : all_phases) {
        CAPTURE(std::string(to_string(phase)));
        CHECK(profile.seconds(phase) > 0.0);
        shares += profile.share(phase);
    }
    CHECK(shares == Approx(1.0));
    CHECK(profile.clock_seconds > 0.0);
    CHECK(profile.distortion > 0.0);
    REQUIRE(profile.pixel_seconds.size() == std::size_t{columns * rows});
    for (const float seconds : profile.pixel_seconds) {
        CHECK(seconds > 0.0f);
    }
}

TEST_CASE("a profile of a crop has the pixels of the crop", "[profile]")
{
    const Scene scene(closed_room());
    RenderOptions options = options_for(IntegratorKind::bdpt);
    options.film.crop = PixelRect{.x0 = 3, .y0 = 2, .x1 = 10, .y1 = 7};
    const TimeProfile profile = profiled(scene, options).profile.value();
    CHECK(profile.region == *options.film.crop);
    CHECK(profile.pixel_seconds.size() == 7 * 5);
    // The light paths of all other pixels are in it as well.
    CHECK(profile.samples == 8 * columns * rows);
}

TEST_CASE("ticks are kept by pixel", "[profile]")
{
    PixelTicks pixels({.x0 = 3, .y0 = 2, .x1 = 5, .y1 = 4});
    pixels.add(4, 2, 5.0);
    pixels.add(3, 3, 7.0);
    pixels.add(3, 3, 1.0);
    pixels.add(5, 2, 100.0);
    pixels.add(3, 1, 100.0);
    CHECK(pixels.ticks() == std::vector<double>{0.0, 5.0, 8.0, 0.0});
    SECTION("without those of the clock")
    {
        SampleTicks ticks;
        TimeSheet sheet{.pixels = pixels,
                        .samples = ticks,
                        .clock_ticks = 1e18,  // more than there are
                        .suspicious_ticks = 1e30};
        for (std::int64_t index = 0; index < 100; ++index) {
            const SampleTimer timer(&sheet, 3, 2, index);
        }
        CHECK(ticks.clocked.pieces > 0);
        CHECK(pixels.ticks()[0] == 0.0);
        sheet.clock_ticks = 0.0;
        for (std::int64_t index = 0; index < 100; ++index) {
            const SampleTimer timer(&sheet, 3, 2, index);
        }
        CHECK(pixels.ticks()[0] > 0.0);
    }
}

TEST_CASE("time without a processor does not count", "[profile]")
{
    constexpr PixelRect one{.x0 = 0, .y0 = 0, .x1 = 1, .y1 = 1};
    PixelTicks pixels(one);
    SampleTicks ticks;
    TimeSheet sheet{
        .pixels = pixels, .samples = ticks, .clock_ticks = 0.0, .suspicious_ticks = 0.0};
    const std::uint64_t begin = read_ticks();
    for (std::int64_t index = 0; index < 64; ++index) {
        const SampleTimer timer(&sheet, 0, 0, index);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    const auto passed = static_cast<double>(read_ticks() - begin);
    CHECK(pixels.ticks().front() < 0.5 * passed);
    CHECK(static_cast<double>(ticks.others.ticks) < 0.5 * passed);
    CHECK(ticks.clocked.pieces == 0);
    CHECK(ticks.interrupted >= 1);
    CHECK(ticks.others.pieces + ticks.interrupted == 64);
}

TEST_CASE("phases are the pieces that a path is made of", "[profile]")
{
    SECTION("pt: rays and surfaces take turns, then the film")
    {
        RenderOptions options = options_for(IntegratorKind::pt);
        options.transport.rr_start = 100;
        options.transport.min_depth = 100;  // no light is measured
        const int clocked =
            for_clocked_samples(options, [](const SampleTicks& ticks, const RenderStats& stats) {
                CHECK(pieces(ticks, Phase::shade) == stats.rays.camera);
                CHECK(pieces(ticks, Phase::splat) == 1);
                CHECK(pieces(ticks, Phase::connect) == 0);
                // One before each surface and one after the last; a lamp is weighed in between.
                CHECK(pieces(ticks, Phase::walk) ==
                      stats.rays.camera + 1 + pieces(ticks, Phase::weigh));
            });
        CHECK(clocked > 10);
    }
    SECTION("mis: one join for each surface but the last")
    {
        const RenderOptions options = options_for(IntegratorKind::mis);
        const int clocked =
            for_clocked_samples(options, [](const SampleTicks& ticks, const RenderStats& stats) {
                CHECK(pieces(ticks, Phase::shade) == stats.rays.camera);
                CHECK(pieces(ticks, Phase::connect) >= stats.rays.camera - 1);
                CHECK(pieces(ticks, Phase::connect) <= stats.rays.camera);
                CHECK(pieces(ticks, Phase::splat) == 1);
            });
        CHECK(clocked > 10);
    }
    SECTION("bdpt: surfaces of both walks; weights end in the film or in the next join")
    {
        const RenderOptions options = options_for(IntegratorKind::bdpt);
        std::uint64_t weighed = 0;
        const int clocked =
            for_clocked_samples(options, [&](const SampleTicks& ticks, const RenderStats& stats) {
                CHECK(pieces(ticks, Phase::shade) == stats.rays.camera + stats.rays.light);
                // Two walks, each with a piece before the first surface and one after each.
                CHECK(pieces(ticks, Phase::walk) == stats.rays.camera + stats.rays.light + 2);
                // The sums of both subpaths, and a weight for what joins find.
                CHECK(pieces(ticks, Phase::weigh) >= 2);
                CHECK(pieces(ticks, Phase::weigh) <= 2 + stats.rays.shadow + stats.rays.camera);
                weighed += pieces(ticks, Phase::weigh) - 2;
                CHECK(pieces(ticks, Phase::connect) >= pieces(ticks, Phase::weigh) - 1);
                CHECK(pieces(ticks, Phase::splat) >= 1);
            });
        CHECK(clocked > 10);
        CHECK(weighed > static_cast<std::uint64_t>(clocked));
    }
}

TEST_CASE("what reading the clock takes is not in a profile", "[profile]")
{
    SampleTicks ticks;
    ticks.phases = {PhaseTicks{.ticks = 1000, .pieces = 10}, PhaseTicks{.ticks = 500, .pieces = 20},
                    PhaseTicks{.ticks = 30, .pieces = 10}, PhaseTicks{}, PhaseTicks{}};
    ticks.clocked = {.ticks = 2000, .pieces = 2};
    ticks.others = {.ticks = 12300, .pieces = 30};
    ticks.interrupted = 4;
    // After the clock: 950, 400, 0 in 2 samples, and 12150 in 30 others.
    const TimeProfile profile = compute_profile(ticks, 5.0, 0.001);
    CHECK(profile.samples == 36);
    CHECK(profile.clocked_samples == 2);
    CHECK(profile.share(Phase::walk) == Approx(950.0 / 1350.0));
    CHECK(profile.share(Phase::shade) == Approx(400.0 / 1350.0));
    CHECK(profile.seconds(Phase::connect) == 0.0);
    CHECK(profile.total() == Approx(36.0 * 405.0 * 0.001));
    CHECK(profile.distortion == Approx((1350.0 / 2.0) / 405.0));
    CHECK(profile.clock_seconds == Approx((2.0 * 36.0 + 40.0) * 5.0 * 0.001));

    SECTION("without clocked samples nothing is known of phases")
    {
        ticks.phases = {};
        ticks.clocked = {};
        ticks.interrupted = 0;
        const TimeProfile none = compute_profile(ticks, 5.0, 0.001);
        CHECK(none.samples == 30);
        CHECK(none.total() == 0.0);
        CHECK(none.distortion == 0.0);
    }
    SECTION("with nothing but clocked samples these tell how long a sample takes")
    {
        ticks.others = {};
        ticks.interrupted = 0;
        const TimeProfile all = compute_profile(ticks, 5.0, 0.001);
        CHECK(all.total() == Approx(1.35));
        CHECK(all.distortion == 0.0);
    }
}

}  // namespace bdpt::time_profile_test
