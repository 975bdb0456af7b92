// Steps of noise: what is one, and that the rates of auto make none that an eye sees.

#include <bdpt/eval/evenness.h>

#include <bdpt/error.h>
#include <bdpt/io/gltf.h>
#include <bdpt/render.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "test_images.h"

namespace bdpt::eval::evenness_test {
namespace {

using test::flat;
using test::random_image;

constexpr double visible = 1.3;  // ratio of noise
/// Where Sobol points gain most: half of them have twice the noise there, and more.
constexpr double visible_with_few = 1.5;

constexpr int width = 32;
constexpr int height = 16;
constexpr int seeds = 12;

/// Noise that is `ratio` times as large from column 16 on, one image for each seed.
std::vector<Image> noise(std::uint64_t first, float ratio)
{
    std::vector<Image> images;
    for (int seed = 0; seed < seeds; ++seed) {
        images.push_back(random_image(width, height, first + static_cast<std::uint64_t>(seed)));
        for (int i = 0; i < width * height; ++i) {
            images.back().pixels[static_cast<std::size_t>(i)] *= i % width < 16 ? 1.0f : ratio;
        }
    }
    return images;
}

Layer layer(const char* name, const char* channels, std::vector<float> value)
{
    Layer result{
        .name = name, .channels = channels, .width = width, .height = height, .values = {}};
    for (int i = 0; i < width * height; ++i) {
        result.values.insert(result.values.end(), value.begin(), value.end());
    }
    return result;
}

/// Layers of one grey surface.
std::vector<Layer> one_surface()
{
    return {layer("albedo", "RGB", {0.5f, 0.5f, 0.5f}), layer("normal", "XYZ", {0.0f, 0.0f, 1.0f}),
            layer("CryptoObject00", "rgba", {3.0f, 1.0f, 0.0f, 0.0f})};
}

/// Sets one value of all pixels from column 16 on.
std::vector<Layer> changed(std::size_t which, std::size_t channel, float value)
{
    std::vector<Layer> layers = one_surface();
    for (std::size_t i = 0; i < width * height; ++i) {
        if (i % width >= 16) {
            layers[which].values[i * layers[which].channels.size() + channel] = value;
        }
    }
    return layers;
}

/// Tests whether a step crosses column 16.
bool crosses(const NoiseStep& step)
{
    return step.first.x0 < 16 && step.second.x1 > 16;
}

/// What a scene of scenes/ gives `auto`: the options without rates, and the rates.
struct Subject {
    Scene scene;
    CameraDesc camera;
    IntegratorChoice choice;
};

Subject subject(const std::string& name, int side, std::int64_t samples)
{
    io::LoadedScene loaded =
        io::load_gltf(std::string(BDPT_SOURCE_DIR) + "/scenes/" + name + ".gltf");
    Scene scene(std::move(loaded.scene));
    RenderOptions options;
    options.film = {.width = side, .height = side};
    options.sampling.samples = {0, samples};
    IntegratorChoice choice = choose_integrator(scene, loaded.cameras.at(0), options);
    return {.scene = std::move(scene), .camera = loaded.cameras.at(0), .choice = std::move(choice)};
}

/// Returns the steps of `number` seeds by the rates of `choice`.
std::vector<NoiseStep> steps_of(const Subject& subject, int number)
{
    std::vector<Image> with;
    std::vector<Image> even;
    std::vector<Layer> layers;
    for (int seed = 0; seed < number; ++seed) {
        RenderOptions options = subject.choice.options;
        options.sampling.seed = static_cast<std::uint64_t>(seed);
        options.film.aovs = seed == 0 ? AovSet{Aov::albedo, Aov::normal, Aov::object} : AovSet{};
        const RenderResult result = render(subject.scene, subject.camera, options);
        if (seed == 0) {
            layers = result.aovs.develop(result.film);
            for (Layer& ids : result.ids.develop(result.film)) {
                layers.push_back(std::move(ids));
            }
        }
        even.push_back(result.image());
        options.film.aovs = {};
        options.sampling.rates = subject.choice.rates;
        with.push_back(render(subject.scene, subject.camera, options).image());
    }
    return noise_steps(with, even, layers);
}

void check_even(const Subject& subject, int number, double limit)
{
    INFO("without rates there is nothing to see: choose another scene or size");
    REQUIRE(subject.choice.rates != nullptr);
    const std::vector<NoiseStep> steps = steps_of(subject, number);
    REQUIRE(steps.size() >= 50);
    const NoiseStep& worst = steps.front();
    INFO("from (" << worst.first.x0 << ", " << worst.first.y0 << ") to (" << worst.second.x0 << ", "
                  << worst.second.y0 << "): " << worst.ratio << ", standard error "
                  << worst.standard_error << "; " << steps.size() << " steps");
    // A rare bright path may look like a step; a patch makes many.
    const auto surely = std::count_if(steps.begin(), steps.end(),
                                      [&](const NoiseStep& step) { return step.least() > limit; });
    CHECK(static_cast<std::size_t>(surely) <= 1 + steps.size() / 1000);
}

}  // namespace

TEST_CASE("a step of noise is found where it is", "[evenness]")
{
    const std::vector<NoiseStep> steps =
        noise_steps(noise(20, 2.0f), noise(40, 1.0f), one_surface());
    REQUIRE_FALSE(steps.empty());
    CHECK(crosses(steps.front()));
    CHECK(steps.front().least() > visible);
    for (const NoiseStep& step : steps) {
        INFO(step.first.x0 << ", " << step.first.y0 << " to " << step.second.x0 << ", "
                           << step.second.y0);
        const bool whole = step.first.x1 == 16 && step.second.x0 == 16;
        const double expected = whole ? 2.0 : 1.0;
        if (whole || !crosses(step)) {
            // Random numbers of four blocks of 64 pixels and 12 seeds.
            CHECK(step.standard_error < 0.1);
            CHECK(std::abs(std::log(step.ratio / expected)) < 4.0 * step.standard_error);
        }
    }
}

TEST_CASE("noise that even samples have as well is no step", "[evenness]")
{
    const std::vector<Image> images = noise(20, 2.0f);
    const std::vector<NoiseStep> steps = noise_steps(images, images, one_surface());
    REQUIRE_FALSE(steps.empty());
    CHECK(steps.front().ratio == 1.0);
    CHECK(steps.front().standard_error == 0.0);
}

TEST_CASE("only blocks of one surface are compared", "[evenness]")
{
    const float turned = std::sqrt(1.0f - 0.97f * 0.97f);  // 14 degrees
    std::vector<Layer> bent = changed(1, 2, 0.97f);
    for (std::size_t i = 0; i < width * height; ++i) {
        bent[1].values[3 * i] = i % width >= 16 ? turned : 0.0f;
    }
    const std::vector<Image> images = noise(20, 2.0f);
    const auto crossing = [&](const std::vector<Layer>& layers) {
        int count = 0;
        for (const NoiseStep& step : noise_steps(images, images, layers)) {
            count += step.first.x1 == 16 && step.second.x0 == 16 ? 1 : 0;
        }
        return count;
    };
    CHECK(crossing(one_surface()) > 0);
    CHECK(crossing(changed(0, 1, 0.46f)) > 0);  // albedo
    CHECK(crossing(changed(0, 1, 0.44f)) == 0);
    CHECK(crossing(bent) == 0);
    CHECK(crossing(changed(2, 0, 4.0f)) == 0);  // another object
    CHECK(crossing(changed(2, 1, 0.9f)) == 0);  // pixels with a second object
}

TEST_CASE("steps of noise refuse what they cannot compare", "[evenness]")
{
    const std::vector<Image> images = noise(20, 1.0f);
    const std::vector<Image> two(images.begin(), images.begin() + 2);
    CHECK_THROWS_AS(noise_steps(two, two, one_surface()), Error);
    CHECK_THROWS_AS(noise_steps(images, two, one_surface()), Error);
    std::vector<Image> other = images;
    other.back() = flat(width, height + 1, Rgb(1.0f));
    CHECK_THROWS_AS(noise_steps(images, other, one_surface()), Error);
    std::vector<Layer> few = one_surface();
    few.pop_back();
    CHECK_THROWS_WITH(noise_steps(images, images, few), Catch::Contains("CryptoObject00"));
}

TEST_CASE("a patch of half the samples on a wall is a step of noise", "[evenness]")
{
    constexpr int side = 48;
    Subject cornell = subject("cornell-box", side, 16);
    std::vector<std::int8_t> exponents(side * side, 0);
    for (int y = 10; y < 20; ++y) {
        for (int x = 16; x < 32; ++x) {
            exponents[static_cast<std::size_t>(y * side + x)] = -1;
        }
    }
    cornell.choice.rates = std::make_shared<const SampleRates>(side, side, std::move(exponents));
    const std::vector<NoiseStep> steps = steps_of(cornell, 6);
    REQUIRE_FALSE(steps.empty());
    CHECK(steps.front().ratio > visible);
}

namespace {

/// A scene and a size at which `auto` has rates.
struct Case {
    const char* name;
    int side;    // [pixels]
    int number;  // of seeds
    double limit = visible;
};

void check_case(const Case& of, std::int64_t samples)
{
    CAPTURE(of.name);
    check_even(subject(of.name, of.side, samples), of.number, of.limit);
}

}  // namespace

TEST_CASE("rates make no step of noise that an eye sees: boxes and leaves", "[evenness][long]")
{
    const std::int64_t samples = GENERATE(16, 64);
    CAPTURE(samples);
    check_case(GENERATE(Case{"cornell-box", 128, 8}, Case{"alpha", 128, 8}, Case{"motion", 192, 8}),
               samples);
}

TEST_CASE("rates make no step of noise that an eye sees: objects", "[evenness][long]")
{
    const std::int64_t samples = GENERATE(16, 64);
    CAPTURE(samples);
    check_case(GENERATE(Case{"fourteen-specular", 128, 8}, Case{"nine-spheres-dof", 192, 8},
                        Case{"material-layers", 192, 8}),
               samples);
}

TEST_CASE("rates make no step of noise that an eye sees: where points gain most",
          "[evenness][long]")
{
    const std::int64_t samples = GENERATE(16, 64);
    CAPTURE(samples);
    check_case(GENERATE(Case{"shading-normals", 192, 8, visible_with_few},
                        Case{"instances", 192, 8, visible_with_few}),
               samples);
    if (samples == 16) {
        check_case({"instances", 300, 8, visible_with_few}, samples);
    }
}

}  // namespace bdpt::eval::evenness_test
