#include "path/weight_sums.h"

#include "camera/camera.h"
#include "catch.hpp"
#include "make_sample.h"
#include "path/connect.h"
#include "path/densities.h"
#include "path/merge.h"
#include "path/random_walk.h"
#include "scene_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace bdpt::weight_sums_test {
namespace {

using test::SceneBuilder;

constexpr int max_depth = 6;
constexpr int size = 16;

/// Glass, a mirror, gloss, alpha, delta lights, a lamp and the sky: all that makes a weight
/// special.
SceneDesc room(bool foggy)
{
    SceneBuilder builder;
    if (foggy) {
        builder.desc.fog = MediumDesc{
            .extinction = {0.3f, 0.6f, 1.2f}, .albedo = {0.9f, 0.8f, 0.7f}, .anisotropy = 0.4f};
    }
    builder.walls(test::plastic(Rgb(0.7f), 0.3f), test::lambertian(Rgb(0.6f)));
    builder.lamp(0.9f, 0.5f, Rgb(5.0f));
    builder.sphere({-0.4f, -0.6f, 0.0f}, 0.4f, test::glass(0.0f));
    builder.sphere({0.5f, -0.6f, 0.2f}, 0.4f,
                   foggy ? test::wax() : test::plastic(Rgb(0.5f), 0.0f));
    MaterialDesc pane = test::plastic({0.2f, 0.7f, 0.3f}, 0.4f);
    pane.base_color.w = 0.4f;
    pane.alpha_mode = AlphaMode::blend;
    builder.sphere({0.0f, 0.3f, 0.2f}, 0.3f, pane, 12);
    builder.light(
        EnvironmentLightDesc{.radiance = Image{.width = 1, .height = 1, .pixels = {Rgb(1)}}});
    builder.light(PointLightDesc{.position = {0.0f, 0.3f, 0.2f}, .intensity = Rgb(1.0f)});
    return std::move(builder.desc);
}

/// The weights of all contributions of one sample, in the order of their strategies.
std::vector<float> weights_of(SampleContext sample, const Subpath& light_path,
                              const Subpath& camera_path, const StrategySet& strategies,
                              const Merging& merging, PathWeigher& weigher)
{
    std::vector<float> weights;
    const auto add = [&](const std::optional<Contribution>& found) {
        weights.push_back(found ? found->weight : std::numeric_limits<float>::infinity());
    };
    for (int t = 2; t <= camera_path.size(); ++t) {
        add(hit_light(sample, camera_path.first(t), weigher));
        if (t <= max_depth) {
            add(connect_to_light(sample, camera_path.first(t), first_light_sample(sample, t),
                                 weigher));
        }
        for (int s = 2; s <= std::min(light_path.size(), max_depth + 1 - t); ++s) {
            if (!strategies.uses(s, t)) {
                continue;
            }
            add(connect_interior(sample, light_path.first(s), camera_path.first(t), weigher));
        }
        // However far apart: the weight does not depend on it.
        for (int s = 2; s <= light_path.size() && can_merge(camera_path.first(t).back()); ++s) {
            if (strategies.merges(s, t) && can_merge(light_path.first(s).back())) {
                add(merge(light_path.first(s), camera_path.first(t), merging, weigher));
            }
        }
    }
    for (int s = 2; s <= std::min(light_path.size(), max_depth); ++s) {
        const auto splat = connect_to_lens(sample, light_path.first(s), weigher);
        add(splat);
    }
    return weights;
}

/// It takes longer to build than to trace a thousand paths in.
const World& built_room(bool foggy)
{
    static const World clear(room(false));
    static const World fog(room(true));
    return foggy ? fog : clear;
}

}  // namespace

TEST_CASE("sums over subpaths weigh joins as all densities of the path do", "[mis]")
{
    const bool foggy = GENERATE(false, true);
    const World& world = built_room(foggy);
    const auto heuristic = GENERATE(Heuristic::balance, Heuristic::power);
    // Of light paths and connections for each camera path.
    const auto [light_paths, connections] =
        GENERATE(std::pair(1.0, 1.0), std::pair(3.0, 3.0), std::pair(0.25, 1.0),
                 std::pair(0.5, 2.5), std::pair(4.0, 0.25), std::pair(2.0, 0.0));
    const int light_samples = GENERATE(1, 4);
    const float lens_radius = GENERATE(0.0f, 0.2f);
    const bool merges = GENERATE(false, true);
    CAPTURE(static_cast<int>(heuristic), light_paths, connections, light_samples, lens_radius,
            merges);
    CameraDesc desc = test::room_camera();
    desc.lens_radius = lens_radius;
    const Camera camera(desc, size, size);
    RenderOptions options;
    options.integrator = merges ? IntegratorKind::vcm : IntegratorKind::bdpt;
    options.transport.max_depth = max_depth;
    options.bidirectional.light_paths = light_paths;
    options.bidirectional.connections = connections;
    options.sampling.light_samples = light_samples;
    const StrategySet strategies(options);
    REQUIRE(WeightSums::applies(strategies, heuristic));
    Subpath light_path(strategies.light_vertices());
    Subpath camera_path(strategies.camera_vertices());
    Merging merging;
    if (merges) {
        merging.radius = 0.5f;
        merging.light_paths = 10.0f;
    }
    PathWeigher gathers(world, camera, strategies, heuristic, max_depth + 1, merging.weight());
    PathWeigher sums(world, camera, strategies, heuristic, max_depth + 1, merging.weight());
    int compared = 0;
    RayCounts rays;
    for (int i = 0; i < 1000; ++i) {
        SampleContext sample = test::make_sample(
            world, camera, {SamplerKind::sobol, 1, i % size, i / size % size, i}, rays);
        const Vec2 raster(static_cast<float>(i % size) + 0.5f,
                          static_cast<float>(i / size % size) + 0.5f);
        trace_camera_subpath(sample, raster, {.max_vertices = camera_path.capacity()}, camera_path);
        trace_light_subpath(sample, {.max_vertices = light_path.capacity()},
                            strategies.next_event_sampling(), light_path);
        sums.begin_camera_path(camera_path.all());
        sums.begin_light_path(light_path.all());
        const auto by_sums = weights_of(sample, light_path, camera_path, strategies, merging, sums);
        const auto expected =
            weights_of(sample, light_path, camera_path, strategies, merging, gathers);
        REQUIRE(by_sums.size() == expected.size());
        for (std::size_t k = 0; k < expected.size(); ++k) {
            if (std::isfinite(expected[k]) && expected[k] > 1e-30f) {
                REQUIRE(by_sums[k] == Approx(expected[k]).epsilon(1e-5));
                ++compared;
            }
        }
    }
    CHECK(compared > (connections > 0.0 ? 2000 : 1750));
}

TEST_CASE("connections in a body that scatters light count as few samples", "[mis]")
{
    const World& world = built_room(true);
    const Media& media = world.media();
    const auto vertex = [](VertexKind kind, MediumId medium) {
        PathVertex result;
        result.kind = kind;
        result.end.media = SideMedia::around(medium);
        return result;
    };
    const MediumId wax = world.medium_at({0.5f, -0.6f, 0.2f});
    const float n = media.mean_scatterings(wax);
    REQUIRE(n > 2.0f);
    const PathVertex inside = vertex(VertexKind::medium, wax);
    const PathVertex surface = vertex(VertexKind::surface, wax);
    const PathVertex in_fog = vertex(VertexKind::medium, media.fog());
    CHECK(connection_count(world, inside, inside) == Approx(1.0f / (n * n)));
    CHECK(connection_count(world, inside, surface) == Approx(1.0f / n));
    CHECK(connection_count(world, surface, inside) == Approx(1.0f / n));
    CHECK(connection_count(world, surface, surface) == 1.0f);
    CHECK(connection_count(world, in_fog, in_fog) == 1.0f);
    CHECK(connection_count(world, in_fog, surface) == 1.0f);
}

TEST_CASE("next-event estimation and splats count in full in a body", "[mis]")
{
    // All of the path but the light and the lens lies in wax.
    const World& world = built_room(true);
    const Camera camera(test::room_camera(), size, size);
    RenderOptions options;
    options.integrator = IntegratorKind::bdpt;
    const StrategySet strategies(options);
    const MediumId wax = world.medium_at({0.5f, -0.6f, 0.2f});
    const float n = world.media().mean_scatterings(wax);
    const Bsdf scatter({0, 0, 1}, Frame::from_normal({0, 0, 1}), {0, 0, 1},
                       HenyeyGreenstein(Rgb(1.0f), 0.0f));
    std::vector<PathVertex> light(3);
    std::vector<PathVertex> seen(3);
    light[0].kind = VertexKind::light;
    light[0].light = LightId{0};
    seen[0].kind = VertexKind::camera;
    for (PathVertex* vertex : {&light[1], &light[2], &seen[1], &seen[2]}) {
        vertex->kind = VertexKind::medium;
        vertex->bsdf = &scatter;
        vertex->end.media = SideMedia::around(wax);
    }
    for (std::vector<PathVertex>* path : {&light, &seen}) {
        for (PathVertex& vertex : *path) {
            vertex.pdf_fwd = {1.0f};
            vertex.pdf_rev = {1.0f};
        }
    }
    PathWeigher weigher(world, camera, strategies, Heuristic::balance, max_depth + 1);
    const JoinDensities ones{{1.0f}, {1.0f}, {1.0f}, {1.0f}, {1.0f}};
    const float weight = weigher.weight(light, seen, ones);
    const std::vector<float> expected{1.0f,        1.0f, 1 / (n * n), 1 / (n * n),
                                      1 / (n * n), 1.0f, 0.0f};
    const auto counts = weigher.last_path().sample_counts;
    REQUIRE(counts.size() == expected.size());
    for (std::size_t s = 0; s < expected.size(); ++s) {
        CAPTURE(s);
        CHECK(counts[s] == Approx(expected[s]));
    }
    CHECK(weight == Approx(1 / (n * n) / (3.0f + 3 / (n * n))));
}

TEST_CASE("sets of strategies with gaps are not weighed by sums", "[mis]")
{
    const auto applies = [](const RenderOptions& options, Heuristic heuristic = Heuristic::power) {
        return WeightSums::applies(StrategySet(options), heuristic);
    };
    RenderOptions options;
    options.integrator = IntegratorKind::bdpt;
    CHECK(applies(options));
    CHECK_FALSE(applies(options, Heuristic::maximum));
    CHECK_FALSE(applies(options, Heuristic::cutoff));
    CHECK_FALSE(applies(options, Heuristic::uniform));
    RenderOptions other = options;
    other.bidirectional.disabled = {{2, 1}};
    CHECK_FALSE(applies(other));
    other = options;
    other.bidirectional.max_camera_depth = options.transport.max_depth - 1;
    CHECK_FALSE(applies(other));
    other = options;
    other.bidirectional.max_light_depth = options.transport.max_depth - 1;
    CHECK_FALSE(applies(other));
    other = options;
    other.integrator = IntegratorKind::lt;
    CHECK_FALSE(applies(other));
    other = options;
    other.transport.min_depth = 3;
    CHECK(applies(other));
}

}  // namespace bdpt::weight_sums_test
