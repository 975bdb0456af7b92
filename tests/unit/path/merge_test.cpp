// What one merge brings, where that is known.

#include "path/merge.h"

#include "camera/camera.h"
#include "catch.hpp"
#include "lambertian_floor.h"
#include "make_sample.h"
#include "path/random_walk.h"

#include <utility>
#include <vector>

namespace bdpt::test::merge_test {
namespace {

constexpr double merge_radius = 0.05;
constexpr double disk = pi_double * merge_radius * merge_radius;

/// Each vertex where the camera sees `world` first, merged with each where light falls first,
/// however far apart they are: the value does not depend on it.
std::vector<float> merged_values(const World& world)
{
    constexpr int samples = 1024;
    const Camera camera(patch_camera(), 1, 1);
    RenderOptions options;
    options.integrator = IntegratorKind::vcm;
    const StrategySet strategies(options);
    Merging merging;
    merging.radius = static_cast<float>(merge_radius);
    merging.light_paths = 1.0f;
    PathWeigher weigher(world, camera, strategies, Heuristic::balance, 4, merging.weight());
    Subpath light(2);
    Subpath seen(2);
    RayCounts rays;
    std::vector<float> values;
    for (int i = 0; i < samples; ++i) {
        SampleContext sample =
            make_sample(world, camera, {SamplerKind::independent, 1, 0, 0, i}, rays);
        trace_camera_subpath(sample, Vec2(0.5f), {.max_vertices = 2}, seen);
        trace_light_subpath(sample, {.max_vertices = 2}, strategies.next_event_sampling(), light);
        if (seen.size() == 2 && light.size() == 2) {
            if (const auto found = merge(light.all(), seen.all(), merging, weigher)) {
                values.push_back(found->unweighted.g);
            }
        }
    }
    return values;
}

void check_all_are(const std::vector<float>& values, double expected)
{
    CHECK(values.size() > 20);
    for (const float value : values) {
        CHECK(value == Approx(expected));
    }
}

}  // namespace

TEST_CASE("a merge on a veil has its opacity once, though both walks were stopped by it", "[vcm]")
{
    const float opacity = GENERATE(1.0f, 0.3f);
    constexpr float intensity = 2.0f;
    SceneBuilder builder = lambertian_floor();
    builder.desc.materials[0].alpha_mode = AlphaMode::blend;
    builder.desc.materials[0].base_color.w = opacity;
    builder.light(PointLightDesc{.position = {0.0f, 0.2f, 0.0f}, .intensity = Rgb(intensity)});
    const World world(std::move(builder.desc));
    const double flux = 4.0 * pi_double * static_cast<double>(intensity);
    // Both walks stop with this probability, and the share of light that is reflected has it once.
    const double stops_twice = static_cast<double>(opacity * opacity);
    const double brdf = static_cast<double>(opacity * floor_albedo) / pi_double;
    check_all_are(merged_values(world), brdf * flux / disk / stops_twice);
}

TEST_CASE("a merge takes the light of a sun from where the sun is", "[vcm]")
{
    constexpr float illuminance = 3.0f;
    SceneBuilder builder = lambertian_floor();
    builder.light(
        DirectionalLightDesc{.direction = {0.6f, -0.8f, 0.0f}, .illuminance = Rgb(illuminance)});
    const World world(std::move(builder.desc));
    const double flux = static_cast<double>(illuminance / world.bounding_sphere().pdf_disk().value);
    check_all_are(merged_values(world),
                  static_cast<double>(floor_albedo) / pi_double * flux / disk);
}

}  // namespace bdpt::test::merge_test
