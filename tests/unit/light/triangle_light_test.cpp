#include "light/triangle_light.h"

#include "catch.hpp"
#include "chi_square.h"
#include "math/rgb.h"
#include "math/warp.h"
#include "scene/world.h"
#include "scene_builder.h"
#include "statistics.h"

#include <array>
#include <cmath>
#include <vector>

namespace bdpt::triangle_light_test {
namespace {

/// Dark but for one bright texel and a dim one.
TexelImage spotted(int size)
{
    TexelImage image{.width = size, .height = size, .bytes = {}};
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const bool bright = x == size / 4 && y == size / 2;
            const bool dim = x == 3 * size / 4 && y == 3 * size / 4;
            const std::uint8_t v = bright ? 255 : dim ? 60 : 0;
            image.bytes.insert(image.bytes.end(), {v, v, v, 255});
        }
    }
    return image;
}

/// One square of 2 x 2 m with the image on it.
SceneDesc screen(TexelImage image)
{
    test::SceneBuilder builder;
    builder.desc.images.push_back(std::move(image));
    MaterialDesc material = test::emitter(Rgb(3.0f, 2.0f, 1.0f));
    material.emission_texture = TextureRef{.image = ImageId{0}};
    builder.quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, material);
    return std::move(builder.desc);
}

const TriangleLight& triangle(const World& world, std::uint32_t id)
{
    return std::get<TriangleLight>(world.lights()[LightId{id}].model());
}

constexpr float area = 2.0f;  // of each triangle

}  // namespace

TEST_CASE("square and triangle are mapped onto each other", "[warp]")
{
    test::Random random(21);
    for (int i = 0; i < 10000; ++i) {
        const Vec2 u = random.next_2d();
        const Vec2 back = triangle_to_square(square_to_triangle(u));
        REQUIRE(std::abs(back.x - u.x) < 1e-6f);
        REQUIRE(std::abs(back.y - u.y) < 1e-6f);
    }
}

TEST_CASE("textured emitter: points have the density that is claimed", "[light]")
{
    const World world(screen(spotted(8)));
    constexpr int steps = 16;
    for (const std::uint32_t id : {0U, 1U}) {
        const TriangleLight& light = triangle(world, id);
        // The density is constant in 12 times 12 cells, so these points sum it up exactly.
        std::vector<double> expected;
        double sum = 0.0;
        for (int i = 0; i < steps * steps; ++i) {
            double mean = 0.0;
            constexpr int inner = 12;
            for (int j = 0; j < inner * inner; ++j) {
                const Vec2 u = (Vec2(i % steps, i / steps) +
                                (Vec2(j % inner, j / inner) + 0.5f) / static_cast<float>(inner)) /
                               static_cast<float>(steps);
                mean += static_cast<double>(
                    light.pdf_position({.barycentrics = square_to_triangle(u)}).value * area);
            }
            expected.push_back(mean / (inner * inner * steps * steps));
            sum += expected.back();
        }
        CHECK(sum == Approx(1.0).epsilon(2e-3));
        test::Random random(22);
        std::vector<double> by_paths(expected.size());
        std::vector<double> by_next_event(expected.size());
        const auto count = [&](std::vector<double>& counts, Vec2 barycentrics) {
            const Vec2 u = triangle_to_square(barycentrics);
            const int x = std::min(static_cast<int>(u.x * steps), steps - 1);
            const int y = std::min(static_cast<int>(u.y * steps), steps - 1);
            counts[static_cast<std::size_t>(y * steps + x)] += 1.0;
        };
        for (int i = 0; i < 200000; ++i) {
            const auto emitted = light.sample_emission(random.next_2d(), random.next_2d(), 0.0f);
            const auto incident = light.sample_incident({.p = {0.1f, 3.0f, 0.2f}}, random.next_2d(),
                                                        EnvironmentSampling::plain, 0.0f);
            REQUIRE(emitted.has_value());
            REQUIRE(incident.has_value());
            REQUIRE(light.pdf_position({.barycentrics = emitted->barycentrics}).value ==
                    emitted->pdf_position.value);
            REQUIRE(light.pdf_position({.barycentrics = incident->barycentrics}).value ==
                    incident->pdf.value);
            count(by_paths, emitted->barycentrics);
            count(by_next_event, incident->barycentrics);
        }
        for (const auto& counts : {by_paths, by_next_event}) {
            const test::ChiSquare result = test::chi_square(counts, expected);
            INFO("triangle " << id << ", chi^2 " << result.statistic << " of " << result.degrees);
            CHECK(result.p_value > 1e-4);
            CHECK(result.min_detectable(1e-4) < 0.05);
        }
    }
}

TEST_CASE("even emitter: next-event estimation has the density that is claimed", "[light]")
{
    test::SceneBuilder builder;
    builder.quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, test::emitter(Rgb(3.0f)));
    const World world(std::move(builder.desc));
    test::Random random(24);
    // Close to it, where it is sampled by solid angle, far away, and in between.
    for (const float height : {0.02f, 0.3f, 2.0f, 9.0f, 30.0f}) {
        const LightSampleContext receiver{.p = {0.4f, height, -0.2f}};
        for (const std::uint32_t id : {0U, 1U}) {
            const TriangleLight& light = triangle(world, id);
            test::Moments by_next_event;
            test::Moments by_area;
            for (int i = 0; i < 20000; ++i) {
                const auto incident = light.sample_incident(receiver, random.next_2d(),
                                                            EnvironmentSampling::plain, 0.0f);
                REQUIRE(incident.has_value());
                const LightPoint x0{.p = incident->end.p,
                                    .ng = incident->end.ng,
                                    .barycentrics = incident->barycentrics};
                const float pdf = light.pdf_incident(receiver, x0).value;
                REQUIRE(incident->pdf.value == Approx(pdf).epsilon(1e-3));
                REQUIRE(incident->weight.r * incident->pdf_solid_angle.value ==
                        Approx(3.0f).epsilon(1e-3));
                by_next_event.add(static_cast<double>(incident->weight.r));
                // The same radiance, from points that light paths would start at.
                const auto emitted =
                    light.sample_emission(random.next_2d(), random.next_2d(), 0.0f);
                REQUIRE(emitted.has_value());
                const Vec3 way = emitted->end.p - receiver.p;
                const float distance2 = dot(way, way);
                by_area.add(static_cast<double>(3.0f * area * std::abs(way.y) /
                                                (distance2 * std::sqrt(distance2))));
            }
            CAPTURE(height, id, by_next_event.mean(), by_area.mean());
            CHECK(std::abs(by_next_event.mean() - by_area.mean()) <
                  4.5 * std::hypot(by_next_event.standard_error(), by_area.standard_error()));
            if (height < 1.0f) {
                // By solid angle all points bring the same radiance.
                CHECK(by_next_event.standard_error() < 1e-4 * by_next_event.mean());
            }
        }
    }
}

TEST_CASE("textured emitter: the flux of light paths is the power, with little variance", "[light]")
{
    const World world(screen(spotted(16)));
    test::Random random(23);
    std::array<test::Moments, 2> flux;
    for (const std::uint32_t id : {0U, 1U}) {
        for (int i = 0; i < 100000; ++i) {
            const auto emitted =
                triangle(world, id).sample_emission(random.next_2d(), random.next_2d(), 0.0f);
            flux[id].add(emitted ? static_cast<double>(luminance(emitted->weight)) : 0.0);
        }
    }
    const double texture = 0.5 * (flux[0].mean() + flux[1].mean());
    for (const std::uint32_t id : {0U, 1U}) {
        const auto power = static_cast<double>(luminance(triangle(world, id).power()));
        INFO("triangle " << id << ": flux " << flux[id].mean() << ", power " << power);
        // A hundredth of the power is the texture's own mean.
        CHECK(power == Approx(0.99 * flux[id].mean() + 0.01 * texture).epsilon(0.015));
        CHECK(flux[id].standard_error() < 0.004 * flux[id].mean());
        // Bright points are drawn as often as they are bright. Even points would have a variance of
        // about a hundred times that.
        CHECK(flux[id].variance() < power * power);
    }
}

TEST_CASE("textured emitter: triangles are chosen by what they really emit", "[light]")
{
    // The image's left half is bright. Four squares show parts of it.
    TexelImage halves{.width = 2, .height = 1, .bytes = {255, 255, 255, 255, 0, 0, 0, 255}};
    test::SceneBuilder builder;
    builder.desc.images.push_back(halves);
    MaterialDesc material = test::emitter(Rgb(1.0f));
    material.emission_texture =
        TextureRef{.image = ImageId{0}, .wrap_u = Wrap::clamp_to_edge, .scale = {0.2f, 1.0f}};
    builder.quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, material);
    material.emission_texture->offset = {0.8f, 0.0f};
    builder.quad({4, 0, 1}, {6, 0, 1}, {6, 0, -1}, {4, 0, -1}, material);
    const World world(std::move(builder.desc));
    const LightSet& lights = world.lights();
    CHECK(lights.emission_probability(LightId{0}) == Approx(0.5f).epsilon(0.02));
    CHECK(lights.emission_probability(LightId{2}) < 0.01f);
    CHECK(lights.emission_probability(LightId{2}) > 0.0f);
}

TEST_CASE("textured emitter: no point has a density of zero", "[light]")
{
    // The spot of the larger image lies between the samples that are taken of it.
    for (const int size : {8, 2000}) {
        const World world(screen(spotted(size)));
        test::Random random(24);
        for (int i = 0; i < 20000; ++i) {
            const Vec2 barycentrics = square_to_triangle(random.next_2d());
            for (const std::uint32_t id : {0U, 1U}) {
                CHECK(world.lights().emission_probability(LightId{id}) > 0.0f);
                REQUIRE(triangle(world, id).pdf_position({.barycentrics = barycentrics}).value *
                            area >
                        0.09f);
            }
        }
    }
}

TEST_CASE("an even texture costs no table", "[light]")
{
    const TexelImage even{.width = 2, .height = 2, .bytes = std::vector<std::uint8_t>(16, 200)};
    const World world(screen(even));
    CHECK(triangle(world, 0).pdf_position({.barycentrics = {0.1f, 0.7f}}).value == 1.0f / area);
}

TEST_CASE("coordinates without bounds do not stop the texture from being measured", "[light]")
{
    SceneDesc desc = screen(spotted(8));
    for (Vec2& uv : desc.meshes[0].uvs[0]) {
        uv *= 1e30f;
    }
    desc.materials[0].emission_texture->scale = Vec2(1e30f);
    const World world(std::move(desc));
    const float pdf = triangle(world, 0).pdf_position({.barycentrics = {0.2f, 0.3f}}).value;
    CHECK(std::isfinite(pdf));
    CHECK(pdf > 0.0f);
}

}  // namespace bdpt::triangle_light_test
