#include <bdpt/eval/bench/bench_scene.h>

#include <optional>
#include <variant>
#include <vector>

#include "bench/hasher.h"

namespace bdpt::eval {
namespace {

void add(Hasher& hasher, const TextureRef& texture)
{
    hasher.add(texture.image);
    hasher.add(texture.uv_set);
    hasher.add(texture.wrap_u);
    hasher.add(texture.wrap_v);
    hasher.add(texture.offset);
    hasher.add(texture.rotation);
    hasher.add(texture.scale);
}

void add(Hasher& hasher, const std::optional<TextureRef>& texture)
{
    hasher.add(texture.has_value());
    if (texture) {
        add(hasher, *texture);
    }
}

void add_layers(Hasher& hasher, const MaterialDesc& material)
{
    hasher.add(material.clearcoat.factor);
    hasher.add(material.clearcoat.roughness);
    hasher.add(material.clearcoat.normal_scale);
    hasher.add(material.sheen.color);
    hasher.add(material.sheen.roughness);
    hasher.add(material.anisotropy.strength);
    hasher.add(material.anisotropy.rotation);
    hasher.add(material.iridescence.factor);
    hasher.add(material.iridescence.ior);
    hasher.add(material.iridescence.thickness_minimum);
    hasher.add(material.iridescence.thickness_maximum);
    hasher.add(material.diffuse_transmission.factor);
    hasher.add(material.diffuse_transmission.color);
}

void add(Hasher& hasher, const MaterialDesc& material)
{
    hasher.add(material.base_color);
    hasher.add(material.alpha_mode);
    hasher.add(material.alpha_cutoff);
    hasher.add(material.unlit);
    hasher.add(material.metallic);
    hasher.add(material.roughness);
    hasher.add(material.emission);
    hasher.add(material.normal_scale);
    hasher.add(material.double_sided);
    hasher.add(material.ior);
    hasher.add(material.specular);
    hasher.add(material.specular_color);
    hasher.add(material.transmission);
    hasher.add(material.thickness);
    hasher.add(material.attenuation_distance);
    hasher.add(material.attenuation_color);
    hasher.add(material.dispersion);
    add_layers(hasher, material);
    for (const auto* texture : material.textures()) {
        add(hasher, *texture);
    }
}

/// What stands still has the hash that it had before anything could move.
template <typename T>
void add_motion(Hasher& hasher, const std::vector<T>& motion)
{
    if (!motion.empty()) {
        hasher.add_array(motion);
    }
}

void add(Hasher& hasher, const MeshDesc& mesh)
{
    hasher.add_array(mesh.positions);
    hasher.add_array(mesh.normals);
    hasher.add_array(mesh.tangents);
    for (const auto& uvs : mesh.uvs) {
        hasher.add_array(uvs);
    }
    hasher.add_array(mesh.colors);
    hasher.add_array(mesh.triangles);
    for (const MeshPose& pose : mesh.motion) {
        hasher.add_array(pose.positions);
        hasher.add_array(pose.normals);
        hasher.add_array(pose.tangents);
    }
}

void add(Hasher& hasher, const PointLightDesc& light)
{
    hasher.add(light.position);
    hasher.add(light.intensity);
    hasher.add(light.radius);
    add_motion(hasher, light.motion);
}

void add(Hasher& hasher, const SpotLightDesc& light)
{
    hasher.add(light.position);
    hasher.add(light.direction);
    hasher.add(light.intensity);
    hasher.add(light.inner_cone_angle);
    hasher.add(light.outer_cone_angle);
    hasher.add(light.radius);
    add_motion(hasher, light.motion);
    add_motion(hasher, light.turn);
}

void add(Hasher& hasher, const DirectionalLightDesc& light)
{
    hasher.add(light.direction);
    hasher.add(light.illuminance);
    add_motion(hasher, light.turn);
}

void add(Hasher& hasher, const EnvironmentLightDesc& light)
{
    hasher.add(light.radiance.width);
    hasher.add(light.radiance.height);
    hasher.add_array(light.radiance.pixels);
    hasher.add(light.world_from_environment);
}

void add(Hasher& hasher, const LightProfile& profile)
{
    hasher.add_array(profile.polar_angles);
    hasher.add_array(profile.azimuths);
    hasher.add_array(profile.intensities);
}

void add(Hasher& hasher, const ProfileLightDesc& light)
{
    hasher.add(light.position);
    hasher.add(light.world_from_light);
    hasher.add(light.scale);
    hasher.add(light.profile);
    add_motion(hasher, light.motion);
}

}  // namespace

std::uint64_t content_hash(const SceneDesc& scene)
{
    Hasher hasher;
    hasher.add(scene.images.size());
    for (const TexelImage& image : scene.images) {
        hasher.add(image.width);
        hasher.add(image.height);
        hasher.add(image.channels);
        hasher.add(image.type);
        hasher.add_array(image.bytes);
    }
    hasher.add(scene.materials.size());
    for (const MaterialDesc& material : scene.materials) {
        add(hasher, material);
    }
    hasher.add(scene.meshes.size());
    for (const MeshDesc& mesh : scene.meshes) {
        add(hasher, mesh);
    }
    hasher.add(scene.instances.size());
    for (const InstanceDesc& instance : scene.instances) {
        hasher.add(instance.mesh);
        hasher.add(instance.material);
        hasher.add(instance.world_from_object);
        add_motion(hasher, instance.motion);
    }
    // Without their number, so that scenes that have none keep the hash of older reports.
    for (const LightProfile& profile : scene.profiles) {
        add(hasher, profile);
    }
    hasher.add(scene.lights.size());
    for (const LightDesc& light : scene.lights) {
        hasher.add(light.index());
        std::visit([&](const auto& kind) { add(hasher, kind); }, light);
    }
    hasher.add(scene.texture_filter);
    return hasher.hash();
}

std::uint64_t content_hash(const CameraDesc& camera)
{
    Hasher hasher;
    hasher.add(camera.world_from_camera);
    hasher.add(camera.projection);
    hasher.add(camera.vertical_fov);
    hasher.add(camera.vertical_extent);
    hasher.add(camera.lens_radius);
    hasher.add(camera.focus_distance);
    add_motion(hasher, camera.motion);
    return hasher.hash();
}

}  // namespace bdpt::eval
