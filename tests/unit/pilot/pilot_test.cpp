// What a pilot predicts, against renders.

#include "pilot/pilot.h"

#include "catch.hpp"
#include "ground_views.h"
#include "pilot/candidates.h"
#include "pilot/light_pilot.h"
#include "pilot/pilot_contributions.h"
#include "render/view.h"
#include "scene/world.h"
#include "scene_builder.h"

#include <bdpt/render.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stop_token>
#include <utility>
#include <vector>

namespace bdpt::test::pilot_test {
namespace {

constexpr int side = 24;

/// A room that is lit by a lamp which shines at its ceiling, seen by diffuse walls.
Scene indirect_room()
{
    SceneBuilder builder;
    builder.walls(lambertian(Rgb(0.6f)), lambertian(Rgb(0.6f)));
    builder.ceiling(lambertian(Rgb(0.8f)));
    builder.front(lambertian(Rgb(0.6f)));
    constexpr float h = 0.3f;
    constexpr float y = 0.4f;
    builder.quad({-h, y, h}, {h, y, h}, {h, y, -h}, {-h, y, -h}, emitter(Rgb(8.0f)));
    return Scene(std::move(builder.desc));
}

CameraDesc inside()
{
    return camera_at({0.0f, -0.2f, 0.9f}, {0.0f, -0.2f, -1.0f}, 1.2f);
}

RenderOptions small()
{
    RenderOptions options;
    options.film.width = side;
    options.film.height = side;
    options.sampling.planned_samples = 0;  // the pilot is as large as for long renders
    options.transport.max_depth = 6;
    return options;
}

PilotMeasurements pilot_of(const Scene& scene, const CameraDesc& camera,
                           const RenderOptions& options)
{
    return measure(scene.world(), open_camera(scene.world(), camera, options), options);
}

std::size_t index_of(double light_paths, double connections, double rays = 0.0,
                     double light_samples = 1.0)
{
    const auto found = std::find(candidates.begin(), candidates.end(),
                                 Candidate{light_paths, connections, rays, light_samples});
    REQUIRE(found != candidates.end());
    return static_cast<std::size_t>(found - candidates.begin());
}

/// A lamp of a fraction of a pixel in the dark.
Scene far_lamp()
{
    SceneBuilder builder;
    constexpr float h = 0.02f;
    builder.quad({-h, -h, -1.0f}, {h, -h, -1.0f}, {h, h, -1.0f}, {-h, h, -1.0f},
                 emitter(Rgb(8.0f)));
    return Scene(std::move(builder.desc));
}

/// Sum over pixels of the variance of one independent sample.
double variance_of_samples(const Scene& scene, IntegratorKind integrator)
{
    constexpr int renders = 400;
    RenderOptions options = small();
    options.integrator = integrator;
    options.sampling.sampler = SamplerKind::independent;
    options.sampling.samples = {.begin = 0, .end = 1};
    std::vector<double> sums(side * side);
    double squares = 0.0;
    for (int i = 0; i < renders; ++i) {
        options.sampling.seed = static_cast<std::uint64_t>(i) + 1;
        const Image image = render(scene, inside(), options).film.develop();
        for (std::size_t p = 0; p < sums.size(); ++p) {
            const auto value = static_cast<double>(image.pixels[p].g);
            sums[p] += value / renders;
            squares += value * value / renders;
        }
    }
    for (const double mean : sums) {
        squares -= mean * mean;
    }
    return squares;
}

/// Mean over the pixels of variance over squared mean, times the number of samples.
double measured_error(const Scene& scene, const Candidate& candidate)
{
    constexpr int renders = 12;
    constexpr int samples = 16;
    RenderOptions options = small();
    options.integrator = candidate.light_paths > 0.0 ? IntegratorKind::bdpt : IntegratorKind::mis;
    options.bidirectional.light_paths = candidate.light_paths;
    options.bidirectional.connections = candidate.connections;
    options.bidirectional.connection_rays = candidate.connection_rays;
    options.sampling.samples = {.begin = 0, .end = samples};
    options.sampling.planned_samples = samples;
    std::vector<double> sums(side * side);
    std::vector<double> squares(side * side);
    for (int i = 0; i < renders; ++i) {
        options.sampling.seed = static_cast<std::uint64_t>(i) + 1;
        const Image image = render(scene, inside(), options).film.develop();
        for (std::size_t p = 0; p < sums.size(); ++p) {
            const auto value = static_cast<double>(image.pixels[p].g);
            sums[p] += value;
            squares[p] += value * value;
        }
    }
    double error = 0.0;
    for (std::size_t p = 0; p < sums.size(); ++p) {
        const double mean = sums[p] / renders;
        error += (squares[p] / renders - mean * mean) * renders / (renders - 1) / (mean * mean);
    }
    return error / (side * side) * samples;
}

}  // namespace

TEST_CASE("a pilot predicts errors of renders with other numbers of light paths", "[pilot][long]")
{
    const Scene scene = indirect_room();
    const PilotMeasurements pilot = pilot_of(scene, inside(), small());
    const std::size_t one = index_of(1.0, 1.0);
    const double measured_one = measured_error(scene, candidates[one]);
    // Noise of the pilot, and what Sobol points leave is not the same in every scene.
    constexpr double tolerance = 1.5;
    for (const std::size_t k :
         {index_of(0.0625, 1.0), index_of(0.0625, 8.0, 4.0), index_of(0.0625, 16.0, 12.0),
          index_of(0.25, 0.25), index_of(0.5, 8.0, 8.0)}) {
        CAPTURE(candidates[k].light_paths, candidates[k].connections,
                candidates[k].connection_rays);
        const double predicted = pilot.errors[k] / pilot.errors[one];
        const double measured = measured_error(scene, candidates[k]) / measured_one;
        CAPTURE(predicted, measured);
        CHECK(predicted < tolerance * measured);
        CHECK(predicted > measured / tolerance);
    }
    // Rare hits of the lamp make that uncertain.
    CHECK(pilot.errors[index_of(0.0, 0.0)] > 5.0 * pilot.errors[one]);
    CHECK(measured_error(scene, candidates[index_of(0.0, 0.0)]) > 5.0 * measured_one);
}

TEST_CASE("a pilot predicts alike for images of any size", "[pilot]")
{
    // Of the small one it looks at nearly all pixels, of the large one at one in sixteen.
    const Scene scene = indirect_room();
    RenderOptions large = small();
    large.film.width = 6 * side;
    large.film.height = 6 * side;
    const PilotMeasurements of_small = pilot_of(scene, inside(), small());
    const PilotMeasurements of_large = pilot_of(scene, inside(), large);
    for (std::size_t k = 1; k < candidates.size(); ++k) {
        CAPTURE(candidates[k].light_paths, candidates[k].connections);
        CHECK(of_large.errors[k] < 1.5 * of_small.errors[k]);
        CHECK(of_large.errors[k] > of_small.errors[k] / 1.5);
        CHECK(of_large.costs[k] == Approx(of_small.costs[k]).epsilon(0.1));
    }
}

TEST_CASE("a pilot predicts how well lamps are seen with and without points of them", "[pilot]")
{
    const Scene scene = far_lamp();
    const VisibleLightErrors predicted = pilot_of(scene, inside(), small()).visible_lights;
    constexpr double qmc_variance_factor = pilot_constants.qmc.direct;
    const double by_hits = predicted.by_hits / qmc_variance_factor;
    const double measured = variance_of_samples(scene, IntegratorKind::mis) /
                            variance_of_samples(scene, IntegratorKind::bdpt);
    CAPTURE(predicted.by_hits, predicted.by_both, measured);
    CHECK(measured > 50.0);
    CHECK(by_hits / predicted.by_both < 2.0 * measured);
    CHECK(by_hits / predicted.by_both > 0.5 * measured);
}

TEST_CASE("a pilot depends on the scene, not on which samples are wanted", "[pilot]")
{
    const Scene scene = indirect_room();
    const PilotMeasurements pilot = pilot_of(scene, inside(), small());
    RenderOptions other = small();
    other.sampling.seed = 77;
    other.sampling.samples = {.begin = 5, .end = 9};
    other.sampling.sampler = SamplerKind::independent;
    other.bidirectional.light_paths = 3.0;
    const PilotMeasurements again = pilot_of(scene, inside(), other);
    CHECK(again.errors == pilot.errors);
    CHECK(again.visible_lights.by_hits == pilot.visible_lights.by_hits);
    CHECK(again.costs == pilot.costs);
    CHECK(again.stats == pilot.stats);
    other.transport.max_depth = 2;
    CHECK_FALSE(pilot_of(scene, inside(), other).errors == pilot.errors);
}

TEST_CASE("pilots are a small part of the planned work, and there are none for little work",
          "[pilot]")
{
    struct Case {
        int side;
        int samples;
        bool measures;
    };
    const auto [pixels, samples, measures] = GENERATE(values<Case>(
        {{64, 1, false}, {64, 9, false}, {64, 11, true}, {128, 4, true}, {512, 1, true}}));
    CAPTURE(pixels, samples);
    const Scene scene = indirect_room();
    RenderOptions options = small();
    options.film.width = pixels;
    options.film.height = pixels;
    options.integrator = IntegratorKind::mis;
    options.sampling.samples = {.begin = 0, .end = samples};
    options.sampling.planned_samples = samples;
    REQUIRE(is_worth_measuring(options) == measures);
    const auto work = static_cast<double>(render(scene, inside(), options).stats.rays.total());
    if (measures) {
        const auto rays =
            static_cast<double>(pilot_of(scene, inside(), options).stats.rays.total());
        CHECK(rays < 0.08 * work);
        CHECK(rays > 0.01 * work);
    }
    const double learning = light_pilot_side(options);
    CHECK(learning * learning <= 0.03 * planned_paths(options));
    CHECK((learning > 0.0) == (planned_paths(options) > 10240.0));
}

TEST_CASE("a pilot does not follow paths as long as renders may", "[pilot]")
{
    const Scene scene = indirect_room();
    RenderOptions options = small();
    options.transport.max_depth = 32;
    const PilotMeasurements pilot = pilot_of(scene, inside(), options);
    options.transport.max_depth = 1000;
    CHECK(pilot_of(scene, inside(), options).errors == pilot.errors);
    // But far enough for what the render is about.
    options.transport.min_depth = 40;
    options.transport.rr_start = 1000;
    CHECK(pilot_of(scene, inside(), options).errors[0] > 0.0);
}

TEST_CASE("what costs more rays has a higher price", "[pilot]")
{
    RenderStats stats;
    stats.paths = {.camera = 10, .light = 20};
    stats.rays = {.camera = 30,
                  .light = 60,
                  .shadow = 100,
                  .aov = 0,
                  .shadow_to_lens = 20,
                  .shadow_interior = 60};
    const auto cost = [&](double n, double c, double rays = 0.0) {
        const Candidate candidate{.light_paths = n, .connections = c, .connection_rays = rays};
        return sample_cost(candidate, stats, connection_rays(candidate, stats), 0.0);
    };
    CHECK(cost(0.0, 0.0) < cost(0.0625, 0.25));
    CHECK(cost(0.0625, 0.25) < cost(0.0625, 1.0));
    CHECK(cost(0.0625, 1.0) < cost(0.25, 1.0));
    CHECK(cost(0.25, 1.0) < cost(1.0, 1.0));
    // Without connections, light paths need not be kept, nor found again.
    CHECK(cost(0.0625, 0.0) < cost(0.0625, 0.25));
    const double quarter = cost(0.0625, 0.5) - cost(0.0625, 0.25);  // of a connection
    CHECK(cost(0.0625, 0.25) - cost(0.0625, 0.0) - quarter == Approx(80.0 + 0.0625 * 150.0));
    CHECK(cost(0.5, 0.0) - cost(0.25, 0.0) < cost(0.5, 0.25) - cost(0.25, 0.25));
    // Light paths of one's own need not be kept.
    CHECK(cost(1.0, 1.0) - cost(1.0, 0.25) < cost(0.5, 1.0) - cost(0.5, 0.25));
    // Connections that are chosen cost less than all, but more than as many light paths.
    CHECK(cost(0.25, 8.0, 4.0) < cost(0.25, 8.0, 8.0));
    CHECK(cost(0.25, 8.0, 8.0) < cost(0.25, 8.0));
    CHECK(cost(0.25, 1.0, 4.0) < cost(0.25, 8.0, 4.0));
    CHECK(sample_cost({.light_paths = 0.0, .connections = 0.0}, RenderStats{}, 0.0, 0.0) > 0.0);
    // Camera paths that leave the scene at once cost less: by the same part of a segment.
    const auto before_nothing = [&](double n, double background) {
        const Candidate candidate{.light_paths = n};
        return sample_cost(candidate, stats, 0.0, background);
    };
    CHECK(before_nothing(0.0, 0.0) - before_nothing(0.0, 0.5) == Approx(0.5 * 0.7 * 305.0));
    CHECK(before_nothing(0.5, 0.0) - before_nothing(0.5, 1.0) == Approx(0.7 * 345.0));
}

TEST_CASE("a connection costs its choice and the shadow rays that one of the pilot's took",
          "[pilot]")
{
    constexpr int camera_paths = 10;
    constexpr int shadow_rays = 3;  // of one connection
    RenderStats stats;
    stats.paths = {.camera = camera_paths};
    stats.rays.shadow_interior = PathShares::pilot_connections * shadow_rays * camera_paths;
    stats.rays.shadow = stats.rays.shadow_interior;
    const auto cost = [&](double connections) {
        const Candidate candidate{.light_paths = 0.25, .connections = connections};
        return sample_cost(candidate, stats, connection_rays(candidate, stats), 0.0);
    };
    constexpr double shadow_ray = 200.0;  // [ns]
    constexpr double choice = 30.0;
    CHECK(cost(1.0) - cost(0.25) == Approx(0.75 * (choice + shadow_rays * shadow_ray)));
}

TEST_CASE("no more connections are chosen than there are", "[pilot]")
{
    RenderStats stats;
    stats.paths = {.camera = 10};
    const Candidate chosen{.light_paths = 0.25, .connections = 8.0, .connection_rays = 16.0};
    CHECK(connection_rays(chosen, stats) == 0.0);
    stats.rays.shadow_interior = 10 * PathShares::pilot_connections;  // one per light path
    CHECK(connection_rays(chosen, stats) < 8.0);
    stats.rays.shadow_interior *= 1000;
    CHECK(connection_rays(chosen, stats) == Approx(16.0).epsilon(0.01));
    CHECK(connection_rays({.light_paths = 0.25, .connections = 8.0}, stats) == Approx(8000.0));
}

TEST_CASE("a pilot tells whose light paths do not fit into memory", "[pilot]")
{
    RenderOptions options = small();
    const PilotMeasurements all_fit = pilot_of(indirect_room(), inside(), options);
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        CHECK(all_fit.ruled_out[k] == (candidates[k].light_samples > 1.0));
    }
    options.bidirectional.light_path_memory = 1;
    const PilotMeasurements pilot = pilot_of(indirect_room(), inside(), options);
    CHECK(pilot.ruled_out[index_of(0.0625, 1.0)]);
    CHECK_FALSE(pilot.ruled_out[index_of(1.0, 1.0)]);  // each path has its own
    CHECK_FALSE(pilot.ruled_out[0]);
}

TEST_CASE("connections are not chosen where bodies scatter light", "[pilot][media]")
{
    const bool scatters = GENERATE(false, true);
    SceneBuilder builder;
    builder.walls(lambertian(Rgb(0.6f)), lambertian(Rgb(0.6f)));
    builder.lamp(0.9f, 0.4f, Rgb(5.0f));
    MaterialDesc body = glass(0.3f);
    body.attenuation_color = Rgb(0.5f);
    body.attenuation_distance = 0.2f;
    body.volume_scatter.color = Rgb(scatters ? 0.8f : 0.0f);
    builder.sphere({0.0f, 0.0f, 0.0f}, 0.5f, body, 16);
    const Scene scene(std::move(builder.desc));
    const PilotMeasurements pilot = pilot_of(scene, inside(), small());
    CHECK(pilot.ruled_out[index_of(0.0625, 8.0, 8.0)] == scatters);
    CHECK_FALSE(pilot.ruled_out[index_of(0.0625, 1.0)]);
}

TEST_CASE("two light samples are a choice where an environment shines", "[pilot]")
{
    const bool shines = GENERATE(false, true);
    SceneBuilder builder;
    builder.walls(lambertian(Rgb(0.6f)), lambertian(Rgb(0.6f)));
    builder.lamp(0.9f, 0.4f, Rgb(5.0f));
    if (shines) {
        builder.desc.lights.emplace_back(even_sky());
    }
    const Scene scene(std::move(builder.desc));
    const std::size_t two = index_of(0.0625, 8.0, 4.0, 2.0);
    const std::size_t one = index_of(0.0625, 8.0, 4.0);
    const PilotMeasurements pilot = pilot_of(scene, inside(), small());
    CHECK(pilot.ruled_out[two] != shines);
    CHECK(pilot.errors[two] < pilot.errors[one]);
    CHECK(pilot.costs[two] > pilot.costs[one]);
    CHECK(with_candidate(small(), candidates[two]).sampling.light_samples == 2);
    CHECK(with_candidate(small(), candidates[one]).sampling.light_samples == 1);
    // A number that is asked for stays.
    RenderOptions three = small();
    three.sampling.light_samples = 3;
    CHECK(pilot_of(scene, inside(), three).ruled_out[two]);
    CHECK(with_candidate(three, candidates[one]).sampling.light_samples == 3);
}

TEST_CASE("cells tell whether camera paths scatter there; else they cost less", "[pilot]")
{
    // A wall fills the right half of the image; there is nothing in the left half.
    SceneBuilder builder;
    builder.quad({0.0f, -9.0f, -1.0f}, {9.0f, -9.0f, -1.0f}, {9.0f, 9.0f, -1.0f},
                 {0.0f, 9.0f, -1.0f}, lambertian(Rgb(0.6f)));
    builder.quad({0.0f, 2.0f, 1.0f}, {0.0f, 3.0f, 1.0f}, {1.0f, 3.0f, 1.0f}, {1.0f, 2.0f, 1.0f},
                 emitter(Rgb(8.0f)));
    const PilotGrid grid(side, side);
    const CellErrors cells = pilot_of(Scene(std::move(builder.desc)), inside(), small()).cells;
    REQUIRE(cells.scattering.size() == grid.cells());
    const std::size_t in_front_of_nothing = grid.cell_at({2.5f, 12.5f});
    const std::size_t in_front_of_wall = grid.cell_at({21.5f, 12.5f});
    CHECK(cells.scattering[in_front_of_nothing] == 0.0);
    CHECK(cells.scattering[in_front_of_wall] == 1.0);
    RenderStats one_ray;
    one_ray.paths.camera = 1;
    one_ray.rays.camera = 1;
    const double cost = sample_cost(candidates[0], one_ray, 0.0, 0.0);
    CHECK(cells.costs[in_front_of_nothing][0] < 0.6 * cost);
    CHECK(cells.costs[in_front_of_wall][0] > 1.5 * cost);
}

TEST_CASE("a pilot that is abandoned traces nothing more", "[pilot]")
{
    const Scene scene = indirect_room();
    const RenderOptions options = small();
    const MovingCamera camera = open_camera(scene.world(), inside(), options);
    std::stop_source source;
    const auto rays = [&] {
        return measure(scene.world(), camera, options, nullptr, source.get_token())
            .stats.rays.total();
    };
    CHECK(rays() > 0);
    source.request_stop();
    CHECK(rays() == 0);
}

}  // namespace bdpt::test::pilot_test
