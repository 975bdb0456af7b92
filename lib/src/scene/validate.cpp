#include "scene/validate.h"

#include "geometry/reach.h"
#include "math/elementary.h"
#include "scene/check_texels.h"

#include <bdpt/error.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace bdpt {
namespace {

template <typename... Parts>
[[noreturn]] void fail(const Parts&... parts)
{
    std::ostringstream message;
    (message << ... << parts);
    throw Error(ErrorCode::invalid_input, message.str());
}

/// `mesh 3 "chair"`
std::string label(std::string_view kind, std::size_t index, const std::string& name)
{
    std::string text = std::string(kind) + " " + std::to_string(index);
    return name.empty() ? text : text + " \"" + name + "\"";
}

std::size_t area(int width, int height)
{
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

bool all_finite(const float* values, int count)
{
    for (int i = 0; i < count; ++i) {
        if (!std::isfinite(values[i])) {
            return false;
        }
    }
    return true;
}

template <typename T>
void check_attribute(const std::string& item, const char* what, const std::vector<T>& values,
                     std::size_t vertices)
{
    if (!values.empty() && values.size() != vertices) {
        fail(item, ": ", values.size(), " ", what, ", but there are ", vertices, " vertices");
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!all_finite(&values[i][0], T::length())) {
            fail(item, ": ", what, " ", i, " is not finite");
        }
    }
}

void check(const MeshDesc& mesh, const std::string& item)
{
    const std::size_t vertices = mesh.positions.size();
    check_attribute(item, "positions", mesh.positions, vertices);
    check_attribute(item, "normals", mesh.normals, vertices);
    check_attribute(item, "tangents", mesh.tangents, vertices);
    check_attribute(item, "texture coordinates (set 0)", mesh.uvs[0], vertices);
    check_attribute(item, "texture coordinates (set 1)", mesh.uvs[1], vertices);
    check_attribute(item, "colours", mesh.colors, vertices);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (int corner = 0; corner < 3; ++corner) {
            if (mesh.triangles[t][corner] >= vertices) {
                fail(item, ": triangle ", t, " has index ", mesh.triangles[t][corner],
                     ", but there are ", vertices, " vertices");
            }
        }
    }
}

void check_range(const std::string& item, const char* what, float value, float low, float high)
{
    if (!(value >= low && value <= high)) {
        fail(item, ": ", what, " is ", value, ", not in [", low, ", ", high, "]");
    }
}

template <typename Color>
void check_color(const std::string& item, const char* what, const Color& value, float high)
{
    for (int c = 0; c < Color::length(); ++c) {
        check_range(item, what, value[c], 0.0f, high);
    }
}

constexpr float any_positive = std::numeric_limits<float>::max();

void check(const TextureRef& texture, const std::string& item, std::size_t image_count)
{
    if (static_cast<std::size_t>(texture.image) >= image_count) {
        fail(item, ": image ", static_cast<std::size_t>(texture.image), ", but there are ",
             image_count, " images");
    }
    if (texture.uv_set != 0 && texture.uv_set != 1) {
        fail(item, ": texture coordinate set ", texture.uv_set, " is neither 0 nor 1");
    }
    if (!all_finite(&texture.offset[0], 2) || !all_finite(&texture.scale[0], 2) ||
        !std::isfinite(texture.rotation)) {
        fail(item, ": texture transform is not finite");
    }
}

void check_layers(const MaterialDesc& material, const std::string& item)
{
    check_range(item, "clearcoat", material.clearcoat.factor, 0.0f, 1.0f);
    check_range(item, "clearcoat roughness", material.clearcoat.roughness, 0.0f, 1.0f);
    check_range(item, "clearcoat normal scale", material.clearcoat.normal_scale, -any_positive,
                any_positive);
    check_color(item, "sheen colour", material.sheen.color, 1.0f);
    check_range(item, "sheen roughness", material.sheen.roughness, 0.0f, 1.0f);
    check_range(item, "anisotropy strength", material.anisotropy.strength, 0.0f, 1.0f);
    check_range(item, "anisotropy rotation", material.anisotropy.rotation, -any_positive,
                any_positive);
    const IridescenceDesc& film = material.iridescence;
    check_range(item, "iridescence", film.factor, 0.0f, 1.0f);
    check_range(item, "iridescence index of refraction", film.ior, 1.0f, any_positive);
    check_range(item, "iridescence thickness", film.thickness_minimum, 0.0f, any_positive);
    check_range(item, "iridescence thickness", film.thickness_maximum, 0.0f, any_positive);
    const DiffuseTransmissionDesc& through = material.diffuse_transmission;
    check_range(item, "diffuse transmission", through.factor, 0.0f, 1.0f);
    check_color(item, "diffuse transmission colour", through.color, 1.0f);
}

void check(const MaterialDesc& material, const std::string& item, std::size_t image_count)
{
    check_color(item, "base colour", material.base_color, 1.0f);
    check_range(item, "alpha cutoff", material.alpha_cutoff, 0.0f, any_positive);
    check_range(item, "metallic", material.metallic, 0.0f, 1.0f);
    check_range(item, "roughness", material.roughness, 0.0f, 1.0f);
    check_color(item, "emission", material.emission, any_positive);
    check_range(item, "normal scale", material.normal_scale, -any_positive, any_positive);
    check_range(item, "index of refraction", material.ior, 1.0f, any_positive);
    check_range(item, "specular", material.specular, 0.0f, 1.0f);
    check_color(item, "specular colour", material.specular_color, any_positive);
    check_range(item, "transmission", material.transmission, 0.0f, 1.0f);
    check_range(item, "thickness", material.thickness, 0.0f, any_positive);
    check_color(item, "attenuation colour", material.attenuation_color, 1.0f);
    if (!(material.attenuation_distance > 0.0f)) {
        fail(item, ": attenuation distance is ", material.attenuation_distance,
             ", but must be above 0");
    }
    check_range(item, "dispersion", material.dispersion, 0.0f, any_positive);
    check_layers(material, item);
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
        if (*texture) {
            check(**texture, item, image_count);
        }
    }
}

void check(const InstanceDesc& instance, const std::string& item, const SceneDesc& desc)
{
    if (static_cast<std::size_t>(instance.mesh) >= desc.meshes.size()) {
        fail(item, ": mesh ", static_cast<std::size_t>(instance.mesh), ", but there are ",
             desc.meshes.size(), " meshes");
    }
    if (static_cast<std::size_t>(instance.material) >= desc.materials.size()) {
        fail(item, ": material ", static_cast<std::size_t>(instance.material), ", but there are ",
             desc.materials.size(), " materials");
    }
    const Mat4& m = instance.world_from_object;
    if (!all_finite(&m[0][0], 16)) {
        fail(item, ": transform is not finite");
    }
    const float determinant = glm::determinant(Mat3(m));
    if (!std::isnormal(determinant)) {
        fail(item, ": transform has no inverse (determinant ", determinant, ")");
    }
}

void check_direction(const std::string& item, Vec3 direction)
{
    if (!all_finite(&direction[0], 3) || !(dot(direction, direction) > 0.0f)) {
        fail(item, ": direction is zero or not finite");
    }
}

/// How far things may be, and why.
std::string reach_text(float reach)
{
    std::ostringstream text;
    text << " m from the origin, but " << reach << " m is the most";
    if (reach < greatest_reach) {
        text << ", as a mesh that is used more than once is scaled down very much";
    }
    return text.str();
}

void check_position(const std::string& item, Vec3 position, float reach)
{
    if (!all_finite(&position[0], 3)) {
        fail(item, ": position is not finite");
    }
    const float extent =
        std::max({std::abs(position.x), std::abs(position.y), std::abs(position.z)});
    if (extent > reach) {
        fail(item, ": is ", extent, reach_text(reach));
    }
}

/// What is traced must be within reach of rays, as they are single-precision numbers.
void check_reach(const SceneDesc& desc, float reach)
{
    std::vector<Vec3> extents;
    extents.reserve(desc.meshes.size());
    for (const MeshDesc& mesh : desc.meshes) {
        extents.push_back(extent_of(mesh));
    }
    for (std::size_t i = 0; i < desc.instances.size(); ++i) {
        const InstanceDesc& instance = desc.instances[i];
        const float extent = placed_extent(extents[static_cast<std::size_t>(instance.mesh)],
                                           instance.world_from_object);
        if (!(extent <= reach)) {
            fail(label("instance", i, instance.name), ": reaches ", extent, reach_text(reach));
        }
    }
}

void check_radius(const std::string& item, float radius, Rgb intensity)
{
    constexpr float least = 1e-15f;  // the area of the ball stays a normal float
    constexpr float most = 1e15f;
    if (radius == 0.0f) {
        return;
    }
    if (!(radius >= least && radius <= most)) {
        fail(item, ": radius is ", radius, ", neither 0 nor in [", least, ", ", most, "]");
    }
    const Rgb radiance = intensity / (pi * radius * radius);
    if (!all_finite(&radiance[0], 3)) {
        fail(item, ": radius ", radius, " is too small for the intensity");
    }
}

struct LightCheck {
    std::size_t index;
    float reach;

    void operator()(const PointLightDesc& light) const
    {
        const std::string item = label("point light", index, light.name);
        check_position(item, light.position, reach);
        check_color(item, "intensity", light.intensity, any_positive);
        check_radius(item, light.radius, light.intensity);
    }

    void operator()(const SpotLightDesc& light) const
    {
        const std::string item = label("spot light", index, light.name);
        check_position(item, light.position, reach);
        check_direction(item, light.direction);
        check_color(item, "intensity", light.intensity, any_positive);
        check_radius(item, light.radius, light.intensity);
        check_range(item, "inner cone angle", light.inner_cone_angle, 0.0f, 0.5f * pi);
        check_range(item, "outer cone angle", light.outer_cone_angle, 1e-4f, 0.5f * pi + 1e-6f);
        if (!(light.inner_cone_angle < light.outer_cone_angle)) {
            fail(item, ": inner cone angle ", light.inner_cone_angle,
                 " is not below the outer cone angle ", light.outer_cone_angle);
        }
    }

    void operator()(const DirectionalLightDesc& light) const
    {
        const std::string item = label("directional light", index, light.name);
        check_direction(item, light.direction);
        check_color(item, "illuminance", light.illuminance, any_positive);
    }

    void operator()(const EnvironmentLightDesc& light) const
    {
        const std::string item = label("environment light", index, "");
        const Image& image = light.radiance;
        if (image.width < 1 || image.height < 1 ||
            image.pixels.size() != area(image.width, image.height)) {
            fail(item, ": picture of ", image.width, " x ", image.height, " with ",
                 image.pixels.size(), " pixels");
        }
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            const auto column = i % static_cast<std::size_t>(image.width);
            const auto row = i / static_cast<std::size_t>(image.width);
            check_color(
                item + ": pixel (" + std::to_string(column) + ", " + std::to_string(row) + ")",
                "radiance", image.pixels[i], any_positive);
        }
        if (!all_finite(&light.world_from_environment[0][0], 9)) {
            fail(item, ": rotation is not finite");
        }
    }
};

bool is_degenerate(const MeshDesc& mesh, const UVec3& triangle)
{
    const Vec3& a = mesh.positions[triangle.x];
    const Vec3 normal = cross(mesh.positions[triangle.y] - a, mesh.positions[triangle.z] - a);
    return normal == Vec3(0.0f);
}

}  // namespace

void validate(const SceneDesc& desc)
{
    for (std::size_t i = 0; i < desc.images.size(); ++i) {
        check_texels(desc.images[i], label("image", i, ""));
    }
    for (std::size_t i = 0; i < desc.materials.size(); ++i) {
        const MaterialDesc& material = desc.materials[i];
        check(material, label("material", i, material.name), desc.images.size());
    }
    for (std::size_t i = 0; i < desc.meshes.size(); ++i) {
        check(desc.meshes[i], label("mesh", i, desc.meshes[i].name));
    }
    for (std::size_t i = 0; i < desc.instances.size(); ++i) {
        check(desc.instances[i], label("instance", i, desc.instances[i].name), desc);
    }
    const float reach = reach_of(desc.instances, desc.meshes.size());
    check_reach(desc, reach);
    std::size_t environments = 0;
    for (std::size_t i = 0; i < desc.lights.size(); ++i) {
        std::visit(LightCheck{i, reach}, desc.lights[i]);
        environments += std::holds_alternative<EnvironmentLightDesc>(desc.lights[i]) ? 1U : 0U;
    }
    if (environments > 1) {
        fail("there are ", environments, " environment lights, but one is the most");
    }
}

SceneCounts count(const SceneDesc& desc)
{
    SceneCounts counts;
    for (const MeshDesc& mesh : desc.meshes) {
        counts.triangles += mesh.triangles.size();
        for (const UVec3& triangle : mesh.triangles) {
            counts.degenerate_triangles += is_degenerate(mesh, triangle) ? 1U : 0U;
        }
    }
    for (const InstanceDesc& instance : desc.instances) {
        counts.instanced_triangles +=
            desc.meshes[static_cast<std::size_t>(instance.mesh)].triangles.size();
    }
    return counts;
}

}  // namespace bdpt
