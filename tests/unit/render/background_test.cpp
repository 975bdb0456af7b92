// What `Background::none` leaves out: the environment where the camera sees it directly, and
// nothing else.

#include <bdpt/render.h>

#include "catch.hpp"
#include "scene_builder.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace bdpt::background_test {
namespace {

constexpr int size = 24;
const Rgb sky(1.0f, 0.75f, 0.5f);

MaterialDesc veil()
{
    MaterialDesc material = test::lambertian(Rgb(0.5f));
    material.alpha_mode = AlphaMode::blend;
    material.base_color.w = 0.4f;
    material.double_sided = true;
    return material;
}

/// A diffuse sphere, one of glass and a veil before a sky of one colour, and a sphere behind the
/// camera, so that light from the sky gets to the lens.
SceneDesc spheres()
{
    test::SceneBuilder builder;
    builder.sphere({-0.6f, 0.0f, 0.0f}, 0.5f, test::lambertian(Rgb(0.8f)));
    builder.sphere({0.6f, 0.0f, 0.0f}, 0.5f, test::glass(0.0f));
    builder.quad({-1.0f, -0.9f, 0.7f}, {1.0f, -0.9f, 0.7f}, {1.0f, -0.2f, 0.7f},
                 {-1.0f, -0.2f, 0.7f}, veil());
    builder.sphere({0.0f, 0.0f, 9.0f}, 0.5f, test::lambertian(Rgb(0.8f)));
    builder.light(
        EnvironmentLightDesc{.radiance = Image{.width = 1, .height = 1, .pixels = {sky}}});
    return builder.desc;
}

const CameraDesc pinhole = test::camera_at({0.0f, 0.0f, 5.0f}, {0.0f, 0.0f, 0.0f}, 0.6f);

RenderOptions options(IntegratorKind integrator, Background background)
{
    RenderOptions result;
    result.integrator = integrator;
    result.film.width = size;
    result.film.height = size;
    result.film.aovs = {Aov::alpha};
    result.sampling.samples = {.begin = 0, .end = 16};
    result.transport.background = background;
    return result;
}

struct Picture {
    Image image;
    std::vector<float> alpha;
};

Picture picture(const Scene& scene, const CameraDesc& camera, const RenderOptions& options)
{
    const RenderResult result = render(scene, camera, options);
    return {result.film.develop(), result.aovs.develop(result.film).at(0).values};
}

/// Rows at the top, which show nothing but sky.
bool is_empty(std::size_t pixel)
{
    return pixel < 3 * size;
}

constexpr IntegratorKind of_camera_paths[]{IntegratorKind::pt, IntegratorKind::nee,
                                           IntegratorKind::mis, IntegratorKind::bdpt,
                                           IntegratorKind::vcm};

}  // namespace

TEST_CASE("images without the background, composed over it, are those with it", "[background]")
{
    const Scene scene(spheres());
    const auto shared = GENERATE(false, true);
    for (const IntegratorKind kind : of_camera_paths) {
        for (const CameraDesc& camera : {pinhole, test::in_parallel(pinhole, 3.0f)}) {
            RenderOptions with = options(kind, Background::environment);
            RenderOptions without = options(kind, Background::none);
            if (shared) {
                with.bidirectional.light_paths = 0.5;
                without.bidirectional.light_paths = 0.5;
            }
            const Picture whole = picture(scene, camera, with);
            const Picture cut = picture(scene, camera, without);
            CAPTURE(static_cast<int>(kind), shared);
            CHECK(whole.alpha == cut.alpha);
            float worst = 0.0f;
            int partial = 0;
            for (std::size_t i = 0; i < cut.alpha.size(); ++i) {
                const float alpha = cut.alpha[i];
                const Rgb composed = cut.image.pixels[i] + (1.0f - alpha) * sky;
                for (int c = 0; c < 3; ++c) {
                    worst = std::max(worst, std::abs(composed[c] - whole.image.pixels[i][c]));
                }
                partial += alpha > 0.0f && alpha < 1.0f ? 1 : 0;
                if (is_empty(i)) {
                    CHECK(alpha == 0.0f);
                    CHECK(cut.image.pixels[i] == Rgb(0.0f));
                }
            }
            CHECK(worst < 1e-5f);
            CHECK(partial > 20);  // edges and the veil
        }
    }
}

TEST_CASE("what refracts and reflects the environment stays opaque", "[background]")
{
    const Scene scene(spheres());
    const Picture cut = picture(scene, pinhole, options(IntegratorKind::mis, Background::none));
    // The middle of the sphere of glass, a little above the veil.
    constexpr std::size_t glass = 11 * size + 16;
    CHECK(cut.alpha[glass] == 1.0f);
    CHECK(cut.image.pixels[glass].r > 0.5f);
}

TEST_CASE("light paths do not show the environment through a lens, either", "[background]")
{
    const Scene scene(spheres());
    // Wide, so that some light paths cross the lens and are in the image.
    CameraDesc lens = test::with_lens(pinhole, 1.0f, 5.0f);
    lens.vertical_fov = 1.5f;
    for (const IntegratorKind kind :
         {IntegratorKind::lt, IntegratorKind::bdpt, IntegratorKind::vcm, IntegratorKind::mis}) {
        RenderOptions seen = options(kind, Background::environment);
        seen.transport.max_depth = 1;
        RenderOptions hidden = options(kind, Background::none);
        hidden.transport.max_depth = 1;
        const std::string name = std::to_string(static_cast<int>(kind));
        CAPTURE(name);
        const auto total = [&](const RenderOptions& o) {
            float sum = 0.0f;
            for (const Rgb& pixel : picture(scene, lens, o).image.pixels) {
                sum += pixel.r;
            }
            return sum;
        };
        CHECK(total(seen) > 0.0f);
        CHECK(total(hidden) == 0.0f);
    }
}

TEST_CASE("lights that are no environment stay visible", "[background]")
{
    test::SceneBuilder builder;
    builder.quad({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}, test::emitter(Rgb(2.0f)));
    builder.light(
        EnvironmentLightDesc{.radiance = Image{.width = 1, .height = 1, .pixels = {sky}}});
    const Scene scene(builder.desc);
    for (const IntegratorKind kind : of_camera_paths) {
        RenderOptions hidden = options(kind, Background::none);
        hidden.transport.max_depth = 1;
        const Picture shown = picture(scene, pinhole, hidden);
        double sum = 0.0;
        for (const Rgb& pixel : shown.image.pixels) {
            sum += static_cast<double>(pixel.r);
        }
        CAPTURE(static_cast<int>(kind));
        CHECK(sum / (size * size) == Approx(2.0).epsilon(0.1));
    }
}

}  // namespace bdpt::background_test
