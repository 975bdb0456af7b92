#include <bdpt/default_lights.h>
#include <bdpt/error.h>
#include <bdpt/framing.h>
#include <bdpt/render.h>
#include <bdpt/scene.h>

#include "catch.hpp"
#include "ground_views.h"
#include "scene/world.h"
#include "scene_builder.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

namespace bdpt::test::scene_edit_test {
namespace {

/// `edit` gets the values of a list, which then has the new ones.
template <typename T, typename Edit>
void change(SharedList<T>& list, const Edit& edit)
{
    std::vector<T> values = list;
    edit(values);
    list = std::move(values);
}

MaterialDesc& named(std::vector<MaterialDesc>& materials, const std::string& name)
{
    for (MaterialDesc& material : materials) {
        if (material.name == name) {
            return material;
        }
    }
    throw std::logic_error("no material " + name);
}

template <typename Edit>
std::function<void(SharedSceneDesc&)> of_material(const std::string& name, const Edit& edit)
{
    return [=](SharedSceneDesc& desc) {
        change(desc.materials, [&](auto& materials) { edit(named(materials, name)); });
    };
}

template <typename Edit>
std::function<void(SharedSceneDesc&)> of_instances(const Edit& edit)
{
    return [=](SharedSceneDesc& desc) { change(desc.instances, edit); };
}

template <typename Edit>
std::function<void(SharedSceneDesc&)> of_lights(const Edit& edit)
{
    return [=](SharedSceneDesc& desc) { change(desc.lights, edit); };
}

template <typename Kind>
Kind& first(std::vector<LightDesc>& lights)
{
    for (LightDesc& light : lights) {
        if (auto* found = std::get_if<Kind>(&light)) {
            return *found;
        }
    }
    throw std::logic_error("no such light");
}

MaterialDesc called(const char* name, MaterialDesc material)
{
    material.name = name;
    return material;
}

TexelImage checks(int width, std::uint8_t low)
{
    TexelImage image;
    image.width = width;
    image.height = width;
    image.channels = 4;
    image.type = TexelType::unorm8;
    for (int i = 0; i < width * width; ++i) {
        const auto value = static_cast<std::uint8_t>((i + i / width) % 2 == 0 ? low : 255);
        for (const std::uint8_t channel : {value, low, value, value}) {
            image.bytes.push_back(channel);
        }
    }
    return image;
}

/// Something of each kind, so that edits of one have others to spoil.
SceneDesc all_kinds()
{
    SceneBuilder builder;
    MaterialDesc walls = called("walls", plastic(Rgb(0.6f), 0.3f));
    walls.base_color_texture = TextureRef{.image = ImageId{0}};
    builder.walls(called("floor", lambertian(Rgb(0.7f))), walls);
    for (std::size_t i = 0; i < builder.desc.materials.size(); ++i) {
        builder.desc.materials[i].name += i > 1 ? std::to_string(i) : "";
    }
    builder.lamp(0.9f, 0.4f, Rgb(5.0f));
    builder.desc.materials.back().name = "lamp";
    // Glass in glass: materials that are what is around them, too.
    builder.sphere({0.4f, -0.6f, 0.4f}, 0.35f, called("glass", glass(0.0f)), 12);
    MaterialDesc inner = called("inner glass", glass(0.1f));
    inner.ior = 1.2f;
    builder.sphere({0.4f, -0.6f, 0.4f}, 0.2f, inner, 12);
    MaterialDesc varnished = called("varnished", plastic({0.7f, 0.2f, 0.1f}, 0.5f));
    varnished.clearcoat.factor = 0.8f;
    builder.cube({-0.5f, -0.8f, 0.3f}, 0.2f, varnished);
    // A mesh with a tree of its own.
    const MeshId ball = builder.sphere_mesh(12);
    for (const float x : {-0.6f, 0.1f}) {
        builder.place(ball, called("ball", metal(Rgb(0.8f), 0.2f)),
                      glm::scale(glm::translate(Mat4(1.0f), {x, 0.2f, -0.4f}), Vec3(0.2f)));
        builder.desc.materials.back().name += x < 0.0f ? " left" : " right";
        builder.desc.instances.back().name = x < 0.0f ? "left" : "right";
    }
    builder.desc.instances.front().name = "floor";
    builder.light(PointLightDesc{
        .name = "bulb", .position = {-0.5f, 0.4f, 0.5f}, .intensity = Rgb(0.3f), .radius = 0.05f});
    builder.light(sunny_sky());
    builder.desc.images = {checks(16, 90), checks(8, 10)};
    return std::move(builder.desc);
}

struct NamedEdit {
    const char* name;
    std::function<void(SharedSceneDesc&)> edit;
    /// No triangle or sphere moves, and as many meshes let rays pass.
    bool geometry_stays = true;
};

std::vector<NamedEdit> edits()
{
    return {
        {"nothing", [](SharedSceneDesc&) {}},
        {"colour", of_material("floor",
                               [](auto& m) {
                                   m.base_color = {0.9f, 0.1f, 0.2f, 1.0f};
                               })},
        {"index of refraction", of_material("glass", [](auto& m) { m.ior = 1.7f; })},
        {"name", of_material("walls3", [](auto& m) { m.name = "back"; })},
        {"texture on",
         of_material("ball left",
                     [](auto& m) { m.base_color_texture = TextureRef{.image = ImageId{1}}; })},
        {"texture of another image",
         of_material("walls", [](auto& m) { m.base_color_texture->image = ImageId{1}; })},
        {"texture off", of_material("walls", [](auto& m) { m.base_color_texture.reset(); })},
        {"texels",
         [](SharedSceneDesc& d) {
             change(d.images, [](auto& images) { images[0] = checks(4, 0); });
         }},
        {"emission of a lamp", of_material("lamp", [](auto& m) { m.emission = Rgb(7.0f); })},
        {"emission off", of_material("lamp", [](auto& m) { m.emission = Rgb(0.0f); })},
        {"colour of a lamp", of_material("lamp", [](auto& m) { m.base_color.x = 0.1f; })},
        {"emission on", of_material("ball right", [](auto& m) { m.emission = Rgb(2.0f); })},
        {"unlit", of_material("varnished", [](auto& m) { m.unlit = true; })},
        {"alpha on",
         of_material("ball left",
                     [](auto& m) {
                         m.alpha_mode = AlphaMode::blend;
                         m.base_color.w = 0.5f;
                     }),
         false},
        {"alpha changes", of_material("ball left", [](auto& m) { m.base_color.w = 0.3f; })},
        {"alpha of the other one", of_material("ball right",
                                               [](auto& m) {
                                                   m.alpha_mode = AlphaMode::mask;
                                                   m.base_color_texture =
                                                       TextureRef{.image = ImageId{1}};
                                               })},
        {"alpha off",
         [](SharedSceneDesc& d) {
             for (const char* name : {"ball left", "ball right"}) {
                 of_material(name, [](auto& m) { m.alpha_mode = AlphaMode::opaque; })(d);
             }
         },
         false},
        {"absorption", of_material("glass",
                                   [](auto& m) {
                                       m.attenuation_distance = 0.2f;
                                       m.attenuation_color = {0.9f, 0.3f, 0.5f};
                                   })},
        {"scattering within", of_material("inner glass",
                                          [](auto& m) {
                                              m.attenuation_distance = 0.1f;
                                              m.attenuation_color = Rgb(0.5f);
                                              m.volume_scatter.color = Rgb(0.8f);
                                          })},
        {"glass to metal", of_material("glass", [](auto& m) { m.transmission = 0.0f; })},
        {"metal to glass", of_material("glass", [](auto& m) { m.transmission = 1.0f; })},
        {"dispersion", of_material("glass", [](auto& m) { m.dispersion = 5.0f; })},
        {"coat off", of_material("varnished", [](auto& m) { m.clearcoat.factor = 0.0f; })},
        {"cloth", of_material("varnished",
                              [](auto& m) {
                                  m.unlit = false;
                                  m.sheen.color = Rgb(0.5f);
                              })},
        {"coat on cloth", of_material("varnished", [](auto& m) { m.clearcoat.factor = 1.0f; })},
        {"fog",
         [](SharedSceneDesc& d) {
             d.fog = MediumDesc{.extinction = Rgb(0.3f), .albedo = Rgb(0.6f)};
         }},
        {"fog off", [](SharedSceneDesc& d) { d.fog.reset(); }},
        {"another material",
         // A ball's material on the floor moves faces, as the cube stands on it.
         of_instances([](auto& list) { std::swap(list[0].material, list.back().material); }),
         false},
        {"instance of a shared mesh moved",
         of_instances([](auto& list) { list.back().world_from_object[3].y -= 0.3f; }), false},
        {"instance of its own mesh moved",
         of_instances([](auto& list) { list[4].world_from_object[3].x += 0.1f; }), false},
        {"instance in motion", of_instances([](auto& list) {
             Mat4 later = list.back().world_from_object;
             later[3].x += 0.2f;
             list.back().motion = {later};
         }),
         false},
        {"instance away", of_instances([](auto& list) { list.pop_back(); }), false},
        {"instance more", of_instances([](auto& list) {
             InstanceDesc more = list.back();
             more.world_from_object[3].z += 0.5f;
             list.push_back(more);
         }),
         false},
        {"mesh changed",
         [](SharedSceneDesc& d) {
             change(d.meshes, [](auto& meshes) { meshes[0].positions[0].y += 0.1f; });
         },
         false},
        {"intensity", of_lights([](auto& list) {
             first<PointLightDesc>(list).intensity = {1.0f, 0.5f, 0.2f};
         })},
        {"lamp moved", of_lights([](auto& list) { first<PointLightDesc>(list).position.x = 0.3f; }),
         false},
        {"lamp without extent",
         of_lights([](auto& list) { first<PointLightDesc>(list).radius = 0.0f; }), false},
        {"environment turned", of_lights([](auto& list) {
             auto& environment = first<EnvironmentLightDesc>(list);
             environment = turned(environment, 1.0f);
         })},
        {"environment replaced", of_lights([](auto& list) {
             first<EnvironmentLightDesc>(list).radiance =
                 Image{.width = 1, .height = 1, .pixels = {Rgb(0.2f, 0.4f, 0.9f)}};
         })},
        {"environment off", of_lights([](auto& list) {
             std::erase_if(list, [](const LightDesc& light) {
                 return std::holds_alternative<EnvironmentLightDesc>(light);
             });
         })},
        {"profile",
         [](SharedSceneDesc& d) {
             d.profiles = std::vector<LightProfile>{
                 {.polar_angles = {0.0f, 1.0f}, .azimuths = {0.0f}, .intensities = {2.0f, 1.0f}}};
             change(d.lights, [](auto& list) {
                 list.emplace_back(ProfileLightDesc{.position = {0.0f, 0.8f, 0.3f}});
             });
         }},
        {"profile changed",
         [](SharedSceneDesc& d) {
             change(d.profiles, [](auto& list) { list.at(0).intensities[0] = 5.0f; });
         }},
        {"origin", [](SharedSceneDesc& d) { d.origin.x = 448000.0; }},
        {"mip maps", [](SharedSceneDesc& d) { d.texture_filter = TextureFilter::mip_mapped; }},
        {"colour with mip maps", of_material("floor", [](auto& m) { m.base_color.x = 0.3f; })},
        {"smoke",
         [](SharedSceneDesc& d) {
             VolumeDesc smoke;
             smoke.size = {2, 2, 2};
             smoke.density.assign(8, 1.0f);
             smoke.world_from_grid = glm::scale(Mat4(1.0f), Vec3(0.3f));
             d.volumes = std::vector<VolumeDesc>{smoke};
         },
         false},
        {"colour beside smoke", of_material("floor", [](auto& m) { m.base_color.y = 0.3f; })},
    };
}

RenderResult rendered(const Scene& scene, IntegratorKind integrator)
{
    RenderOptions options;
    options.integrator = integrator;
    options.film.width = 20;
    options.film.height = 20;
    options.film.aovs = {Aov::depth, Aov::albedo};
    options.sampling.samples = {0, 2};
    options.transport.max_depth = 6;
    return render(scene, room_camera(), options);
}

void check_same(const Scene& scene, const Scene& built)
{
    CHECK(scene.identity() == built.identity());
    CHECK(scene.warnings() == built.warnings());
    CHECK(scene.bounds().min == built.bounds().min);
    CHECK(scene.bounds().max == built.bounds().max);
    const SceneCounts a = scene.counts();
    const SceneCounts b = built.counts();
    CHECK(a.triangles == b.triangles);
    CHECK(a.instanced_triangles == b.instanced_triangles);
    CHECK(a.degenerate_triangles == b.degenerate_triangles);
    CHECK(a.emissive_triangles == b.emissive_triangles);
    CHECK(a.lights == b.lights);
    for (const IntegratorKind integrator : {IntegratorKind::mis, IntegratorKind::bdpt}) {
        const RenderResult one = rendered(scene, integrator);
        const RenderResult other = rendered(built, integrator);
        CHECK(one.identity == other.identity);
        CHECK(one.film.develop().pixels == other.film.develop().pixels);
        CHECK(one.aovs.develop(one.film).at(1).values ==
              other.aovs.develop(other.film).at(1).values);
        CHECK(one.stats.rays.shadow == other.stats.rays.shadow);
    }
}

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

std::string message_of(const std::function<void()>& call)
{
    try {
        call();
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::invalid_input);
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("an edited scene has the bits of one that is built from its description", "[edit]")
{
    const Scene scene(all_kinds());
    const RenderResult before = rendered(scene, IntegratorKind::bdpt);
    for (const NamedEdit& edit : edits()) {
        CAPTURE(edit.name);
        SharedSceneDesc desc = scene.description();
        try {
            edit.edit(desc);
        } catch (const std::logic_error&) {
            continue;  // it needs others before it
        }
        Scene edited = scene.edited(desc);
        check_same(edited, Scene(desc.copy()));
    }
    const RenderResult after = rendered(scene, IntegratorKind::bdpt);
    CHECK(before.film.develop().pixels == after.film.develop().pixels);
    CHECK(before.identity == after.identity);
}

TEST_CASE("a copy of a scene shares all of it", "[edit]")
{
    std::optional<Scene> scene(all_kinds());
    const Scene copy = *scene;
    CHECK(&copy.world() == &scene->world());
    scene.reset();
    CHECK(copy.counts().triangles > 0);
}

TEST_CASE("edits of edited scenes have their bits, too, when the scenes before are gone",
          "[edit][long]")
{
    Scene scene(all_kinds());
    const RenderResult first_part = rendered(scene, IntegratorKind::bdpt);
    const SharedSceneDesc first_desc = scene.description();
    for (const NamedEdit& edit : edits()) {
        CAPTURE(edit.name);
        SharedSceneDesc desc = scene.description();
        edit.edit(desc);
        const SceneGeometry* geometry = &scene.world().geometry();
        Scene next = scene.edited(desc);
        CHECK((&next.world().geometry() == geometry) == edit.geometry_stays);
        scene = std::move(next);
        check_same(scene, Scene(desc.copy()));
    }
    scene = scene.edited(first_desc);
    const RenderResult again = rendered(scene, IntegratorKind::bdpt);
    CHECK(first_part.film.develop().pixels == again.film.develop().pixels);
    CHECK(first_part.identity == again.identity);
}

TEST_CASE("edits of bodies that touch have the bits of new scenes", "[edit][contacts]")
{
    SceneBuilder builder;
    const MaterialDesc grey = lambertian(Rgb(0.7f));
    builder.walls(grey, grey).lamp(0.9f, 0.4f, Rgb(5.0f));
    const auto box = [&](const char* name, float bottom, float ior) {
        MaterialDesc material = called(name, glass(0.0f));
        material.ior = ior;
        builder.place(
            builder.add_mesh(box_mesh({-0.5f, bottom, -0.3f}, {0.5f, bottom + 0.6f, 0.3f})),
            material, Mat4(1.0f));
        builder.desc.instances.back().name = name;
    };
    box("lower", -0.8f, 1.5f);
    box("upper", -0.2f, 1.33f);
    Scene scene(builder.desc);
    REQUIRE(scene.counts().bonds == 1);
    const auto contacts = [](ContactKind kind) {
        return [kind](SharedSceneDesc& desc) { desc.contacts = kind; };
    };
    const auto raise_upper = [](float by) {
        return of_instances([by](auto& list) { list.back().world_from_object[3].y += by; });
    };
    struct Step {
        const char* name;
        std::function<void(SharedSceneDesc&)> edit;
        std::size_t bonds;
    };
    const std::vector<Step> steps{
        {"another index", of_material("upper", [](auto& m) { m.ior = 1.8f; }), 1},
        {"absorption",
         of_material("upper",
                     [](auto& m) {
                         m.attenuation_distance = 0.3f;
                         m.attenuation_color = {0.9f, 0.3f, 0.5f};
                     }),
         1},
        {"air", contacts(ContactKind::air), 0},
        {"another index in air", of_material("upper", [](auto& m) { m.ior = 1.4f; }), 0},
        {"bonded", contacts(ContactKind::bonded), 1},
        {"one index, bonded", of_material("upper", [](auto& m) { m.ior = 1.5f; }), 1},
        {"one index, automatic", contacts(ContactKind::automatic), 0},
        {"metal", of_material("upper", [](auto& m) { m.transmission = 0.0f; }), 0},
        {"glass",
         of_material("upper",
                     [](auto& m) {
                         m.transmission = 1.0f;
                         m.ior = 1.2f;
                     }),
         1},
        {"apart", raise_upper(0.05f), 0},
        {"together", raise_upper(-0.05f), 1}};
    for (const Step& step : steps) {
        CAPTURE(step.name);
        SharedSceneDesc desc = scene.description();
        step.edit(desc);
        scene = scene.edited(desc);
        CHECK(scene.counts().bonds == step.bonds);
        check_same(scene, Scene(desc.copy()));
    }
}

TEST_CASE("the tree of a mesh stays when its instances move, and when others let rays pass",
          "[edit]")
{
    const Scene scene(all_kinds());
    const std::size_t ball = scene.description().meshes.size() - 1;
    const auto tree = [ball](const Scene& of) { return of.world().geometry().trees->tree(ball); };
    REQUIRE(tree(scene) != nullptr);
    InstanceDesc left = scene.description().instances[scene.description().instances.size() - 2];
    REQUIRE(left.name == "left");
    left.world_from_object[3].y += 0.1f;
    const Scene moved = scene.with("left", left);
    CHECK(tree(moved) == tree(scene));
    CHECK(&moved.world().geometry() != &scene.world().geometry());

    MaterialDesc pane = scene.description().materials[0];
    pane.alpha_mode = AlphaMode::blend;
    pane.base_color.w = 0.5f;
    CHECK(tree(scene.with("floor", pane)) == tree(scene));
    pane.name = "ball left";
    CHECK(tree(scene.with("ball left", pane)) != tree(scene));
    CHECK(tree(scene.with("ball left", called("ball left", thin_glass(0.0f)))) != tree(scene));
}

TEST_CASE("one material, instance or environment is replaced by a call", "[edit]")
{
    const Scene scene(all_kinds());
    const MaterialDesc red = called("floor", lambertian({0.9f, 0.1f, 0.1f}));
    const Scene by_name = scene.with("floor", red);
    CHECK(by_name.description().materials[0].base_color == red.base_color);
    CHECK(by_name.identity() == scene.with(MaterialId{0}, red).identity());
    CHECK(by_name.identity() != scene.identity());
    CHECK(by_name.description().meshes.is_shared_with(scene.description().meshes));

    const EnvironmentLightDesc sky = turned(default_environment(), 2.0f);
    const Scene with_sky = scene.with_environment(sky);
    CHECK(with_sky.description().lights.size() == 2);
    CHECK(std::get<EnvironmentLightDesc>(with_sky.description().lights[1]).world_from_environment ==
          sky.world_from_environment);
    const Scene without = with_sky.with_environment(std::nullopt);
    CHECK(without.description().lights.size() == 1);
    CHECK(without.with_environment(std::nullopt).description().lights.size() == 1);
    CHECK(without.with_environment(sky).identity() == with_sky.identity());
    CHECK(scene.with_lights({}).counts().lights == scene.counts().emissive_triangles);
}

TEST_CASE("edits that no scene can have are refused as when it is built", "[edit]")
{
    const Scene scene(all_kinds());
    const RenderResult before = rendered(scene, IntegratorKind::mis);
    const std::vector<std::pair<std::function<void(SharedSceneDesc&)>, std::string>> cases{
        {of_material("floor", [](auto& m) { m.base_color.x = 2.0f; }),
         "material 0 \"floor\": base colour is 2, not in [0, 1]"},
        {of_material("lamp", [](auto& m) { m.emission.x = 1e38f; }), "instance 4: triangle 0"},
        {of_material("floor",
                     [](auto& m) { m.base_color_texture = TextureRef{.image = ImageId{9}}; }),
         "material 0 \"floor\": image 9, but the number of images is 2"},
        {[](SharedSceneDesc& d) { change(d.materials, [](auto& list) { list.pop_back(); }); },
         "instance 9 \"right\": material 9, but the number of materials is 9"},
        {of_instances([](auto& list) { list[0].world_from_object = Mat4(0.0f); }),
         "instance 0 \"floor\": transform has no inverse"},
        {of_instances([](auto& list) { list[0].world_from_object[3].x = 1e20f; }),
         "instance 0 \"floor\": reaches 1e+20"},
        {of_instances([](auto& list) { list[0].motion = {Mat4(nan)}; }),
         "instance 0 \"floor\": motion, step 0: transform is not finite"},
        {of_instances([](auto& list) { list[0].mesh = MeshId{99}; }),
         "instance 0 \"floor\": mesh 99"},
        {of_lights([](auto& list) { first<PointLightDesc>(list).intensity.x = nan; }),
         "point light 0 \"bulb\": intensity is nan"},
        {of_lights([](auto& list) { first<PointLightDesc>(list).motion = {Vec3(nan)}; }),
         "point light 0 \"bulb\": motion, step 0: position is not finite"},
        {of_lights([](auto& list) { list.push_back(list.back()); }),
         "there are 2 environment lights"},
        {of_lights([](auto& list) { list.emplace_back(ProfileLightDesc{}); }),
         "profile light 2: profile 0, but the number of profiles is 0"},
        {[](SharedSceneDesc& d) { d.fog = MediumDesc{.extinction = Rgb(-1.0f)}; }, "fog: "},
        {[](SharedSceneDesc& d) {
             change(d.images, [](auto& images) { images[1].bytes.pop_back(); });
         },
         "image 1: "},
        {[](SharedSceneDesc& d) {
             change(d.meshes, [](auto& meshes) { meshes[2].triangles[0].x = 77; });
         },
         "mesh 2: triangle 0 has index 77"},
    };
    for (const auto& [edit, expected] : cases) {
        CAPTURE(expected);
        SharedSceneDesc desc = scene.description();
        edit(desc);
        const std::string said = message_of([&] { (void)scene.edited(desc); });
        CHECK(said.find(expected) == 0);
        CHECK(said == message_of([&] { (void)Scene(desc.copy()); }));
    }
    const MaterialDesc any;
    CHECK(message_of([&] { (void)scene.with("flor", any); }) ==
          "the scene has 0 materials with the name \"flor\", not one");
    CHECK(message_of([&] { (void)scene.with("", InstanceDesc{}); }).find("the scene has 7 ") == 0);
    CHECK(message_of([&] { (void)scene.with(MaterialId{40}, any); }) ==
          "material 40, but the number of materials is 10");
    CHECK(rendered(scene, IntegratorKind::mis).film.develop().pixels ==
          before.film.develop().pixels);
}

TEST_CASE("renders go on undisturbed while their scene is edited", "[edit]")
{
    const Scene scene(all_kinds());
    const auto pixels = [&scene] {
        return rendered(scene, IntegratorKind::bdpt).film.develop().pixels;
    };
    const auto expected = pixels();
    std::vector<int> same(2, 0);
    std::vector<std::thread> renders;
    for (int& count : same) {
        renders.emplace_back([&] {
            for (int i = 0; i < 3; ++i) {
                count += pixels() == expected ? 1 : 0;
            }
        });
    }
    for (const NamedEdit& edit : edits()) {
        SharedSceneDesc desc = scene.description();
        try {
            edit.edit(desc);
        } catch (const std::logic_error&) {
            continue;
        }
        (void)scene.edited(desc);
    }
    for (std::thread& thread : renders) {
        thread.join();
    }
    CHECK(same == std::vector<int>{3, 3});
}

}  // namespace bdpt::test::scene_edit_test
