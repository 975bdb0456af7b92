#include <bdpt/eval/equal_time.h>
#include <bdpt/eval/metric.h>
#include <bdpt/render.h>

#include <array>
#include <vector>

#include "bench_scene.h"
#include "catch.hpp"

namespace bdpt::eval::equal_time_test {
namespace {

struct Fixture {
    SceneDesc desc = test::lit_floor();
    Scene scene{desc};
    BenchScene subject{.name = "floor",
                       .file = "floor.gltf",
                       .scene = scene,
                       .camera = test::floor_camera(),
                       .width = 12,
                       .height = 9};
    std::array<Variant, 3> variants{Variant{"mis", {}}, Variant{"pt", {}}, Variant{"mis", {}}};

    Fixture()
    {
        for (Variant& variant : variants) {
            variant.options.transport.max_depth = 3;
            variant.options.integrator = IntegratorKind::mis;
        }
        variants[1].options.integrator = IntegratorKind::pt;
    }
    [[nodiscard]] Reference reference() const
    {
        return render_reference(subject, variants[0].options, 256);
    }
    [[nodiscard]] double error_of(const Variant& variant, std::uint64_t seed,
                                  const Reference& reference) const
    {
        RenderOptions options = variant.options;
        options.film.width = subject.width;
        options.film.height = subject.height;
        options.sampling.samples = {0, 4};
        options.sampling.planned_samples = 0;
        options.sampling.seed = seed;
        const Image image = render(scene, subject.camera, options).film.develop();
        return evaluate(Metric::relmse, image, reference.image,
                        {.epsilon = 0.01, .epsilon_unit = EpsilonUnit::reference_mean}) -
               reference.noise;
    }
};

TEST_CASE("variants of a contest have the errors of their renders, a seed for each round")
{
    const Fixture contest;
    const Reference reference = contest.reference();
    const auto scores = compare_at_equal_time(contest.subject, reference, contest.variants,
                                              {.samples = 4, .rounds = 3});
    REQUIRE(scores.size() == 3);
    CHECK(scores[0].error.median == scores[2].error.median);
    for (std::size_t v = 0; v < scores.size(); ++v) {
        CAPTURE(v);
        std::vector<double> errors;
        for (std::uint64_t seed = 0; seed < 3; ++seed) {
            errors.push_back(contest.error_of(contest.variants[v], seed, reference));
        }
        const Spread expected = spread(errors);
        CHECK(scores[v].samples == 4);
        CHECK(scores[v].sample_seconds > 0.0);
        CHECK(scores[v].error.median == Approx(expected.median));
        CHECK(scores[v].error.least == Approx(expected.least));
        CHECK(scores[v].error.greatest == Approx(expected.greatest));
        CHECK(expected.least < expected.greatest);
    }
    CHECK(scores[1].error.median > scores[0].error.median);
}

TEST_CASE("variants of a contest at equal time take the samples that fit into it")
{
    const Fixture contest;
    const auto scores =
        compare_at_equal_time(contest.subject, contest.reference(),
                              std::span(contest.variants).first(1), {.seconds = 0.02, .rounds = 1});
    REQUIRE(scores.size() == 1);
    CHECK(scores[0].samples >= 2);
    CHECK(scores[0].samples % 2 == 0);
    CHECK(scores[0].error.median > 0.0);
}

TEST_CASE("a reference is the render of its samples by bdpt, its noise that of its halves")
{
    const Fixture contest;
    const Reference reference = contest.reference();
    RenderOptions options = contest.variants[0].options;
    options.integrator = IntegratorKind::bdpt;
    options.film.width = 12;
    options.film.height = 9;
    options.sampling.samples = {0, 256};
    options.sampling.planned_samples = 0;
    options.sampling.seed = 1'000'003;
    const Film film = render(contest.scene, contest.subject.camera, options).film;
    CHECK(reference.image.pixels == film.develop().pixels);
    const double epsilon = bench_scale(reference.image).squared_epsilon;
    CHECK(reference.noise > 0.0);
    double sum = 0.0;
    const Image first = film.develop_half(0);
    const Image second = film.develop_half(1);
    for (std::size_t i = 0; i < first.pixels.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const double r = static_cast<double>(reference.image.pixels[i][c]);
            const double d =
                static_cast<double>(first.pixels[i][c]) - static_cast<double>(second.pixels[i][c]);
            sum += d * d / (r * r + epsilon);
        }
    }
    CHECK(reference.noise == Approx(sum / (12.0 * static_cast<double>(first.pixels.size()))));
}

}  // namespace
}  // namespace bdpt::eval::equal_time_test
