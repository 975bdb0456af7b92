#include <bdpt/error.h>
#include <bdpt/part/sample_rates.h>
#include <bdpt/render.h>

#include "catch.hpp"
#include "moving_scenes.h"
#include "scene_builder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace bdpt::id_test {
namespace {

constexpr int size = 20;

RenderOptions options(AovSet aovs = {Aov::object, Aov::material, Aov::alpha})
{
    RenderOptions result;
    result.integrator = IntegratorKind::pt;
    result.film.width = size;
    result.film.height = size;
    result.sampling.samples = {.begin = 0, .end = 16};
    result.transport.max_depth = 1;
    result.film.aovs = aovs;
    return result;
}

const CameraDesc camera = test::camera_at({0, 0, 6}, {0, 0, 0}, 0.7f);

Mat4 ball_at(Vec3 center, float radius)
{
    return glm::scale(test::translation(center), Vec3(radius));
}

/// Names the last instance and its material.
void name_last(test::SceneBuilder& builder, const char* object, const char* material)
{
    builder.desc.instances.back().name = object;
    builder.desc.materials.back().name = material;
}

/// A wall, and two balls of one mesh before it: one of them lets half of the rays pass.
test::SceneBuilder wall_and_balls()
{
    test::SceneBuilder builder;
    builder.quad({-4, -1, -1}, {4, -1, -1}, {4, 4, -1}, {-4, 4, -1}, test::lambertian(Rgb(0.5f)));
    name_last(builder, "wall", "paint");
    const MeshId ball = builder.sphere_mesh(16);
    builder.desc.meshes.back().name = "ball mesh";
    builder.place(ball, test::lambertian(Rgb(0.5f)), ball_at({-1.1f, 0, 0}, 0.8f));
    name_last(builder, "left", "paint");
    MaterialDesc gauze = test::lambertian(Rgb(0.5f));
    gauze.alpha_mode = AlphaMode::blend;
    gauze.base_color.w = 0.5f;
    builder.place(ball, gauze, ball_at({1.1f, 0, 0}, 0.8f));
    name_last(builder, "right", "gauze");
    return builder;
}

using Shares = std::map<NameId, float>;

/// Of a pixel, in the layers of one kind.
Shares shares(const std::vector<Layer>& layers, const std::string& name, std::size_t pixel)
{
    Shares result;
    for (const Layer& layer : layers) {
        for (std::size_t c = 0; layer.name.starts_with(name) && c < 4; c += 2) {
            const float share = layer.values[4 * pixel + c + 1];
            if (share > 0.0f) {
                result[std::bit_cast<NameId>(layer.values[4 * pixel + c])] += share;
            }
        }
    }
    return result;
}

float sum_of(const Shares& shares)
{
    float sum = 0.0f;
    for (const auto& [id, share] : shares) {
        sum += share;
    }
    return sum;
}

/// Of the whole image.
std::vector<float> matte(const RenderResult& result, const std::string& layer,
                         const std::string& name)
{
    const std::vector<Layer> layers = result.ids.develop(result.film);
    std::vector<float> values;
    for (std::size_t i = 0; i < result.film.develop().pixels.size(); ++i) {
        const Shares found = shares(layers, layer, i);
        const auto place = found.find(name_id(name));
        values.push_back(place != found.end() ? place->second : 0.0f);
    }
    return values;
}

std::vector<float> alpha(const RenderResult& result)
{
    return result.aovs.develop(result.film).at(0).values;
}

std::size_t max_ids(const RenderResult& result, IdKind kind)
{
    return result.ids.ranks()[static_cast<std::size_t>(kind)];
}

}  // namespace

TEST_CASE("shares of objects and of materials add up to alpha", "[ids]")
{
    test::SceneBuilder builder = wall_and_balls();
    builder.light(PointLightDesc{.name = "lamp", .position = {0, -1.2f, 0.5f}, .radius = 0.3f});
    const RenderResult result = render(Scene(builder.desc), camera, options());
    const std::vector<float> covered = alpha(result);
    const std::vector<Layer> layers = result.ids.develop(result.film);
    std::size_t partial = 0;
    for (std::size_t i = 0; i < covered.size(); ++i) {
        CAPTURE(i);
        // Of 16 samples: exact.
        REQUIRE(sum_of(shares(layers, "CryptoObject", i)) == covered[i]);
        REQUIRE(sum_of(shares(layers, "CryptoMaterial", i)) == covered[i]);
        partial += covered[i] > 0.0f && covered[i] < 1.0f ? 1U : 0U;
    }
    CHECK(partial > 10);
    CHECK(max_ids(result, IdKind::object) >= 2);
}

TEST_CASE("the matte of an object is the alpha of it alone, where nothing hides it", "[ids]")
{
    const test::SceneBuilder builder = wall_and_balls();
    const RenderResult all = render(Scene(builder.desc), camera, options());
    for (const std::size_t instance : {std::size_t{1}, std::size_t{2}}) {
        // Random numbers of surfaces go by the place in the list of instances, so the others stay
        // there, out of sight.
        SceneDesc alone = builder.desc;
        for (std::size_t i = 0; i < alone.instances.size(); ++i) {
            if (i != instance) {
                alone.instances[i].world_from_object =
                    test::translation({0, 0, 100}) * alone.instances[i].world_from_object;
            }
        }
        const std::string name = alone.instances[instance].name;
        CAPTURE(name);
        const std::vector<float> expected = alpha(render(Scene(alone), camera, options()));
        CHECK(matte(all, "CryptoObject", name) == expected);
        CHECK(*std::max_element(expected.begin(), expected.end()) > 0.3f);
    }
    // Instances share a mesh, but not an id; the wall and a ball share a material.
    const std::vector<float> wall = matte(all, "CryptoObject", "wall");
    const std::vector<float> left = matte(all, "CryptoObject", "left");
    const std::vector<float> paint = matte(all, "CryptoMaterial", "paint");
    for (std::size_t i = 0; i < paint.size(); ++i) {
        CHECK(paint[i] == wall[i] + left[i]);
    }
    const std::vector<float> of_mesh = matte(all, "CryptoObject", "ball mesh");
    CHECK(std::count(of_mesh.begin(), of_mesh.end(), 0.0f) == size * size);
}

TEST_CASE("surfaces that move or are out of focus share pixels", "[ids]")
{
    test::SceneBuilder still = wall_and_balls();
    const std::size_t middle = size / 2 * size + size / 2;
    const auto shares_of = [&](const SceneDesc& desc, const CameraDesc& view) {
        const RenderResult result = render(Scene(desc), view, options());
        Shares found = shares(result.ids.develop(result.film), "CryptoObject", middle);
        CHECK(sum_of(found) == alpha(result)[middle]);
        return found;
    };
    CHECK(shares_of(still.desc, camera).size() == 1);  // the wall, between the balls

    test::SceneBuilder moving = wall_and_balls();
    test::move_last(moving, 1, [](float t) { return ball_at({1.1f - 1.5f * t, 0, 1.0f}, 0.8f); });
    const Shares moved = shares_of(moving.desc, camera);
    CHECK(moved.size() >= 2);
    CHECK(moved.contains(name_id("right")));

    CameraDesc lens = camera;
    lens.lens_radius = 0.8f;
    lens.focus_distance = 2.0f;
    CHECK(shares_of(still.desc, lens).size() == 3);
}

TEST_CASE("what has no name is called by its place; lamps by their light", "[ids]")
{
    test::SceneBuilder builder = wall_and_balls();
    builder.desc.instances[1].name.clear();
    builder.desc.materials[2].name.clear();
    builder.light(DirectionalLightDesc{.direction = {0, 0, -1}});
    builder.light(PointLightDesc{.position = {0, -1.2f, 0.5f}, .radius = 0.3f});
    builder.light(PointLightDesc{.name = "point", .position = {0, 3, 0}});
    const RenderResult result = render(Scene(builder.desc), camera, options());
    const std::vector<IdManifest> manifests = result.ids.manifests();
    const auto names_of = [&](std::size_t i) {
        std::vector<std::string> names;
        for (const NamedId& name : manifests.at(i).names) {
            CHECK(name.id == name_id(name.name));
            names.push_back(name.name);
        }
        return names;
    };
    CHECK(names_of(0) == std::vector<std::string>{"instance_1", "light_1", "right", "wall"});
    CHECK(names_of(1) == std::vector<std::string>{"light_1", "material_2", "paint"});
    for (const char* layer : {"CryptoObject", "CryptoMaterial"}) {
        const std::vector<float> lamp = matte(result, layer, "light_1");
        CHECK(std::count(lamp.begin(), lamp.end(), 1.0f) > 0);
    }
}

TEST_CASE("objects of one name are one object", "[ids]")
{
    test::SceneBuilder builder = wall_and_balls();
    builder.desc.instances[2].name = "left";
    const RenderResult result = render(Scene(builder.desc), camera, options());
    const std::vector<float> both = matte(result, "CryptoObject", "left");
    CHECK(both[size / 2 * size + 6] == 1.0f);
    CHECK(both[size / 2 * size + 13] > 0.3f);
    CHECK(result.ids.manifests().at(0).names.size() == 2);
}

TEST_CASE("instances of one name are numbered, whatever other names there are", "[ids]")
{
    test::SceneBuilder builder = wall_and_balls();
    const MeshId ball = builder.desc.instances[1].mesh;
    builder.desc.instances[2].name = "left";
    for (const char* name : {"left.1", "left.1", "left.2", "left", ""}) {  // out of sight
        builder.place(ball, test::lambertian(Rgb(0.5f)), ball_at({0, 0, 100}, 0.8f));
        builder.desc.instances.back().name = name;
    }
    builder.light(PointLightDesc{.name = "left", .position = {0, -1.2f, 0.5f}, .radius = 0.3f});
    const RenderResult result =
        render(Scene(builder.desc), camera, options({Aov::alpha, Aov::object, Aov::instance}));
    const std::vector<IdManifest> manifests = result.ids.manifests();
    std::vector<std::string> names;
    for (const NamedId& name : manifests.at(1).names) {
        names.push_back(name.name);
    }
    CHECK(manifests.at(1).layer == "CryptoInstance");
    CHECK(names == std::vector<std::string>{"instance_7", "left.1.1", "left.1.2", "left.2",
                                            "left.3", "left.4", "left.5", "left.6", "wall"});
    // Together they are the object.
    const std::vector<float> object = matte(result, "CryptoObject", "left");
    const std::vector<float> first = matte(result, "CryptoInstance", "left.3");
    const std::vector<float> second = matte(result, "CryptoInstance", "left.4");
    const std::vector<float> lamp = matte(result, "CryptoInstance", "left.6");
    for (std::size_t i = 0; i < object.size(); ++i) {
        CHECK(object[i] == first[i] + second[i] + lamp[i]);
    }
    CHECK(first[size / 2 * size + 6] == 1.0f);
    CHECK(second[size / 2 * size + 13] > 0.3f);
    CHECK(*std::max_element(lamp.begin(), lamp.end()) == 1.0f);
}

TEST_CASE("masks have the integers of the names that are seen", "[ids]")
{
    const RenderResult result = render(Scene(wall_and_balls().desc), camera,
                                       options({Aov::object, Aov::instance, Aov::material}));
    const auto at = [&](IdKind kind, int x, int y) {
        const std::uint32_t integer =
            result.ids.mask(kind, result.film)[static_cast<std::size_t>(y * size + x)];
        const std::vector<NamedId>& names = result.ids.names()[static_cast<std::size_t>(kind)];
        return integer == 0 ? std::string() : names.at(integer - 1).name;
    };
    for (const IdKind kind : {IdKind::object, IdKind::instance}) {
        CHECK(at(kind, 6, size / 2) == "left");
        CHECK(at(kind, size / 2, size / 2) == "wall");
        CHECK(at(kind, size / 2, size - 1).empty());
    }
    CHECK(at(IdKind::material, 6, size / 2) == "paint");
}

TEST_CASE("counts of ids are the same for any threads, tiles, parts, crops and integrators",
          "[ids]")
{
    const Scene scene(test::moving_stage().desc);
    const CameraDesc view = test::moving(camera);
    RenderOptions o = options({Aov::object, Aov::material});
    o.transport.max_depth = 3;
    const RenderResult whole = render(scene, view, o);
    REQUIRE(max_ids(whole, IdKind::object) >= 2);
    for (const int threads : {1, 2, 5}) {
        RenderOptions other = o;
        other.system.threads = threads;
        other.system.tile_size = 2 + threads;
        other.integrator = threads == 1   ? IntegratorKind::bdpt
                           : threads == 2 ? IntegratorKind::lt
                                          : IntegratorKind::vcm;
        CHECK(render(scene, view, other).ids == whole.ids);
    }
    const auto part = [&](std::int64_t begin, std::int64_t end) {
        RenderOptions other = o;
        other.sampling.samples = {.begin = begin, .end = end};
        return render(scene, view, other);
    };
    RenderResult sum = part(9, 16);
    merge(sum, part(0, 2));
    CHECK_FALSE(sum.ids == whole.ids);
    merge(sum, part(2, 9));
    CHECK(sum.ids == whole.ids);
    CHECK(continue_render(scene, view, o, part(3, 5)).ids == whole.ids);

    RenderOptions cropped = o;
    cropped.film.crop = PixelRect{.x0 = 7, .y0 = 5, .x1 = 15, .y1 = 13};
    const RenderResult crop = render(scene, view, cropped);
    const std::vector<Layer> part_layers = crop.ids.develop(crop.film);
    const std::vector<Layer> layers = whole.ids.develop(whole.film);
    REQUIRE(part_layers.size() == layers.size());
    for (std::size_t i = 0; i < layers.size(); ++i) {
        for (std::size_t y = 0; y < 8; ++y) {
            const auto row =
                layers[i].values.begin() + static_cast<std::ptrdiff_t>(4 * ((y + 5) * size + 7));
            REQUIRE(
                std::equal(row, row + 4 * 8,
                           part_layers[i].values.begin() + static_cast<std::ptrdiff_t>(32 * y)));
        }
    }
}

TEST_CASE("with rates of samples, ids have one sample a round, as all of the first surface",
          "[ids]")
{
    const Scene scene(wall_and_balls().desc);
    const RenderResult even = render(scene, camera, options());
    RenderOptions o = options();
    std::vector<std::int8_t> exponents(size * size, 0);
    for (std::size_t i = 0; i < exponents.size(); i += 2) {
        exponents[i] = static_cast<std::int8_t>(i % 4 == 0 ? 1 : -1);
    }
    o.sampling.rates = std::make_shared<const SampleRates>(size, size, exponents);
    const RenderResult adaptive = render(scene, camera, o);
    CHECK(adaptive.ids == even.ids);
}

TEST_CASE("names are in the identity of a render whose images show them", "[ids]")
{
    const test::SceneBuilder builder = wall_and_balls();
    SceneDesc swapped = builder.desc;
    std::swap(swapped.instances[1].name, swapped.instances[2].name);
    SceneDesc repainted = builder.desc;
    repainted.materials[2].name = "silk";
    const auto differs = [&](const SceneDesc& desc, AovSet aovs) {
        return difference(identity(Scene(builder.desc), camera, options(aovs)),
                          identity(Scene(desc), camera, options(aovs)))
            .value_or("");
    };
    CHECK(differs(builder.desc, {Aov::object, Aov::material}).empty());
    CHECK(differs(swapped, {Aov::object}) == "scene: names of objects");
    CHECK(differs(swapped, {Aov::material}).empty());
    CHECK(differs(repainted, {Aov::material}) == "scene: names of materials");
    CHECK(differs(repainted, {Aov::object}).empty());
    CHECK(differs(repainted, {Aov::alpha}).empty());
    CHECK(differs(swapped, {Aov::instance}) == "scene: names of instances");
    CHECK(differs(repainted, {Aov::instance}).empty());
    // Parts whose names differ do not merge, whatever their pixels have.
    RenderResult part = render(Scene(builder.desc), camera, options());
    RenderOptions later = options();
    later.sampling.samples = {.begin = 16, .end = 17};
    CHECK_THROWS_AS(merge(part, render(Scene(swapped), camera, later)), Error);
}

TEST_CASE("names that are too long for the header of a part are refused", "[ids]")
{
    test::SceneBuilder builder = wall_and_balls();
    builder.desc.instances[0].name = std::string(std::size_t{5} << 20, 'x');
    const Scene scene(builder.desc);
    CHECK_NOTHROW(render(scene, camera, options({Aov::material})));
    try {
        static_cast<void>(render(scene, camera, options({Aov::object})));
        FAIL("rendered");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::invalid_input);
        CHECK(std::string(error.what()).find("5242889 bytes") != std::string::npos);
    }
}

}  // namespace bdpt::id_test
