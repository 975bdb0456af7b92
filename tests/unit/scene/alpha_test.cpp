#include "catch.hpp"
#include "math/sampler.h"
#include "scene/world.h"
#include "scene_builder.h"
#include "statistics.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace bdpt::alpha_test {
namespace {

using test::SceneBuilder;

constexpr SegmentEnd above{.p = {0.1f, 0.2f, 20.0f}};
constexpr SegmentEnd below{.p = {0.1f, 0.2f, -20.0f}};
constexpr Vec3 down(0.0f, 0.0f, -1.0f);

MaterialDesc pane(float alpha, AlphaMode mode = AlphaMode::blend)
{
    MaterialDesc material = test::lambertian(Rgb(0.5f));
    material.base_color.w = alpha;
    material.alpha_mode = mode;
    return material;
}

MeshDesc square()
{
    MeshDesc mesh;
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.uvs[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

/// Squares on top of each other, the last one lowest: instances of one mesh, or meshes of their
/// own.
SceneDesc stack(const std::vector<MaterialDesc>& materials, bool shared)
{
    SceneBuilder builder;
    const MeshId first = builder.add_mesh(square());
    float z = 0.0f;
    for (const MaterialDesc& material : materials) {
        const MeshId mesh = shared || z == 0.0f ? first : builder.add_mesh(square());
        builder.place(mesh, material, glm::translate(Mat4(1.0f), Vec3(0.0f, 0.0f, z)));
        z -= 1.0f;
    }
    return std::move(builder.desc);
}

SegmentKey key(int sample, int s = 0, int t = 1)
{
    return Sampler(SamplerKind::sobol, 3, sample % 64, sample / 64, sample).segment_key(s, t);
}

/// Is `count` what one may expect of `samples` trials, five standard deviations apart at most?
void check_share(int count, int samples, double expected)
{
    const double deviation = std::sqrt(samples * expected * (1.0 - expected)) + 0.5;
    CAPTURE(count, samples * expected, deviation);
    CHECK(std::abs(count - samples * expected) <= 5.0 * deviation);
}

/// An image of 4 x 4 texels with the same colour and the given alphas.
TexelImage alpha_image(const std::array<std::uint8_t, 16>& alphas)
{
    TexelImage image{.width = 4, .height = 4, .bytes = {}};
    for (const std::uint8_t alpha : alphas) {
        image.bytes.insert(image.bytes.end(), {200, 200, 200, alpha});
    }
    return image;
}

}  // namespace

TEST_CASE("rays pass a stack of panes by the product of what each lets pass", "[alpha]")
{
    constexpr int samples = 20000;
    const std::vector<float> alphas{0.3f, 0.0f, 0.6f, 0.1f, 0.5f};
    const bool shared = GENERATE(false, true);
    std::vector<MaterialDesc> materials;
    for (const float alpha : alphas) {
        materials.push_back(pane(alpha));
    }
    const World world(stack(materials, shared));
    CHECK(world.has_passable_surfaces());
    CHECK_FALSE(world.has_tinted_surfaces());
    int free = 0;
    std::array<int, 5> stopped{};
    for (int i = 0; i < samples; ++i) {
        const SegmentKey segment = key(i);
        const auto hit = world.intersect(above, down, segment);
        if (hit) {
            ++stopped.at(static_cast<std::size_t>(std::lround(-hit->end.p.z)));
        }
        free += hit ? 0 : 1;
        // What decides is the segment and the surface, not the side.
        REQUIRE(hit.has_value() == world.intersect(below, -down, segment).has_value());
    }
    double arriving = 1.0;
    for (std::size_t i = 0; i < alphas.size(); ++i) {
        check_share(stopped[i], samples, arriving * static_cast<double>(alphas[i]));
        arriving *= 1.0 - static_cast<double>(alphas[i]);
    }
    check_share(free, samples, arriving);
    CHECK(stopped[1] == 0);
    // Shadow rays have the mean.
    const Approx expected = Approx(arriving).epsilon(1e-5);
    CHECK(world.transmittance(above, below, key(0)).x == expected);
    CHECK(world.transmittance(below, above, key(1)).y == expected);
    CHECK(world.transmittance_to_infinity(below, -down, key(2)).z == expected);
    materials.push_back(pane(1.0f));
    const World closed(stack(materials, shared));
    CHECK_FALSE(closed.transmission(above, below, key(0)).has_value());
    CHECK_FALSE(closed.transmission_to_infinity(above, down, key(0)).has_value());
}

TEST_CASE("the segments of a sample decide independently", "[alpha]")
{
    constexpr int samples = 20000;
    const World world(stack({pane(0.5f)}, false));
    const std::vector<std::pair<int, int>> segments{{0, 1}, {0, 2}, {1, 0}, {2, 0}, {1, 1},
                                                    {1, 2}, {2, 1}, {2, 2}, {3, 2}, {2, 3}};
    std::vector<std::vector<bool>> passed(segments.size());
    for (std::size_t k = 0; k < segments.size(); ++k) {
        for (int i = 0; i < samples; ++i) {
            const SegmentKey segment = key(i, segments[k].first, segments[k].second);
            passed[k].push_back(!world.first_hit(above, down, segment).has_value());
        }
    }
    for (std::size_t a = 0; a < segments.size(); ++a) {
        for (std::size_t b = a + 1; b < segments.size(); ++b) {
            int both = 0;
            for (std::size_t i = 0; i < samples; ++i) {
                both += passed[a][i] && passed[b][i] ? 1 : 0;
            }
            CAPTURE(segments[a].first, segments[a].second, segments[b].first, segments[b].second);
            check_share(both, samples, 0.25);
        }
    }
}

TEST_CASE("the numbers of segments are uniform and apart from the sampler's", "[alpha]")
{
    constexpr int samples = 20000;
    std::array<int, 16> bins{};
    int equal = 0;
    for (int i = 0; i < samples; ++i) {
        Sampler sampler(SamplerKind::sobol, 3, i, 0, 0);
        const float number = sampler.segment_key(0, 1).at_surface(0, 0);
        REQUIRE(number >= 0.0f);
        REQUIRE(number < 1.0f);
        ++bins.at(static_cast<std::size_t>(number * 16.0f));
        for (std::uint32_t vertex = 0; vertex < 3; ++vertex) {
            sampler.start(SampleUse::camera_walk, vertex);
            equal += sampler.next_1d() == number ? 1 : 0;
        }
    }
    for (const int bin : bins) {
        check_share(bin, samples, 1.0 / 16.0);
    }
    CHECK(equal <= 3);
}

TEST_CASE("a mask cuts exactly", "[alpha]")
{
    const std::array<std::uint8_t, 16> alphas{0,   255, 128, 127, 1,   254, 100, 200,
                                              129, 126, 50,  60,  255, 0,   255, 0};
    const float cutoff = GENERATE(0.0f, 0.25f, 128.0f / 255.0f, 1.0f, 1.5f);
    const float factor = GENERATE(1.0f, 0.7f);
    MaterialDesc material = pane(factor, AlphaMode::mask);
    material.alpha_cutoff = cutoff;
    material.base_color_texture = TextureRef{
        .image = ImageId{0}, .wrap_u = Wrap::clamp_to_edge, .wrap_v = Wrap::clamp_to_edge};
    SceneDesc desc = stack({material}, false);
    desc.images.push_back(alpha_image(alphas));
    const World world(std::move(desc));
    for (int i = 0; i < 16; ++i) {
        const float x = (static_cast<float>(i % 4) + 0.5f) / 2.0f - 1.0f;
        const float y = 1.0f - (static_cast<float>(i / 4) + 0.5f) / 2.0f;
        const double alpha =
            static_cast<double>(factor) * alphas.at(static_cast<std::size_t>(i)) / 255.0;
        const bool there = alpha > static_cast<double>(cutoff) - 1e-6;
        CAPTURE(i, cutoff, factor);
        for (int sample = 0; sample < 5; ++sample) {
            CHECK(world.intersect({.p = {x, y, 3.0f}}, down, key(sample)).has_value() == there);
            CHECK(world.transmittance({.p = {x, y, 3.0f}}, {.p = {x, y, -3.0f}}, key(sample)) ==
                  Rgb(there ? 0.0f : 1.0f));
        }
    }
}

TEST_CASE("even alpha at the cutoff leaves no speckles", "[alpha]")
{
    std::array<std::uint8_t, 16> alphas{};
    alphas.fill(77);
    MaterialDesc material = pane(1.0f, AlphaMode::mask);
    material.alpha_cutoff = 77.0f / 255.0f;
    material.base_color_texture = TextureRef{.image = ImageId{0}, .scale = {3.3f, 1.7f}};
    SceneDesc desc = stack({material}, false);
    desc.images.push_back(alpha_image(alphas));
    const World world(std::move(desc));
    for (int i = 0; i < 3000; ++i) {
        const float x = std::fmod(static_cast<float>(i) * 0.0137f, 1.98f) - 0.99f;
        const float y = std::fmod(static_cast<float>(i) * 0.0071f, 1.98f) - 0.99f;
        REQUIRE(world.intersect({.p = {x, y, 3.0f}}, down, key(i)).has_value());
    }
}

TEST_CASE("instances of one mesh have the alpha of their own materials", "[alpha]")
{
    // The rays come from the side of each square, which stand next to each other.
    constexpr int samples = 4000;
    SceneBuilder builder;
    const MeshId mesh = builder.add_mesh(square());
    const std::vector<std::pair<MaterialDesc, double>> kinds{
        {pane(0.0f, AlphaMode::opaque), 1.0}, {pane(0.25f), 0.25}, {pane(0.8f), 0.8},
        {pane(0.4f, AlphaMode::mask), 0.0},   {pane(1.0f), 1.0},   {pane(0.0f), 0.0}};
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        builder.place(mesh, kinds[i].first,
                      glm::translate(Mat4(1.0f), Vec3(10.0f * static_cast<float>(i), 0, 0)));
    }
    const World world(std::move(builder.desc));
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        int met = 0;
        const Vec3 p(10.0f * static_cast<float>(i) + 0.1f, 0.2f, 3.0f);
        for (int sample = 0; sample < samples; ++sample) {
            met += world.intersect({.p = p}, down, key(sample)).has_value() ? 1 : 0;
        }
        CAPTURE(i);
        check_share(met, samples, kinds[i].second);
    }
}

TEST_CASE("alpha of factor, texture and vertex colours multiply", "[alpha]")
{
    constexpr int samples = 10000;
    std::array<std::uint8_t, 16> alphas{};
    alphas.fill(153);  // 0.6
    MaterialDesc material = pane(0.9f);
    material.base_color_texture = TextureRef{.image = ImageId{0}};
    SceneBuilder builder;
    MeshDesc mesh = square();
    mesh.colors.assign(4, Vec4(1.0f, 1.0f, 1.0f, 0.5f));
    builder.place(builder.add_mesh(std::move(mesh)), material, Mat4(1.0f));
    builder.desc.images.push_back(alpha_image(alphas));
    const World world(std::move(builder.desc));
    int met = 0;
    for (int i = 0; i < samples; ++i) {
        met += world.intersect(above, down, key(i)).has_value() ? 1 : 0;
    }
    check_share(met, samples, 0.9 * 0.6 * 0.5);
}

TEST_CASE("opaque materials ignore alpha, and invisible ones are no lights", "[alpha]")
{
    MaterialDesc lamp = pane(0.0f, AlphaMode::opaque);
    lamp.emission = Rgb(2.0f);
    const World opaque(stack({lamp}, false));
    CHECK(opaque.lights().size() == 2);
    CHECK(opaque.intersect(above, down, key(0))->emission == Rgb(2.0f));
    lamp.alpha_mode = GENERATE(AlphaMode::blend, AlphaMode::mask);
    const World invisible(stack({lamp}, false));
    CHECK(invisible.lights().size() == 0);
    for (int i = 0; i < 100; ++i) {
        REQUIRE_FALSE(invisible.intersect(above, down, key(i)).has_value());
    }
}

TEST_CASE("what is sampled of a light counts by its opacity", "[alpha]")
{
    const std::array<std::uint8_t, 16> alphas{0,   255, 128, 127, 255, 255, 100, 200,
                                              255, 255, 50,  60,  255, 255, 255, 0};
    const auto mode = GENERATE(AlphaMode::blend, AlphaMode::mask);
    const bool unlit = GENERATE(false, true);
    MaterialDesc lamp = pane(0.8f, mode);
    lamp.emission = Rgb(3.0f);
    lamp.unlit = unlit;
    lamp.base_color_texture = TextureRef{.image = ImageId{0}};
    SceneDesc desc = stack({lamp}, false);
    desc.images.push_back(alpha_image(alphas));
    const World world(std::move(desc));
    const Vec3 receiver = above.p;
    double seen = 0.0;
    double sampled = 0.0;
    double emitted = 0.0;
    double choice = 0.0;
    constexpr int grid = 100;
    constexpr double cells = grid * grid;
    for (std::uint32_t id = 0; id < 2; ++id) {
        choice += static_cast<double>(world.lights().emission_probability(LightId{id}));
        const Light& light = world.lights()[LightId{id}];
        for (int i = 0; i < grid * grid; ++i) {
            const Vec2 u = (Vec2(i % grid, i / grid) + 0.5f) / static_cast<float>(grid);
            if (const auto sample =
                    light.sample_incident({.p = receiver}, u, EnvironmentSampling::plain, 0.0f)) {
                sampled += static_cast<double>(sample->weight.g) / cells;
            }
            if (const auto sample = light.sample_emission(u, {0.3f, 0.6f}, 0.0f)) {
                emitted += static_cast<double>(sample->weight.g) / cells;
            }
        }
    }
    CHECK(choice == Approx(1.0));
    // The same integrals by rays that are stopped by chance.
    double flux = 0.0;
    constexpr int rays = 200000;
    test::Random random(9);
    for (int i = 0; i < rays; ++i) {
        const Vec2 at = 2.0f * random.next_2d() - 1.0f;
        const Vec3 way = Vec3(at, 0.0f) - receiver;
        const auto hit = world.intersect({.p = receiver}, normalize(way), key(i));
        if (!hit) {
            continue;
        }
        const auto distance_squared = static_cast<double>(dot(way, way));
        const double cosine = static_cast<double>(-normalize(way).z);
        const auto radiance = static_cast<double>(hit->emission.g);
        seen += radiance * cosine / distance_squared * 4.0 / rays;
        flux += radiance * 4.0 * 3.14159265 / rays;
    }
    CHECK(sampled == Approx(seen).epsilon(0.02));
    CHECK(emitted == Approx(flux).epsilon(0.02));
}

TEST_CASE("unlit surfaces shine with their base colour and scatter nothing", "[alpha]")
{
    MaterialDesc label = test::plastic({0.25f, 0.5f, 1.0f}, 0.2f);
    label.unlit = true;
    label.emission = Rgb(7.0f);  // for those who do not know unlit materials
    label.transmission = 1.0f;
    label.thickness = 1.0f;
    label.attenuation_color = Rgb(0.5f);
    label.attenuation_distance = 0.1f;
    const bool double_sided = GENERATE(false, true);
    label.double_sided = double_sided;
    SceneBuilder builder;
    MeshDesc mesh = square();
    mesh.colors.assign(4, Vec4(0.5f, 3.0f, 1.0f, 0.5f));  // alpha is ignored: it is opaque
    builder.place(builder.add_mesh(std::move(mesh)), label, Mat4(1.0f));
    const World world(std::move(builder.desc));
    const auto front = world.intersect(above, down, key(0));
    const auto back = world.intersect(below, -down, key(0));
    REQUIRE(front.has_value());
    REQUIRE(back.has_value());
    CHECK(front->emission == Rgb(0.125f, 1.0f, 1.0f));
    CHECK(back->emission == (double_sided ? front->emission : Rgb(0.0f)));
    CHECK(front->light.has_value());
    CHECK(front->end.media.are_clear());
    CHECK_FALSE(front->bsdf.connectible());
    CHECK_FALSE(front->bsdf.sample(0.3f, {0.2f, 0.7f}, TransportMode::radiance));
    CHECK(front->bsdf.eval(-down, TransportMode::importance).f_cos == Rgb(0.0f));
    CHECK(front->bsdf.base_color() == front->emission);
    const float power = world.lights()[LightId{0}].power().g;
    CHECK(power == Approx(3.14159265f * 2.0f * (double_sided ? 2.0f : 1.0f)).epsilon(0.02));
}

TEST_CASE("rays pass clear sheets by what these do not reflect, and are tinted", "[alpha]")
{
    constexpr int samples = 20000;
    const Rgb tint(0.9f, 0.5f, 0.1f);
    const bool shared = GENERATE(false, true);
    const float slope = GENERATE(0.0f, 1.7f);
    MaterialDesc sheet = test::thin_glass(0.0f);
    sheet.base_color = Vec4(tint, 1.0f);
    const World world(stack({sheet, sheet}, shared));
    CHECK(world.has_tinted_surfaces());
    const Vec3 direction = normalize(Vec3(slope, 0.0f, -1.0f));
    const Vec3 middle(0.1f, 0.2f, -0.5f);
    const Vec3 half_way = (-0.7f / direction.z) * direction;
    const SegmentEnd high{.p = middle - half_way};
    const SegmentEnd low{.p = middle + half_way};
    const double cosine = static_cast<double>(-direction.z);
    const auto ior = static_cast<double>(sheet.ior);
    const double inner = std::sqrt(ior * ior - 1.0 + cosine * cosine);
    const double s = (cosine - inner) / (cosine + inner);
    const double p = (ior * ior * cosine - inner) / (ior * ior * cosine + inner);
    const double passes = 1.0 - 0.5 * (s * s + p * p);
    const Rgb through = tint * tint * static_cast<float>(passes * passes);
    for (const Rgb between :
         {world.transmittance(high, low, key(0)), world.transmittance(low, high, key(1)),
          world.transmittance_to_infinity(high, direction, key(2))}) {
        for (int c = 0; c < 3; ++c) {
            CHECK(between[c] == Approx(through[c]).epsilon(1e-3));
        }
    }
    int free = 0;
    int mirrored = 0;
    for (int i = 0; i < samples; ++i) {
        const SegmentKey segment = key(i);
        bool is_tinted = false;
        const bool is_hit = world.first_hit(high, direction, segment, &is_tinted).has_value();
        const auto hit = world.intersect(high, direction, segment);
        REQUIRE(is_hit == hit.has_value());
        // A ray may meet the lower sheet before the upper one stops it.
        const bool upper = hit && hit->end.p.z > -0.5f;
        REQUIRE((is_tinted || upper));
        const float reach = hit ? glm::distance(hit->end.p, high.p) : 100.0f;
        REQUIRE(world.tint(high, direction, reach, segment,
                           world.first_hit(high, direction, segment)) == (!hit    ? tint * tint
                                                                          : upper ? Rgb(1.0f)
                                                                                  : tint));
        free += hit ? 0 : 1;
        if (hit && hit->end.p.z > -0.5f) {
            ++mirrored;
            const auto sample = hit->bsdf.sample(0.5f, Vec2(0.5f), TransportMode::radiance);
            REQUIRE(sample);
            REQUIRE(dot(sample->wi, Vec3(direction.x, 0.0f, -direction.z)) == Approx(1.0f));
        }
    }
    check_share(free, samples, passes * passes);
    check_share(mirrored, samples, 1.0 - passes);
}

TEST_CASE("vertex colours tint what passes a clear sheet", "[alpha]")
{
    SceneBuilder builder;
    MeshDesc mesh = square();
    mesh.colors.assign(4, Vec4(1.0f, 0.25f, 2.0f, 0.5f));
    builder.place(builder.add_mesh(std::move(mesh)), test::thin_glass(0.0f), Mat4(1.0f));
    const World world(std::move(builder.desc));
    CHECK(world.has_tinted_surfaces());
    const Rgb between = world.transmittance(above, below, key(0));
    CHECK(between.x == Approx(0.96f).epsilon(1e-3));
    CHECK(between.y == Approx(0.24f).epsilon(1e-3));
    CHECK(between.z == Approx(0.96f).epsilon(1e-3));
    CHECK_FALSE(World(stack({test::thin_glass(0.0f)}, false)).has_tinted_surfaces());
}

TEST_CASE("a texture tints what passes a clear sheet, where it passes", "[alpha]")
{
    // Texels from the top left; the square spans [-1, 1] and v points down.
    MaterialDesc stained = test::thin_glass(0.0f);
    stained.specular = 0.0f;  // reflects nothing
    stained.base_color_texture = TextureRef{
        .image = ImageId{0}, .wrap_u = Wrap::clamp_to_edge, .wrap_v = Wrap::clamp_to_edge};
    SceneDesc desc = stack({stained}, GENERATE(false, true));
    desc.images.push_back(
        {.width = 2,
         .height = 2,
         .bytes = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 0, 0, 0, 255}});
    const World world(std::move(desc));
    const std::array<Rgb, 4> colors{Rgb(1, 0, 0), Rgb(0, 1, 0), Rgb(0, 0, 1), Rgb(0)};
    for (std::size_t i = 0; i < 4; ++i) {
        CAPTURE(i);
        const Vec3 p(i % 2 == 0 ? -0.9f : 0.9f, i < 2 ? 0.9f : -0.9f, 3.0f);
        const SegmentEnd from{.p = p};
        const Rgb shadow = world.transmittance_to_infinity(from, down, key(0));
        const Rgb walk = world.tint(from, down, 100.0f, key(0));
        for (int c = 0; c < 3; ++c) {
            CHECK(shadow[c] == Approx(colors.at(i)[c]).margin(1e-5));
            CHECK(walk[c] == Approx(colors.at(i)[c]).margin(1e-5));
        }
    }
}

TEST_CASE("each of many tinted sheets counts once", "[alpha]")
{
    const int count = GENERATE(20, 60);
    MaterialDesc sheet = test::thin_glass(0.0f);
    sheet.base_color = {0.9f, 1.0f, 1.0f, 1.0f};
    sheet.specular = 0.0f;  // reflects nothing
    SceneBuilder builder;
    for (int i = 0; i < count; ++i) {
        const float z = 0.01f * static_cast<float>(i);
        builder.quad({-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}, sheet);
    }
    const World world(std::move(builder.desc));
    const auto expected = static_cast<float>(std::pow(0.9, count));
    CHECK(world.transmittance(above, below, key(0)).x == Approx(expected).epsilon(1e-4));
    CHECK(world.transmittance_to_infinity(below, -down, key(1)).x ==
          Approx(expected).epsilon(1e-4));
    CHECK(world.tint(above, down, 100.0f, key(2)).x == Approx(expected).epsilon(1e-4));
    CHECK(world.tint(above, down, 100.0f, key(2)).y == Approx(1.0f).epsilon(1e-5));
    // Camera rays without chance hit even these.
    CHECK(world.first_hit(above, down, key(0).without_chance()).has_value());
}

}  // namespace bdpt::alpha_test
