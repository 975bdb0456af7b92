#include <bdpt/harness/bench/bench_scene.h>

#include <optional>
#include <variant>

#include "bench/hasher.h"

namespace bdpt::harness {
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
    for (const auto* texture :
         {&material.base_color_texture, &material.metallic_roughness_texture,
          &material.normal_texture, &material.emission_texture, &material.specular_texture,
          &material.specular_color_texture, &material.transmission_texture,
          &material.glossiness_texture, &material.clearcoat.texture,
          &material.clearcoat.roughness_texture, &material.clearcoat.normal_texture,
          &material.sheen.color_texture, &material.sheen.roughness_texture,
          &material.anisotropy.texture, &material.iridescence.texture,
          &material.iridescence.thickness_texture, &material.diffuse_transmission.texture,
          &material.diffuse_transmission.color_texture}) {
        add(hasher, *texture);
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
}

void add(Hasher& hasher, const PointLightDesc& light)
{
    hasher.add(light.position);
    hasher.add(light.intensity);
    hasher.add(light.radius);
}

void add(Hasher& hasher, const SpotLightDesc& light)
{
    hasher.add(light.position);
    hasher.add(light.direction);
    hasher.add(light.intensity);
    hasher.add(light.inner_cone_angle);
    hasher.add(light.outer_cone_angle);
    hasher.add(light.radius);
}

void add(Hasher& hasher, const DirectionalLightDesc& light)
{
    hasher.add(light.direction);
    hasher.add(light.illuminance);
}

void add(Hasher& hasher, const EnvironmentLightDesc& light)
{
    hasher.add(light.radiance.width);
    hasher.add(light.radiance.height);
    hasher.add_array(light.radiance.pixels);
    hasher.add(light.world_from_environment);
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
    return hasher.hash();
}

}  // namespace bdpt::harness
