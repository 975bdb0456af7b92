// Silhouettes of coarse meshes, whose smooth normals face away from the lens, are not black.

#include <bdpt/render.h>

#include "catch.hpp"
#include "scene_builder.h"

#include <glm/gtc/matrix_transform.hpp>

#include <utility>

namespace bdpt::silhouette_test {

TEST_CASE("the lens sees all of a diffuse octahedron with the normals of a sphere")
{
    test::SceneBuilder builder;
    builder.place(builder.sphere_mesh(4), test::lambertian(Rgb(0.8f)),
                  glm::rotate(Mat4(1.0f), 0.45f, Vec3(0.0f, 1.0f, 0.0f)));
    const Rgb sky(1.0f);
    builder.light(
        EnvironmentLightDesc{.radiance = Image{.width = 1, .height = 1, .pixels = {sky}}});
    const Scene scene(std::move(builder.desc));
    RenderOptions options;
    options.integrator = GENERATE(IntegratorKind::pt, IntegratorKind::nee, IntegratorKind::mis,
                                  IntegratorKind::bdpt);
    options.film.width = 24;
    options.film.height = 24;
    options.film.filter.kind = FilterKind::box;
    options.sampling.samples = {.begin = 0, .end = 64};
    const Image image =
        render(scene, test::camera_at({0.0f, 0.0f, 5.0f}, {0.0f, 0.0f, 0.0f}, 0.4f), options)
            .film.develop();
    // The surface reflects up to 0.8 of the sky; pixels in a black rim would be far below that.
    int of_surface = 0;
    for (const Rgb& pixel : image.pixels) {
        CHECK(pixel.g > 0.3f);
        of_surface += pixel.g < 0.9f ? 1 : 0;
    }
    CHECK(of_surface > 100);
}

}  // namespace bdpt::silhouette_test
