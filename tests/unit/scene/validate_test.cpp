#include "scene/checks/validate.h"

#include <bdpt/error.h>

#include "catch.hpp"
#include "scene_builder.h"

#include <functional>
#include <limits>
#include <string>

namespace bdpt::validate_test {
namespace {

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

SceneDesc good()
{
    test::SceneBuilder builder;
    builder.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, test::lambertian(Rgb(0.5f)));
    builder.desc.meshes[0].name = "chair";
    builder.desc.images.push_back({.width = 1, .height = 1, .bytes = {1, 2, 3, 4}});
    builder.light(PointLightDesc{});
    builder.light(
        EnvironmentLightDesc{.radiance = Image{.width = 1, .height = 1, .pixels = {Rgb(1)}}});
    return std::move(builder.desc);
}

/// The message with which the scene is refused after `change`; empty when it is accepted.
std::string refusal(const std::function<void(SceneDesc&)>& change)
{
    SceneDesc desc = good();
    change(desc);
    try {
        validate(desc);
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::invalid_input);
        return error.what();
    }
    return "";
}

void check_refused(const std::string& text, const std::function<void(SceneDesc&)>& change)
{
    const std::string message = refusal(change);
    INFO(message);
    CHECK(message.find(text) != std::string::npos);
    CHECK(message.find('\n') == std::string::npos);
}

}  // namespace

TEST_CASE("a good scene is accepted and counted", "[validate]")
{
    CHECK(refusal([](SceneDesc&) {}).empty());
    SceneDesc desc = good();
    desc.meshes[0].triangles.emplace_back(1, 1, 2);
    desc.instances.push_back(desc.instances[0]);
    const SceneCounts counts = count(desc);
    CHECK(counts.triangles == 3);
    CHECK(counts.degenerate_triangles == 1);
    CHECK(counts.instanced_triangles == 6);
}

TEST_CASE("meshes: indices, attribute counts and numbers", "[validate]")
{
    check_refused("mesh 0 \"chair\": triangle 1 has index 912, but the number of vertices is 4",
                  [](SceneDesc& d) { d.meshes[0].triangles[1].y = 912; });
    check_refused("mesh 0 \"chair\": positions 2 is not finite",
                  [](SceneDesc& d) { d.meshes[0].positions[2].y = nan_value; });
    check_refused("3 normals, but the number of vertices is 4",
                  [](SceneDesc& d) { d.meshes[0].normals.assign(3, Vec3(1.0f)); });
    check_refused("texture coordinates (set 1) 0 is not finite",
                  [](SceneDesc& d) { d.meshes[0].uvs[1].assign(4, Vec2(nan_value)); });
}

TEST_CASE("instances: references and transforms", "[validate]")
{
    check_refused("instance 0: mesh 7, but the number of meshes is 1",
                  [](SceneDesc& d) { d.instances[0].mesh = MeshId{7}; });
    check_refused("instance 0: material 9, but the number of materials is 1",
                  [](SceneDesc& d) { d.instances[0].material = MaterialId{9}; });
    check_refused("instance 0: transform has no inverse",
                  [](SceneDesc& d) { d.instances[0].world_from_object[1] = Vec4(0.0f); });
    check_refused("instance 0: transform is not finite", [](SceneDesc& d) {
        d.instances[0].world_from_object[3].x = std::numeric_limits<float>::infinity();
    });
}

TEST_CASE("everything is within reach of rays", "[validate]")
{
    check_refused("instance 0: reaches 2e+15 m from the origin, but 1e+15 m is the most",
                  [](SceneDesc& d) { d.meshes[0].positions[2].y = -2e15f; });
    check_refused("instance 0: reaches 3e+15 m",
                  [](SceneDesc& d) { d.instances[0].world_from_object[3].z = 3e15f; });
    check_refused("point light 0: is 1e+16 m from the origin",
                  [](SceneDesc& d) { std::get<PointLightDesc>(d.lights[0]).position.x = -1e16f; });
    // Shared meshes are traced in their own space, where 1 m is 1e17 units here.
    const auto scale = [](float factor, int uses) {
        return [factor, uses](SceneDesc& d) {
            d.instances[0].world_from_object[0].x = factor;
            d.instances.resize(static_cast<std::size_t>(uses), d.instances[0]);
        };
    };
    CHECK(refusal(scale(1e-17f, 1)).empty());
    check_refused("is the most, because an instanced or moving mesh is scaled down very much",
                  scale(1e-18f, 2));
    CHECK(refusal(scale(1e-6f, 2)).empty());
}

TEST_CASE("materials: ranges and textures", "[validate]")
{
    check_refused("material 0: roughness is 1.5",
                  [](SceneDesc& d) { d.materials[0].roughness = 1.5f; });
    check_refused("material 0: base colour is -1",
                  [](SceneDesc& d) { d.materials[0].base_color.g = -1.0f; });
    check_refused("material 0: emission is nan",
                  [](SceneDesc& d) { d.materials[0].emission.b = nan_value; });
    check_refused("material 0: index of refraction is 0.5",
                  [](SceneDesc& d) { d.materials[0].ior = 0.5f; });
    check_refused("material 0: dispersion is -1",
                  [](SceneDesc& d) { d.materials[0].dispersion = -1.0f; });
    check_refused("material 0: clearcoat is 1.5",
                  [](SceneDesc& d) { d.materials[0].clearcoat.factor = 1.5f; });
    check_refused("material 0: clearcoat roughness is nan",
                  [](SceneDesc& d) { d.materials[0].clearcoat.roughness = nan_value; });
    check_refused("material 0: sheen colour is 2",
                  [](SceneDesc& d) { d.materials[0].sheen.color.b = 2.0f; });
    check_refused("material 0: anisotropy strength is -1",
                  [](SceneDesc& d) { d.materials[0].anisotropy.strength = -1.0f; });
    check_refused("material 0: iridescence index of refraction is 0.9",
                  [](SceneDesc& d) { d.materials[0].iridescence.ior = 0.9f; });
    check_refused("material 0: iridescence thickness minimum is -5",
                  [](SceneDesc& d) { d.materials[0].iridescence.thickness_minimum = -5.0f; });
    check_refused("material 0: coat index of refraction is 0.5",
                  [](SceneDesc& d) { d.materials[0].coat.ior = 0.5f; });
    check_refused("material 0: fuzz roughness is 1.5",
                  [](SceneDesc& d) { d.materials[0].fuzz.roughness = 1.5f; });
    check_refused("material 0: diffuse roughness is -1",
                  [](SceneDesc& d) { d.materials[0].diffuse_roughness.factor = -1.0f; });
    check_refused("material 0: diffuse transmission is 2",
                  [](SceneDesc& d) { d.materials[0].diffuse_transmission.factor = 2.0f; });
    check_refused("material 0: image 4, but the number of images is 1", [](SceneDesc& d) {
        d.materials[0].iridescence.thickness_texture = TextureRef{.image = ImageId{4}};
    });
    check_refused("attenuation distance is 0",
                  [](SceneDesc& d) { d.materials[0].attenuation_distance = 0.0f; });
    check_refused("material 0: image 4, but the number of images is 1", [](SceneDesc& d) {
        d.materials[0].normal_texture = TextureRef{.image = ImageId{4}};
    });
    check_refused("texture coordinate set 2", [](SceneDesc& d) {
        d.materials[0].emission_texture = TextureRef{.image = ImageId{0}, .uv_set = 2};
    });
}

TEST_CASE("lights and images", "[validate]")
{
    check_refused("point light 0: intensity is -2",
                  [](SceneDesc& d) { std::get<PointLightDesc>(d.lights[0]).intensity.r = -2.0f; });
    const auto radius = [](float value) {
        return [value](SceneDesc& d) { std::get<PointLightDesc>(d.lights[0]).radius = value; };
    };
    check_refused("point light 0: radius is -1, neither 0", radius(-1.0f));
    check_refused("point light 0: radius is nan", radius(nan_value));
    check_refused("point light 0: radius is inf", radius(std::numeric_limits<float>::infinity()));
    check_refused("point light 0: radius is 1e-18", radius(1e-18f));
    check_refused("point light 0: radius 1e-12 is too small for the intensity", [](SceneDesc& d) {
        std::get<PointLightDesc>(d.lights[0]).radius = 1e-12f;
        std::get<PointLightDesc>(d.lights[0]).intensity = Rgb(1e20f);
    });
    check_refused("spot light 2: radius is -1",
                  [](SceneDesc& d) { d.lights.emplace_back(SpotLightDesc{.radius = -1.0f}); });
    check_refused("directional light 2: direction is zero", [](SceneDesc& d) {
        d.lights.emplace_back(DirectionalLightDesc{.direction = Vec3(0.0f)});
    });
    check_refused("spot light 2: inner cone angle 0.7", [](SceneDesc& d) {
        d.lights.emplace_back(SpotLightDesc{.inner_cone_angle = 0.7f, .outer_cone_angle = 0.6f});
    });
    check_refused("environment light 1: pixel (0, 0): radiance is -1", [](SceneDesc& d) {
        std::get<EnvironmentLightDesc>(d.lights[1]).radiance =
            Image{.width = 1, .height = 1, .pixels = {Rgb(-1.0f, 1.0f, 1.0f)}};
    });
    check_refused("there are 2 environment lights",
                  [](SceneDesc& d) { d.lights.push_back(d.lights[1]); });
    const auto fog = [](MediumDesc medium) { return [medium](SceneDesc& d) { d.fog = medium; }; };
    constexpr float infinite = std::numeric_limits<float>::infinity();
    check_refused("fog: extinction is -1", fog({.extinction = {0, -1, 0}}));
    check_refused("fog: extinction is inf", fog({.extinction = {0, infinite, 0}}));
    check_refused("fog: albedo is 1.1", fog({.albedo = {0, 0, 1.1f}}));
    check_refused("fog: anisotropy is 1", fog({.anisotropy = 1.0f}));
    check_refused("fog: anisotropy is -1", fog({.anisotropy = -1.0f}));
    const auto volume = [](const auto& change) {
        return [change](SceneDesc& d) {
            VolumeDesc smoke{.name = "smoke", .size = {2, 1, 1}, .density = {0.0f, 1.0f}};
            change(smoke);
            d.volumes.push_back(std::move(smoke));
        };
    };
    check_refused("volume 0 \"smoke\": 2 x 1 x 1 voxels, but 1 densities",
                  volume([](VolumeDesc& v) { v.density.pop_back(); }));
    check_refused("volume 0 \"smoke\": 0 x 1 x 1 voxels",
                  volume([](VolumeDesc& v) { v.size.x = 0; }));
    check_refused("volume 0 \"smoke\": density is -1",
                  volume([](VolumeDesc& v) { v.density[1] = -1.0f; }));
    check_refused("volume 0 \"smoke\": extinction is inf",
                  volume([](VolumeDesc& v) { v.extinction.g = infinite; }));
    check_refused("volume 0 \"smoke\": albedo is 2", volume([](VolumeDesc& v) { v.albedo.g = 2; }));
    check_refused("volume 0 \"smoke\": anisotropy is 1",
                  volume([](VolumeDesc& v) { v.anisotropy = 1; }));
    check_refused("volume 0 \"smoke\": its maximum extinction",
                  volume([](VolumeDesc& v) { v.extinction.g = 1e38f; }));
    check_refused("volume 0 \"smoke\": its maximum extinction",
                  volume([](VolumeDesc& v) { v.density[0] = 1e6f; }));
    check_refused("volume 0 \"smoke\": reaches",
                  volume([](VolumeDesc& v) { v.world_from_grid[3].x = 1e30f; }));
    check_refused("volume 0 \"smoke\": transform has no inverse",
                  volume([](VolumeDesc& v) { v.world_from_grid[0] = Vec4(0.0f); }));
    check_refused("image 0: 2 x 1 texels with 4 bytes",
                  [](SceneDesc& d) { d.images[0].width = 2; });
    check_refused("image 0: 1 x 1 texels with 4 bytes",
                  [](SceneDesc& d) { d.images[0].type = TexelType::unorm16; });
    check_refused("image 0: 5 channels, but there must be 1 to 4",
                  [](SceneDesc& d) { d.images[0].channels = 5; });
    const auto halves = [](std::vector<std::uint8_t> bytes) {
        return [bytes](SceneDesc& d) { d.images[0] = {2, 1, bytes, 1, TexelType::half}; };
    };
    check_refused("image 0: texel (1, 0) has a value that is negative or not finite",
                  halves({0x00, 0x3c, 0x01, 0x80}));  // 1 and -6e-8
    check_refused("image 0: texel (0, 0) has a value that is negative or not finite",
                  halves({0x00, 0x7c, 0x00, 0x3c}));  // infinite
    check_refused("image 0: texel (0, 0) has a value that is negative or not finite",
                  [](SceneDesc& d) {  // a NaN
                      d.images[0] = {1, 1, {0x01, 0x00, 0x80, 0x7f}, 1, TexelType::float32};
                  });
    CHECK(refusal(halves({0x00, 0x80, 0xff, 0x7b})).empty());  // -0 and 65504
}

TEST_CASE("light profiles", "[validate]")
{
    const LightProfile sound{.polar_angles = {0.0f, 1.0f},
                             .azimuths = {0.0f, 6.2831853f},
                             .intensities = {1.0f, 2.0f, 1.0f, 2.0f}};
    const auto with =
        [&sound](const std::function<void(LightProfile&, ProfileLightDesc&)>& change) {
            return [&sound, change](SceneDesc& d) {
                LightProfile profile = sound;
                ProfileLightDesc light{.name = "lantern"};
                change(profile, light);
                d.profiles.push_back(profile);
                d.lights.emplace_back(light);
            };
        };
    CHECK(refusal(with([](LightProfile&, ProfileLightDesc&) {})).empty());
    check_refused("light profile 0: 2 polar angles and 2 azimuths, but 3 intensities",
                  with([](LightProfile& p, ProfileLightDesc&) { p.intensities.pop_back(); }));
    check_refused("light profile 0: 1 polar angles", with([](LightProfile& p, ProfileLightDesc&) {
                      p.polar_angles.pop_back();
                      p.intensities.resize(2);
                  }));
    check_refused("light profile 0: polar angle 1 is -1, not above",
                  with([](LightProfile& p, ProfileLightDesc&) { p.polar_angles[1] = -1.0f; }));
    check_refused("light profile 0: polar angle is 3.2",
                  with([](LightProfile& p, ProfileLightDesc&) { p.polar_angles[1] = 3.2f; }));
    check_refused("light profile 0: azimuth 0 is nan",
                  with([](LightProfile& p, ProfileLightDesc&) { p.azimuths[0] = nan_value; }));
    check_refused("light profile 0: turn of the azimuths is 7",
                  with([](LightProfile& p, ProfileLightDesc&) { p.azimuths[1] = 7.0f; }));
    check_refused("light profile 0: intensity is -1",
                  with([](LightProfile& p, ProfileLightDesc&) { p.intensities[2] = -1.0f; }));
    check_refused("profile light 2 \"lantern\": profile 1, but the number of profiles is 1",
                  with([](LightProfile&, ProfileLightDesc& l) { l.profile = ProfileId{1}; }));
    check_refused("profile light 2 \"lantern\": axes are not orthonormal",
                  with([](LightProfile&, ProfileLightDesc& l) { l.world_from_light[1].x = 0.1f; }));
    check_refused("profile light 2 \"lantern\": scale is -1",
                  with([](LightProfile&, ProfileLightDesc& l) { l.scale.g = -1.0f; }));
    check_refused("profile light 2 \"lantern\": intensity is inf",
                  with([](LightProfile&, ProfileLightDesc& l) { l.scale.b = 3e38f; }));
    check_refused("profile light 2 \"lantern\": is 1e+16",
                  with([](LightProfile&, ProfileLightDesc& l) { l.position.y = 1e16f; }));
}

}  // namespace bdpt::validate_test
