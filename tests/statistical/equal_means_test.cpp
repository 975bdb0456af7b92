// The comparisons of means that other tests rely on.

#include "equal_means.h"

#include "catch.hpp"
#include "scene_builder.h"

#include <cmath>
#include <utility>

namespace bdpt::test::equal_means_test {
namespace {

/// A square before a camera that sees nothing else in the left half of the film, or in all of it,
/// and black in the rest.
Scene square_of(Rgb radiance, float right)
{
    MaterialDesc unlit = lambertian(radiance);
    unlit.unlit = true;
    SceneBuilder builder;
    builder.quad({-9, -9, 0}, {right, -9, 0}, {right, 9, 0}, {-9, 9, 0}, unlit);
    return Scene(std::move(builder.desc));
}

TileMeans means_of(const Scene& scene)
{
    RenderOptions options;
    options.integrator = IntegratorKind::pt;
    options.transport.max_depth = 1;
    return {scene, camera_at({0.0f, 0.0f, 5.0f}, {0.0f, 0.0f, 0.0f}, 0.5f), options};
}

constexpr Sharpness quick{.max_batches = 64};

}  // namespace

TEST_CASE("black renders are equal, but nothing can be found in them", "[statistics]")
{
    const Scene black = square_of(Rgb(0.0f), 9.0f);
    const Scene half = square_of(Rgb(1.0f), 0.0f);
    const Scene full = square_of(Rgb(1.0f), 9.0f);
    for (const Scene* scene : {&black, &half, &full}) {
        TileMeans a = means_of(*scene);
        TileMeans b = means_of(*scene);
        const MeanComparison result = compare_means(a, b, quick);
        INFO(result.text());
        CHECK(result.equal);
        CHECK(result.sharp_enough == (scene != &black));
    }
}

TEST_CASE("each tile counts, not only that with the greatest z", "[statistics]")
{
    // A half is off by all of its light, the other by a tenth.
    const Scene half = square_of(Rgb(0.9f), 0.0f);
    TileMeans means = means_of(half);
    const MeanComparison result = compare_means(means, 1.0, quick);
    CHECK_FALSE(result.equal);
    CHECK(result.max_bias == Approx(1.0));
    CHECK(result.found_bias == Approx(1.0));
    const Scene little = square_of(Rgb(1.0f - 1e-4f), 9.0f);
    TileMeans near = means_of(little);
    const MeanComparison close = compare_means(near, 1.0, quick);
    CHECK(close.found_bias == Approx(1e-4).epsilon(0.02));
    CHECK(close.batches == 32);
    // Student's t with 31 degrees of freedom: one tail of 0.0000125.
    CHECK(close.critical_z == Approx(4.947).epsilon(1e-3));

    // The left half is off by little and has no noise; the right one is off by half, with noise, so
    // that its z is less.
    SceneBuilder builder;
    MaterialDesc unlit = lambertian(Rgb(0.99f));
    unlit.unlit = true;
    builder.quad({-9, -9, 0}, {0, -9, 0}, {0, 9, 0}, {-9, 9, 0}, unlit);
    unlit = lambertian(Rgb(1.0f));
    unlit.unlit = true;
    unlit.alpha_mode = AlphaMode::blend;
    unlit.base_color.w = 0.5f;
    builder.quad({0, -9, 0}, {9, -9, 0}, {9, 9, 0}, {0, 9, 0}, unlit);
    const Scene unequal(std::move(builder.desc));
    TileMeans noisy = means_of(unequal);
    const MeanComparison both = compare_means(noisy, 1.0, quick);
    CHECK(std::abs(both.worst_bias) == Approx(0.01).epsilon(0.02));
    CHECK(both.found_bias == Approx(0.5).epsilon(0.1));
}

}  // namespace bdpt::test::equal_means_test
