// Which connections are chosen, and how often: each as often as its scale says.

#include "integrator/bidirectional/connection_chooser.h"

#include "camera/camera.h"
#include "catch.hpp"
#include "make_sample.h"
#include "material/models/simple_models.h"
#include "math/rgb.h"
#include "path/random_walk.h"
#include "path/strategy_set.h"
#include "room.h"
#include "scene/world.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace bdpt::test::connection_chooser_test {
namespace {

constexpr int max_depth = 5;
constexpr int light_paths = 8;
constexpr float rays = 4.0f;

/// The walls and the lamp of the room, and before the camera a sheet that scatters light to both of
/// its sides.
Scene room_with_sheet()
{
    SceneBuilder builder;
    builder.walls(lambertian(Rgb(0.7f)), plastic(Rgb(0.6f), 0.3f));
    builder.lamp(0.9f, 0.4f, Rgb(5.0f));
    MaterialDesc sheet = lambertian(Rgb(0.8f));
    sheet.diffuse_transmission.factor = 0.5f;
    builder.quad({-0.6f, -0.6f, 0.0f}, {0.6f, -0.6f, 0.0f}, {0.6f, 0.6f, 0.0f}, {-0.6f, 0.6f, 0.0f},
                 sheet);
    return Scene(std::move(builder.desc));
}

RenderOptions chosen_options()
{
    RenderOptions options;
    options.integrator = IntegratorKind::bdpt;
    options.transport.max_depth = max_depth;
    options.transport.rr_start = max_depth + 1;
    options.bidirectional.light_paths = 0.25;
    options.bidirectional.connections = light_paths;
    options.bidirectional.connection_rays = static_cast<double>(rays);
    return options;
}

/// A camera path and the light paths of a bundle.
class Paths {
public:
    Paths(const World& world, int index) : camera_(room_camera(), 1, 1)
    {
        RayCounts counts;
        SampleContext sample =
            make_sample(world, camera_, {SamplerKind::independent, 1, 0, 0, index}, counts);
        trace_camera_subpath(sample, Vec2(0.5f),
                             {.max_vertices = max_depth + 1, .rr_start = max_depth + 1}, camera);
        const StrategySet strategies(chosen_options());
        for (int i = 0; i < light_paths; ++i) {
            sample.sampler = {SamplerKind::independent, 2, i, 0, index};
            trace_light_subpath(sample, {.max_vertices = max_depth, .rr_start = max_depth + 1},
                                strategies.next_event_sampling(), light.emplace_back(max_depth));
            add_to_blocks(static_cast<std::uint32_t>(i));
        }
    }

    /// Tests whether light is scattered at both ends of a connection.
    [[nodiscard]] bool scatter(std::size_t path, int s, int t) const
    {
        const PathVertex& y = light[path].first(s).back();
        const PathVertex& z = camera.first(t).back();
        if (!can_choose(y) || !can_choose(z)) {
            return false;
        }
        const Vec3 wi = glm::normalize(y.end.p - z.end.p);
        return !is_black(z.bsdf->eval(wi, TransportMode::radiance).f_cos) &&
               !is_black(y.bsdf->eval(-wi, TransportMode::importance).f_cos);
    }

    Subpath camera{max_depth + 1};
    std::vector<Subpath> light;
    std::vector<LightVertexBlock> blocks;

private:
    void add_to_blocks(std::uint32_t path)
    {
        for (int s = 2; s <= light[path].size(); ++s) {
            const auto prefix = std::as_const(light[path]).first(s);
            if (!can_choose(prefix.back())) {
                continue;
            }
            if (entries_ % LightVertexBlock::size == 0) {
                blocks.push_back({});
            }
            const std::size_t i = entries_++ % LightVertexBlock::size;
            blocks.back().set(i, prefix, light_paths);
            blocks.back().path[i] = path;
        }
    }

    Camera camera_;
    std::size_t entries_ = 0;
};

constexpr int numbers = 20000;

/// Returns the middle of interval `i` of all `numbers`.
float number(int i)
{
    return (static_cast<float>(i) + 0.5f) / static_cast<float>(numbers);
}

using Pair = std::tuple<std::uint32_t, int, int>;  // path, s, t

}  // namespace

TEST_CASE("a connection is chosen as often as its scale says", "[light-paths]")
{
    const Scene scene = room();
    const Paths paths(scene.world(), 3);
    // With many rays, some connections are expected to be chosen more often than once.
    const float wanted = GENERATE(4.0f, 200.0f);
    RenderOptions options = chosen_options();
    options.bidirectional.connection_rays = static_cast<double>(wanted);
    ConnectionChooser chooser(options);
    std::map<Pair, double> sums;
    double chosen = 0.0;
    float most = 0.0f;
    for (int i = 0; i < numbers; ++i) {
        for (const auto& each : chooser.choose(paths.camera, paths.blocks, number(i))) {
            sums[{each.path, each.s, each.t}] += static_cast<double>(each.scale) / numbers;
            chosen += static_cast<double>(each.scale * each.chance) / numbers;
            most = std::max(most, each.chance);
        }
    }
    CHECK(sums.size() > 10);
    for (const auto& [pair, sum] : sums) {
        CAPTURE(std::get<0>(pair), std::get<1>(pair), std::get<2>(pair));
        CHECK(sum == Approx(1.0).epsilon(0.02));
    }
    CHECK(chosen == Approx(static_cast<double>(wanted)).epsilon(1e-3));
    CHECK((most > 2.0f) == (wanted > 4.0f));
}

TEST_CASE("every connection that brings light may be chosen", "[light-paths]")
{
    const Scene scene = GENERATE(false, true) ? room_with_sheet() : room();
    ConnectionChooser chooser(chosen_options());
    int connections = 0;
    for (int index = 0; index < 16; ++index) {
        const Paths paths(scene.world(), index);
        const auto pairs = static_cast<float>(paths.blocks.size() * LightVertexBlock::size *
                                              static_cast<std::size_t>(max_depth));
        std::set<Pair> chosen;
        bool in_bounds = true;
        for (int i = 0; i < numbers; ++i) {
            for (const auto& each : chooser.choose(paths.camera, paths.blocks, number(i))) {
                chosen.insert({each.path, each.s, each.t});
                // All pairs have a share of the rays.
                in_bounds = in_bounds && each.scale < pairs / (0.1f * rays) &&
                            each.s + each.t <= max_depth + 1;
            }
        }
        CHECK(in_bounds);
        for (std::uint32_t path = 0; path < light_paths; ++path) {
            for (int s = 2; s <= paths.light[path].size(); ++s) {
                for (int t = 2; t <= std::min(paths.camera.size(), max_depth + 1 - s); ++t) {
                    if (paths.scatter(path, s, t)) {
                        CAPTURE(index, path, s, t);
                        CHECK(chosen.count({path, s, t}) == 1);
                        ++connections;
                    }
                }
            }
        }
    }
    CHECK(connections > 200);
}

TEST_CASE("near and bright vertices of like colour are chosen more often than others",
          "[light-paths]")
{
    // Two vertices straight above a camera vertex, which has a colour.
    const Scene scene = room();
    Paths paths(scene.world(), 0);
    const PathVertex& vertex = paths.camera.first(2).back();
    const Rgb power = estimated_power(vertex);
    REQUIRE(vertex.bsdf->base_color().r != vertex.bsdf->base_color().b);
    constexpr Rgb red{1.0f, 0.0f, 0.0f};
    constexpr Rgb blue{0.0f, 0.0f, 1.0f};
    struct Case {
        Vec2 distances;  // [m]
        std::array<Rgb, 2> powers;
        double share;  // of the first
    };
    const auto share_of_red = static_cast<double>(power.r / (power.r + power.b));
    const std::array cases{Case{{1.0f, 2.0f}, {red, red}, 0.8},
                           Case{{1.0f, 1.0f}, {3.0f * red, red}, 0.75},
                           Case{{1.0f, 1.0f}, {red, blue}, share_of_red}};
    const Case& expected = cases[GENERATE(0u, 1u, 2u)];
    LightVertexBlock block{};
    for (int i = 0; i < 2; ++i) {
        const Vec3 p = vertex.end.p + expected.distances[i] * *vertex.bsdf->opaque_normal();
        const Rgb color = expected.powers[static_cast<std::size_t>(i)];
        block.x[i] = p.x;
        block.y[i] = p.y;
        block.z[i] = p.z;
        block.any_side[i] = 1.0f;
        block.red[i] = color.r;
        block.green[i] = color.g;
        block.blue[i] = color.b;
        block.s[i] = max_depth - 1;  // no other camera vertex may be connected to it
        block.path[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(i);
    }
    RenderOptions one_ray = chosen_options();
    one_ray.bidirectional.connection_rays = 1.0;
    ConnectionChooser chooser(one_ray);
    std::array<double, 2> shares{};
    for (int i = 0; i < numbers; ++i) {
        for (const auto& each : chooser.choose(paths.camera, std::span(&block, 1), number(i))) {
            REQUIRE(each.t == 2);
            shares[each.path] += 1.0 / numbers;
        }
    }
    // A tenth is divided evenly.
    CHECK(shares[0] == Approx(0.9 * expected.share + 0.1 * 0.5).epsilon(0.01));
    CHECK(shares[1] == Approx(0.9 * (1.0 - expected.share) + 0.1 * 0.5).epsilon(0.01));
}

TEST_CASE("the estimated power of a vertex has the colour of its surface", "[light-paths]")
{
    const Bsdf red({0.0f, 0.0f, 1.0f}, Frame({0.0f, 0.0f, 1.0f}), {0.0f, 0.0f, 1.0f},
                   Lambertian({0.8f, 0.4f, 0.0f}));
    PathVertex vertex;
    vertex.beta = {1.0f, 2.0f, 3.0f};
    vertex.bsdf = &red;
    const Rgb power = estimated_power(vertex);
    CHECK(power.r == Approx(0.8f));
    CHECK(power.g == Approx(0.8f));
    CHECK(power.b == Approx(3.0f * 0.04f));  // as a dielectric reflects
}

}  // namespace bdpt::test::connection_chooser_test
