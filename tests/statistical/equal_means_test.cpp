// The comparisons of means that other tests rely on.

#include "equal_means.h"

#include "catch.hpp"
#include "scene_builder.h"

#include <utility>

namespace bdpt::test {
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
    CHECK(result.greatest_bias == Approx(1.0));
    CHECK(result.found_bias == Approx(1.0));
    const Scene little = square_of(Rgb(1.0f - 1e-4f), 9.0f);
    TileMeans near = means_of(little);
    const MeanComparison close = compare_means(near, 1.0, quick);
    CHECK(close.found_bias == Approx(1e-4).epsilon(0.02));
}

}  // namespace bdpt::test
