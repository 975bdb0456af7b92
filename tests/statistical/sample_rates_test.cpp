// Adaptive sampling leaves means as they are: whatever the rates are, and with those that a pilot
// has found. Rates that a render's own samples have found do not.

#include <bdpt/part/sample_rates.h>
#include <bdpt/render.h>

#include "catch.hpp"
#include "equal_means.h"
#include "rates/rate_map.h"
#include "scene_builder.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace bdpt::test::sample_rates_test {
namespace {

/// Quarters of it are fairly bright, in different ways.
Scene furnished()
{
    SceneBuilder builder;
    builder.walls(lambertian(Rgb(0.7f)), plastic(Rgb(0.6f), 0.3f));
    builder.lamp(0.9f, 0.5f, Rgb(5.0f));
    builder.sphere({0.3f, -0.6f, 0.2f}, 0.4f, metal(Rgb(0.8f), 0.3f), 24);
    return Scene(std::move(builder.desc));
}

/// Random, and on the left less than on the right, so that tiles differ in their means.
std::shared_ptr<const SampleRates> uneven_rates()
{
    constexpr int side = TileMeans::side;
    std::mt19937 engine(4);
    std::vector<std::int8_t> exponents;
    for (int i = 0; i < side * side; ++i) {
        const int least = i % side < side / 2 ? -2 : 0;
        exponents.push_back(
            static_cast<std::int8_t>(std::uniform_int_distribution<int>(least, least + 2)(engine)));
    }
    return std::make_shared<const SampleRates>(side, side, std::move(exponents));
}

RenderOptions options(IntegratorKind kind)
{
    RenderOptions result;
    result.integrator = kind;
    result.transport.max_depth = 3;
    return result;
}

/// What rates have to go with.
std::vector<std::pair<std::string, RenderOptions>> kinds()
{
    std::vector<std::pair<std::string, RenderOptions>> result{
        {"mis", options(IntegratorKind::mis)},
        {"bdpt, own light path", options(IntegratorKind::bdpt)},
        {"bdpt, shared light paths", options(IntegratorKind::bdpt)},
        {"bdpt, more connections than light paths", options(IntegratorKind::bdpt)},
        {"bdpt, light tracing and emission alone", options(IntegratorKind::bdpt)},
        {"bdpt, clamped", options(IntegratorKind::bdpt)},
        {"mis, clamped", options(IntegratorKind::mis)}};
    result[2].second.bidirectional.light_paths = 0.3;
    result[2].second.bidirectional.connections = 0.75;
    result[3].second.bidirectional.light_paths = 2.0;
    result[3].second.bidirectional.connections = 2.5;
    result[4].second.bidirectional.max_camera_depth = 1;
    result[5].second.film.clamp = 0.4f;
    result[6].second.film.clamp = 0.4f;
    return result;
}

}  // namespace

TEST_CASE("rates change no mean", "[rates][long]")
{
    const Scene scene = furnished();
    for (const auto& [name, plain] : kinds()) {
        RenderOptions adaptive = plain;
        adaptive.sampling.rates = uneven_rates();
        adaptive.sampling.seed = 1U << 30U;
        TileMeans a(scene, room_camera(), adaptive, SamplerKind::sobol);
        TileMeans b(scene, room_camera(), plain, SamplerKind::sobol);
        const MeanComparison result = compare_means(a, b, {.detectable_bias = 0.06});
        INFO(name << ": " << result.text());
        CHECK(result.equal);
        CHECK(result.sharp_enough);
    }
}

namespace {

constexpr int side = 32;      // [pixels]
constexpr int renders = 300;  // of other seeds
constexpr int all_pixels = side * side;

/// A floor under a small lamp that only BSDF sampling finds: few samples have all the light.
Scene rarely_lit()
{
    SceneBuilder builder;
    builder.quad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, lambertian(Rgb(0.8f)));
    builder.lamp(1.0f, 0.04f, Rgb(100.0f));
    return Scene(std::move(builder.desc));
}

CameraDesc from_above()
{
    return camera_at({0.0f, 0.8f, 2.0f}, {0.0f, 0.0f, 0.0f}, 0.5f);
}

RenderOptions rare(std::uint64_t seed)
{
    RenderOptions result = options(IntegratorKind::pt);
    result.transport.max_depth = 2;
    result.film.width = side;
    result.film.height = side;
    result.sampling.seed = seed;
    result.sampling.sampler = SamplerKind::independent;
    result.sampling.samples = {.begin = 0, .end = 8};
    return result;
}

double mean_of(const Image& image)
{
    double sum = 0.0;
    for (const Rgb& pixel : image.pixels) {
        sum += static_cast<double>(pixel.g) / all_pixels;
    }
    return sum;
}

/// Rates by the rule of the pilot, but from a render with that seed.
std::shared_ptr<const SampleRates> rates_by(const Scene& scene, std::uint64_t seed)
{
    RateEvidence evidence{.width = side,
                          .height = side,
                          .brightness = std::vector<double>(all_pixels, 1.0),
                          .cost = std::vector<double>(all_pixels, 1.0)};
    for (const Rgb& pixel : render(scene, from_above(), rare(seed)).film.develop().pixels) {
        evidence.variance.push_back(static_cast<double>(pixel.g) * static_cast<double>(pixel.g));
    }
    return std::make_shared<const SampleRates>(rates_for(evidence));
}

enum class Rule { uniform, pilot, fresh_samples, own_samples };

/// Of the images' means.
Moments means_by(Rule rule, const Scene& scene)
{
    constexpr std::uint64_t elsewhere = 1'000'000;
    const auto pilot =
        std::make_shared<const SampleRates>(sample_rates(scene, from_above(), rare(0)));
    Moments moments;
    for (std::uint64_t i = 0; i < renders; ++i) {
        // Uniform renders have other seeds than those they are compared with.
        const std::uint64_t seed = rule == Rule::uniform ? 2 * elsewhere + i : i;
        RenderOptions o = rare(seed);
        if (rule == Rule::pilot) {
            o.sampling.rates = pilot;
        } else if (rule != Rule::uniform) {
            o.sampling.rates = rates_by(scene, rule == Rule::own_samples ? seed : elsewhere + seed);
        }
        moments.add(mean_of(render(scene, from_above(), o).film.develop()));
    }
    return moments;
}

}  // namespace

TEST_CASE("rates that a pilot has found are unbiased, those of a render's own samples are not",
          "[rates][long]")
{
    const Scene scene = rarely_lit();
    const Moments truth = means_by(Rule::uniform, scene);
    const auto z = [&](Rule rule) {
        const Moments found = means_by(rule, scene);
        return (found.mean() - truth.mean()) /
               std::hypot(found.standard_error(), truth.standard_error());
    };
    const double pilot = z(Rule::pilot);
    const double fresh = z(Rule::fresh_samples);
    const double own = z(Rule::own_samples);
    INFO("z by pilot " << pilot << ", fresh samples " << fresh << ", own samples " << own);
    CHECK(truth.standard_error() < 0.03 * truth.mean());
    CHECK(std::abs(pilot) < 4.0);
    CHECK(std::abs(fresh) < 4.0);
    // Where a bright sample was found, more follow, among which it counts less: too dark.
    CHECK(own < -6.0);
}

}  // namespace bdpt::test::sample_rates_test
