// What surfaces that are not opaque let pass, known on paper.

#include "catch.hpp"
#include "equal_means.h"
#include "scene_builder.h"

namespace bdpt::test::closed_form_alpha_test {
namespace {

constexpr IntegratorKind integrators[] = {IntegratorKind::pt, IntegratorKind::mis,
                                          IntegratorKind::bdpt};

RenderOptions options(IntegratorKind integrator, int max_depth, std::uint64_t seed = 0)
{
    RenderOptions result;
    result.integrator = integrator;
    result.transport.max_depth = max_depth;
    result.sampling.seed = seed;
    return result;
}

/// The whole pane is one triangle, which camera rays and the light of what they see both cross: a
/// sample that decided both by one number would let (1 - a) pass.
TEST_CASE("a black pane that light crosses twice lets (1 - a)^2 pass", "[closed-form][alpha]")
{
    constexpr float alpha = 0.6f;
    const auto scene_with = [](bool pane) {
        SceneBuilder builder;
        builder.quad({-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}, lambertian(Rgb(0.8f)));
        const float dimmed = pane ? 1.0f : (1.0f - alpha) * (1.0f - alpha);
        builder.quad({-1, 3, 6}, {-1, 2, 6}, {1, 2, 6}, {1, 3, 6}, emitter(Rgb(9.0f * dimmed)));
        builder.light(PointLightDesc{.position = {1, -1, 5}, .intensity = Rgb(20.0f * dimmed)});
        if (pane) {
            MaterialDesc black = lambertian(Rgb(0.0f));
            black.base_color.w = alpha;
            black.alpha_mode = AlphaMode::blend;
            MeshDesc triangle;
            triangle.positions = {{-30, -30, 2}, {60, -30, 2}, {-30, 60, 2}};
            triangle.triangles = {{0, 1, 2}};
            builder.place(builder.add_mesh(std::move(triangle)), black, Mat4(1.0f));
        }
        return Scene(std::move(builder.desc));
    };
    const Scene with_pane = scene_with(true);
    const Scene without = scene_with(false);
    const CameraDesc camera = camera_at({0.5f, 0.2f, 5.0f}, {0.0f, 0.0f, 0.0f}, 0.5f);
    std::uint64_t seed = 100;
    TileMeans expected(without, camera, options(IntegratorKind::mis, 2, seed));
    for (const auto kind : integrators) {
        TileMeans means(with_pane, camera, options(kind, 2, ++seed));
        const MeanComparison result = compare_means(means, expected);
        INFO("integrator " << static_cast<int>(kind) << ": " << result.text());
        CHECK(result.sharp_enough);
        CHECK(result.equal);
    }
}

TEST_CASE("white panes in a white furnace are invisible, whatever their alpha",
          "[closed-form][alpha]")
{
    SceneBuilder builder;
    builder.desc.images.push_back({.width = 2,
                                   .height = 2,
                                   .bytes = {255, 255, 255, 0, 255, 255, 255, 255,  //
                                             255, 255, 255, 130, 255, 255, 255, 80}});
    MaterialDesc blended = lambertian(Rgb(1.0f));
    blended.alpha_mode = AlphaMode::blend;
    blended.base_color_texture = TextureRef{.image = ImageId{0}};
    MaterialDesc masked = blended;
    masked.alpha_mode = AlphaMode::mask;
    builder.quad({-1, -1, 0.2f}, {1, -1, 0.2f}, {1, 1, 0}, {-1, 1, 0}, blended);
    builder.quad({-1, -1, -0.7f}, {1, -1, -0.7f}, {1, 1, 0.3f}, {-1, 1, 0.3f}, masked);
    builder.light(
        EnvironmentLightDesc{.radiance = Image{.width = 1, .height = 1, .pixels = {Rgb(2)}}});
    const Scene scene(std::move(builder.desc));
    const CameraDesc camera = camera_at({0.3f, 0.5f, 4.0f}, {0.0f, 0.0f, 0.0f}, 0.4f);
    for (const auto kind : integrators) {
        TileMeans means(scene, camera, options(kind, 40));
        const MeanComparison result = compare_means(means, 2.0, {.detectable_bias = 0.01});
        INFO("integrator " << static_cast<int>(kind) << ": " << result.text());
        CHECK(result.sharp_enough);
        CHECK(result.equal);
    }
}

/// Le a (1 + (1 - a) + (1 - a)^2 + ...) over n panes that reflect nothing.
TEST_CASE("panes that shine add up to Le (1 - (1 - a)^n)", "[closed-form][alpha][long]")
{
    constexpr float alpha = 0.35f;
    const bool unlit = GENERATE(false, true);
    MaterialDesc glow = emitter(Rgb(0.8f), unlit ? Rgb(0.8f) : Rgb(0.0f));
    glow.unlit = unlit;
    glow.alpha_mode = AlphaMode::blend;
    glow.base_color.w = alpha;
    SceneBuilder builder;
    for (const float z : {0.0f, -1.0f, -2.0f}) {
        builder.quad({-9, -9, z}, {9, -9, z}, {9, 9, z}, {-9, 9, z}, glow);
    }
    const Scene scene(std::move(builder.desc));
    const CameraDesc camera = camera_at({0.3f, 0.5f, 4.0f}, {0.0f, 0.0f, 0.0f}, 0.4f);
    constexpr double rest = 1.0 - static_cast<double>(alpha);
    for (const auto kind : integrators) {
        TileMeans means(scene, camera, options(kind, 3));
        const MeanComparison result =
            compare_means(means, 0.8 * (1.0 - rest * rest * rest), {.detectable_bias = 0.01});
        INFO("integrator " << static_cast<int>(kind) << ": " << result.text());
        CHECK(result.sharp_enough);
        CHECK(result.equal);
    }
}

}  // namespace
}  // namespace bdpt::test::closed_form_alpha_test
