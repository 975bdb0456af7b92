#include "camera/camera.h"
#include "catch.hpp"
#include "light/learned/learned_light.h"
#include "make_sample.h"
#include "many_lights.h"
#include "path/connect.h"
#include "path/densities.h"
#include "path/random_walk.h"
#include "scene_builder.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace bdpt::path_weights_test {
namespace {

using test::SceneBuilder;

/// A room with all that makes densities special: mirror, glass, gloss, two kinds of lights.
SceneDesc room(bool foggy)
{
    SceneBuilder builder;
    if (foggy) {
        builder.desc.fog = MediumDesc{
            .extinction = {0.3f, 0.6f, 1.2f}, .albedo = {0.9f, 0.8f, 0.7f}, .anisotropy = 0.4f};
        builder.sphere({0.0f, -0.7f, -0.4f}, 0.3f, test::wax(), 12);
    }
    builder.walls(test::plastic(Rgb(0.7f), 0.3f), test::lambertian(Rgb(0.6f)));
    builder.ceiling(test::lambertian(Rgb(0.7f))).lamp(0.9f, 0.5f, Rgb(5.0f));
    builder.sphere({-0.4f, -0.6f, 0.0f}, 0.4f, test::glass(0.0f));
    builder.sphere({0.5f, -0.6f, 0.2f}, 0.4f, test::plastic(Rgb(0.5f), 0.0f));
    builder.light(
        EnvironmentLightDesc{.radiance = Image{.width = 1, .height = 1, .pixels = {Rgb(1)}}});
    return std::move(builder.desc);
}

/// Sum of the weights of all strategies that can make the path that was weighed last.
float sum_of_weights(const PathDensities& path, Heuristic heuristic)
{
    float sum = 0.0f;
    for (std::size_t s = 0; s < path.sample_counts.size(); ++s) {
        if (path.sample_counts[s] > 0.0f) {
            sum += mis_weight(path, static_cast<int>(s), heuristic);
        }
    }
    return sum;
}

}  // namespace

TEST_CASE("weights of all strategies sum to one on traced paths", "[mis]")
{
    const World world(room(GENERATE(false, true)));
    constexpr int max_depth = 6;
    constexpr int size = 16;
    const Camera camera(test::room_camera(), size, size);
    Subpath light_path(max_depth);
    RenderOptions options;
    options.integrator = IntegratorKind::bdpt;
    options.transport.max_depth = max_depth;
    std::tie(options.bidirectional.light_paths, options.bidirectional.connections) =
        GENERATE(std::tuple(1.0, 1.0), std::tuple(0.1, 1.0), std::tuple(2.5, 0.4));
    options.sampling.light_samples = GENERATE(1, 16);
    const StrategySet strategies(options);
    Subpath camera_path(max_depth + 1);
    RayCounts rays;
    int paths = 0;
    for (const auto heuristic : {Heuristic::balance, Heuristic::power}) {
        PathWeigher weigher(world, camera, strategies, heuristic, max_depth + 1);
        weigher.keep_paths();
        const auto check = [&](const std::optional<Contribution>& found) {
            if (found) {
                ++paths;
                REQUIRE(found->weight >= 0.0f);
                REQUIRE(found->weight <= 1.0f);
                REQUIRE(sum_of_weights(weigher.last_path(), heuristic) ==
                        Approx(1.0).epsilon(1e-5));
            }
        };
        for (int i = 0; i < 2000; ++i) {
            SampleContext sample = test::make_sample(
                world, camera, {SamplerKind::sobol, 1, i % size, i / size, i}, rays);
            const Vec2 raster(static_cast<float>(i % size) + 0.5f,
                              static_cast<float>(i / size % size) + 0.5f);
            trace_camera_subpath(sample, raster, {.max_vertices = camera_path.capacity()},
                                 camera_path);
            trace_light_subpath(sample, {.max_vertices = light_path.capacity()},
                                strategies.next_event_sampling(), light_path);
            for (int t = 2; t <= camera_path.size(); ++t) {
                check(hit_light(sample, camera_path.first(t), weigher));
                if (t <= max_depth) {
                    check(connect_to_light(sample, camera_path.first(t),
                                           first_light_sample(sample, t), weigher));
                }
                for (int s = 2; s <= std::min(light_path.size(), max_depth + 1 - t); ++s) {
                    check(connect_interior(sample, light_path.first(s), camera_path.first(t),
                                           weigher));
                }
            }
        }
    }
    CHECK(paths > 5000);
}

TEST_CASE("lights that are seen directly have the weights that their densities give", "[mis]")
{
    SceneBuilder builder;
    builder.lamp(0.9f, 0.5f, Rgb(5.0f));
    builder.light(
        EnvironmentLightDesc{.radiance = Image{.width = 1, .height = 1, .pixels = {Rgb(1)}}});
    const World world(std::move(builder.desc));
    CameraDesc lens = test::room_camera();
    lens.lens_radius = GENERATE(0.0f, 0.1f);
    const Camera camera(lens, 16, 16);
    RenderOptions options;
    options.integrator = IntegratorKind::bdpt;
    options.bidirectional.disabled =
        GENERATE(std::vector<Strategy>{}, std::vector<Strategy>{{.s = 1, .t = 1}},
                 std::vector<Strategy>{{.s = 2, .t = 0}});
    const StrategySet strategies(options);
    constexpr auto heuristic = Heuristic::balance;
    PathWeigher weigher(world, camera, strategies, heuristic, 2);
    PathWeigher by_densities(world, camera, strategies, heuristic, 2);
    by_densities.keep_paths();
    Subpath path(2);
    RayCounts rays;
    int full = 0;
    int shared = 0;
    for (int i = 0; i < 256; ++i) {
        SampleContext sample =
            test::make_sample(world, camera, {SamplerKind::sobol, 1, i % 16, i / 16, i}, rays);
        const Vec2 raster(static_cast<float>(i % 16) + 0.5f, static_cast<float>(i / 16) + 0.5f);
        trace_camera_subpath(sample, raster, {.max_vertices = 2}, path);
        const auto found = hit_light(sample, path.first(2), weigher);
        const auto expected = hit_light(sample, path.first(2), by_densities);
        REQUIRE(found.has_value());
        REQUIRE(expected.has_value());
        CHECK(found->weight == expected->weight);
        CHECK(found->unweighted == expected->unweighted);
        ++(found->weight == 1.0f ? full : shared);
    }
    CHECK(full + shared == 256);
    const bool by_hits_of_lens = camera.has_finite_lens() && strategies.uses(2, 0);
    CHECK((full > 0) == !by_hits_of_lens);
    CHECK((shared > 0) == (by_hits_of_lens || strategies.uses(1, 1)));
}

TEST_CASE("joining and hitting agree about the densities of the same path", "[mis]")
{
    // The camera walk finds the lamp: weigh that path as it was made (s = 0). Then treat its own
    // last vertex as the light sample of next-event estimation: the densities must be the same.
    const World world(room(GENERATE(false, true)));
    constexpr int max_depth = 5;
    const Camera camera(test::room_camera(), 16, 16);
    RenderOptions options;
    options.integrator = IntegratorKind::bdpt;
    options.transport.max_depth = max_depth;
    const StrategySet strategies(options);
    Subpath camera_path(max_depth + 1);
    PathWeigher weigher(world, camera, strategies, Heuristic::balance, max_depth + 1);
    RayCounts rays;
    int compared = 0;
    for (int i = 0; i < 3000; ++i) {
        SampleContext sample =
            test::make_sample(world, camera, {SamplerKind::sobol, 2, i % 16, i / 16 % 16, i}, rays);
        const Vec2 raster(static_cast<float>(i % 16) + 0.5f,
                          static_cast<float>(i / 16 % 16) + 0.5f);
        trace_camera_subpath(sample, raster, {.max_vertices = camera_path.capacity()}, camera_path);
        for (int t = 3; t <= camera_path.size(); ++t) {
            const auto path = camera_path.first(t);
            const PathVertex& x0 = path.back();
            const PathVertex& x1 = path[path.size() - 2];
            const bool finite_light = x0.light && x0.kind == VertexKind::surface;
            if (!finite_light || !x1.connectible || x1.scattered_delta) {
                continue;
            }
            const auto hit = hit_light(sample, path, weigher);
            if (!hit) {
                continue;
            }
            const PathDensities made = weigher.last_path();
            // C_0 as a join would compute it equals the density that the walk stored.
            const Vec3 along = x0.end.p - x1.end.p;
            const float distance_squared = dot(along, along);
            const Vec3 wi = along / std::sqrt(distance_squared);
            const BsdfEval f = x1.bsdf->eval(wi, TransportMode::radiance);
            const SegmentTransmission transmission =
                world.media().transmission(x1.end, x0.end, along, std::sqrt(distance_squared));
            const float joined =
                to_area(f.pdf_fwd, std::abs(dot(x0.end.ng, wi)), distance_squared).value *
                transmission.p_unscattered;
            CHECK(made.from_camera[0].value == Approx(joined).epsilon(1e-3));
            // L_2 as a join would compute it equals what the walk stored for a reversed walk.
            const PathVertex& x2 = path[path.size() - 3];
            const float reversed = f.pdf_rev.value * x2.area_per_solid_angle;
            CHECK(made.from_light[2].value == Approx(reversed).epsilon(1e-3));
            ++compared;
        }
    }
    CHECK(compared > 100);
}

TEST_CASE("next-event estimation has the density that others are weighed against", "[mis]")
{
    // The density of what was sampled, as strategies evaluate it that made the path otherwise.
    SceneBuilder builder = test::random_lights(4, 40);
    builder.walls(test::plastic(Rgb(0.7f), 0.3f), test::lambertian(Rgb(0.6f)));
    builder.sphere({-0.4f, -0.6f, 0.0f}, 0.4f, test::glass(0.3f), 12);
    builder.sphere({0.5f, -0.6f, 0.2f}, 0.4f, test::lambertian(Rgb(0.5f)), 8);
    MaterialDesc paper = test::lambertian(Rgb(0.5f));
    paper.diffuse_transmission.factor = 0.5f;
    builder.quad({-0.5f, 0.0f, -0.3f}, {0.5f, 0.0f, -0.3f}, {0.5f, 0.6f, 0.1f}, {-0.5f, 0.6f, 0.1f},
                 paper);
    Image sky{.width = 32, .height = 16, .pixels = std::vector<Rgb>(512, Rgb(0.5f))};
    sky.pixels[70] = Rgb(50.0f);
    builder.light(EnvironmentLightDesc{.radiance = std::move(sky)});
    builder.light(DirectionalLightDesc{.direction = {0.3f, -1.0f, 0.2f}});
    const World world(std::move(builder.desc));
    REQUIRE(world.lights().next_event_lights().group_count() == 3);
    const Camera camera(test::room_camera(), 16, 16);
    const bool knows = GENERATE(false, true);
    CAPTURE(knows);
    // Of each tile of the sky, of each group, and everywhere, something else: a place of its own is
    // a factor of its own.
    std::vector<EnvironmentVisibility::Trial> trials;
    std::vector<GroupShares::Finding> findings;
    for (std::uint32_t i = 0; i < 100000; ++i) {
        const Vec3 p(static_cast<float>(i % 7) / 3.0f - 1.0f,
                     static_cast<float>(i % 11) / 5.0f - 1.0f,
                     static_cast<float>(i % 13) / 6.0f - 1.0f);
        trials.push_back(
            {.p = p, .tile = i % 128, .visible = (i / 128 + i % 7) % (2 + i % 5) == 0});
        findings.push_back({.p = p, .group = i % 3, .value = static_cast<float>(i % 7 * (i % 11))});
    }
    const LearnedLight learned{.visibility = EnvironmentVisibility(trials),
                               .groups = GroupShares(findings, 3)};
    REQUIRE(learned.visibility->cells() > 50);
    REQUIRE(learned.groups->cells() > 50);
    const NextEventSampling sampling{.environments = EnvironmentSampling::compensated,
                                     .lights = LightSampling::tree,
                                     .learned = knows ? &learned : nullptr};
    int changed = 0;
    int other_choices = 0;
    int full = 0;
    Subpath path(5);
    RayCounts rays;
    int compared = 0;
    int from_sky = 0;
    int through = 0;
    for (int i = 0; i < 4000; ++i) {
        SampleContext sample = test::make_sample(
            world, camera, {SamplerKind::independent, 3, i % 16, i / 16 % 16, i}, rays);
        Sampler& sampler = sample.sampler;
        const Vec2 raster = 16.0f * sampler.next_2d();
        trace_camera_subpath(sample, raster, {.max_vertices = path.capacity()}, path);
        for (int t = 2; t <= path.size(); ++t) {
            const PathVertex& x1 = path[t - 1];
            if (!scatters(x1.kind) || !x1.connectible) {
                continue;
            }
            const LightSampleContext receiver = light_sample_context(x1);
            const auto found = world.lights().sample_next_event(
                receiver, sampler.next_2d(), [&sampler] { return sampler.next_fine(); }, sampling,
                0.0f);
            if (!found.incident ||
                x1.bsdf->eval(found.incident->wi, TransportMode::radiance).f_cos.g <= 0) {
                continue;
            }
            const Light& light = world.lights()[found.light];
            const IncidentSample& incident = *found.incident;
            PathVertex x0;
            x0.kind = light.is_infinite() ? VertexKind::infinite : VertexKind::light;
            x0.light = found.light;
            x0.end = incident.end;
            x0.end.p = light.is_infinite() ? incident.wi : incident.end.p;
            x0.barycentrics = incident.barycentrics;
            const float density = next_event_density(sample, x0, x1, sampling).value;
            // The density of the point is that of the light's own tests, but for rounding.
            const LightPoint point{.p = x0.end.p, .ng = x0.end.ng, .barycentrics = x0.barycentrics};
            const float of_point = light.pdf_incident(receiver, point, sampling.environments).value;
            const float chosen =
                world.lights().next_event_probability(found.light, receiver, sampling);
            REQUIRE(chosen == Approx(found.probability).epsilon(1e-5));
            if (knows) {
                const float unlearned =
                    world.lights().context_probability(found.light, receiver, sampling.lights);
                other_choices += std::abs(chosen / unlearned - 1.0f) > 0.05f ? 1 : 0;
                float sum = 0.0f;
                for (std::uint32_t id = 0; id < world.lights().size(); ++id) {
                    sum += world.lights().next_event_probability(LightId{id}, receiver, sampling);
                }
                REQUIRE(sum <= 1.0f + 1e-4f);
                full += sum > 1.0f - 1e-4f ? 1 : 0;
            }
            if (knows && light.is_infinite() && !light.is_delta()) {
                changed +=
                    std::abs(density / (of_point * found.probability) - 1.0f) > 0.05f ? 1 : 0;
            } else {
                REQUIRE(density == Approx(of_point * found.probability).epsilon(1e-5));
            }
            if (light.is_infinite() && !light.is_delta()) {
                REQUIRE(density == Approx(found.pdf().value).epsilon(1e-5));
                ++from_sky;
            }
            ++compared;
            const Vec3 to_previous = path[t - 2].end.p - x1.end.p;
            through += dot(incident.wi, x1.end.ng) * dot(to_previous, x1.end.ng) < 0.0f ? 1 : 0;
        }
    }
    CHECK(compared > 2000);
    CHECK(from_sky > 200);
    CHECK(through > 50);  // glass and paper
    CHECK((changed > 100) == knows);
    CHECK((other_choices > compared / 2) == knows);
    // Elsewhere some light that the tree meets cannot shine there.
    CHECK((full > compared / 2) == knows);
}

TEST_CASE("distances in coloured media leave the sum of the throughput as it is", "[media]")
{
    SceneBuilder builder;
    builder.walls(test::lambertian(Rgb(0.5f)), test::lambertian(Rgb(0.5f)));
    builder.lamp(0.9f, 0.5f, Rgb(5.0f));
    builder.desc.fog =
        MediumDesc{.extinction = {2.0f, 8.0f, 30.0f}, .albedo = Rgb(1.0f), .anisotropy = 0.3f};
    const World world(std::move(builder.desc));
    const Camera camera(test::room_camera(), 16, 16);
    const auto sum = [](Rgb beta) { return beta.r + beta.g + beta.b; };
    RenderOptions options;
    options.integrator = IntegratorKind::bdpt;
    constexpr int vertices = 40;
    Subpath path(vertices);
    RayCounts rays;
    int longest = 0;
    const auto check = [&](float expected) {
        for (int k = 1; k < path.size() && path[k].kind == VertexKind::medium; ++k) {
            // `beta` excludes the scattering at its vertex, and so its factor sigma_s.
            const Rgb scattered = path[k].beta * Rgb(2.0f, 8.0f, 30.0f);
            REQUIRE(sum(scattered) == Approx(expected).epsilon(1e-4));
            longest = std::max(longest, k);
        }
    };
    for (int i = 0; i < 200; ++i) {
        SampleContext sample =
            test::make_sample(world, camera, {SamplerKind::sobol, 1, i % 16, i / 16, i}, rays);
        trace_camera_subpath(sample, {8.5f, 8.5f}, {.max_vertices = vertices}, path);
        check(3.0f);
        trace_light_subpath(sample, {.max_vertices = vertices},
                            StrategySet(options).next_event_sampling(), path);
        if (path.size() > 1) {
            check(sum(path[1].beta * Rgb(2.0f, 8.0f, 30.0f)));
        }
    }
    CHECK(longest >= 20);
}

}  // namespace bdpt::path_weights_test
