#pragma once

#include <bdpt/scene_desc.h>
#include <bdpt/tools/scene_builder.h>

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <cstddef>

namespace bdpt::test {

/// Returns a Lambertian surface: KHR_materials_specular with factor 0.
inline MaterialDesc lambertian(Rgb color)
{
    MaterialDesc material;
    material.base_color = Vec4(color, 1.0f);
    material.metallic = 0.0f;
    material.specular = 0.0f;
    return material;
}

inline MaterialDesc emitter(Rgb radiance, Rgb color = Rgb(0.5f))
{
    MaterialDesc material = lambertian(color);
    material.emission = radiance;
    return material;
}

inline MaterialDesc plastic(Rgb color, float roughness)
{
    MaterialDesc material = lambertian(color);
    material.specular = 1.0f;
    material.roughness = roughness;
    return material;
}

inline MaterialDesc metal(Rgb color, float roughness)
{
    MaterialDesc material;
    material.base_color = Vec4(color, 1.0f);
    material.roughness = roughness;
    return material;
}

/// Returns solid glass; `roughness` 0 is perfectly clear.
inline MaterialDesc glass(float roughness)
{
    MaterialDesc material;
    material.metallic = 0.0f;
    material.roughness = roughness;
    material.transmission = 1.0f;
    material.thickness = 1.0f;
    return material;
}

/// Returns wax: light enters and leaves it diffusely, and scatters in it many times.
inline MaterialDesc wax()
{
    MaterialDesc material = lambertian(Rgb(1.0f));
    material.diffuse_transmission.factor = 0.9f;
    material.thickness = 1.0f;
    material.attenuation_color = {0.4f, 0.3f, 0.2f};
    material.attenuation_distance = 0.1f;
    material.volume_scatter = {.color = {0.9f, 0.8f, 0.6f}, .anisotropy = 0.0f};
    return material;
}

inline MaterialDesc thin_glass(float roughness)
{
    MaterialDesc material = glass(roughness);
    material.thickness = 0.0f;
    return material;
}

/// Builds a `SceneDesc`, one surface at a time.
class SceneBuilder {
public:
    /// Adds a quad with corners counter-clockwise from the front.
    SceneBuilder& quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d, const MaterialDesc& material)
    {
        return place(add_mesh(quad_mesh(a, b, c, d)), material, Mat4(1.0f));
    }

    /// Adds the mesh of a unit sphere with smooth normals.
    [[nodiscard]] MeshId sphere_mesh(unsigned segments)
    {
        MeshDesc mesh;
        const unsigned rings = segments / 2;
        for (unsigned ring = 0; ring <= rings; ++ring) {
            const double theta = 3.14159265358979 * ring / rings;
            for (unsigned i = 0; i <= segments; ++i) {
                const double phi = 2.0 * 3.14159265358979 * i / segments;
                mesh.positions.emplace_back(std::sin(theta) * std::sin(phi), std::cos(theta),
                                            std::sin(theta) * std::cos(phi));
                mesh.uvs[0].emplace_back(static_cast<double>(i) / segments,
                                         static_cast<double>(ring) / rings);
            }
        }
        mesh.normals = mesh.positions;
        mesh.triangles = bdpt::sphere_mesh(1.0f, segments).triangles;
        return add_mesh(std::move(mesh));
    }

    [[nodiscard]] MeshId add_mesh(MeshDesc mesh)
    {
        desc.meshes.push_back(std::move(mesh));
        return static_cast<MeshId>(desc.meshes.size() - 1);
    }

    SceneBuilder& place(MeshId mesh, const MaterialDesc& material, const Mat4& world_from_object)
    {
        desc.materials.push_back(material);
        InstanceDesc instance;
        instance.mesh = mesh;
        instance.material = static_cast<MaterialId>(desc.materials.size() - 1);
        instance.world_from_object = world_from_object;
        desc.instances.push_back(instance);
        return *this;
    }

    SceneBuilder& sphere(Vec3 center, float radius, const MaterialDesc& material,
                         unsigned segments = 48)
    {
        return place(sphere_mesh(segments), material,
                     glm::scale(glm::translate(Mat4(1.0f), center), Vec3(radius)));
    }

    /// Adds the closed surface of a cube, with its front outside and flat faces.
    SceneBuilder& cube(Vec3 center, float half_width, const MaterialDesc& material)
    {
        return place(add_mesh(box_mesh(center - half_width, center + half_width)), material,
                     Mat4(1.0f));
    }

    /// Adds the inside of the cube [-1, 1]^3 without its front (+z) and its ceiling.
    SceneBuilder& walls(const MaterialDesc& floor, const MaterialDesc& others)
    {
        quad({-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}, floor);
        quad({-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, others);
        quad({-1, -1, 1}, {-1, -1, -1}, {-1, 1, -1}, {-1, 1, 1}, others);
        return quad({1, -1, -1}, {1, -1, 1}, {1, 1, 1}, {1, 1, -1}, others);
    }

    SceneBuilder& ceiling(const MaterialDesc& material)
    {
        return quad({-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}, material);
    }

    SceneBuilder& front(const MaterialDesc& material)
    {
        return quad({1, -1, 1}, {-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, material);
    }

    /// Adds a square area light at height y that faces down.
    SceneBuilder& lamp(float y, float half_width, Rgb radiance)
    {
        const float h = half_width;
        return quad({-h, y, -h}, {h, y, -h}, {h, y, h}, {-h, y, h}, emitter(radiance));
    }

    SceneBuilder& light(const LightDesc& light_desc)
    {
        desc.lights.push_back(light_desc);
        return *this;
    }

    SceneDesc desc;
};

/// Returns a camera at `from`, looking at `to`.
inline CameraDesc camera_at(Vec3 from, Vec3 to, float vertical_fov)
{
    CameraDesc camera;
    camera.world_from_camera = glm::inverse(glm::lookAt(from, to, Vec3(0.0f, 1.0f, 0.0f)));
    camera.vertical_fov = vertical_fov;
    return camera;
}

/// Returns the same view through a thin lens.
inline CameraDesc with_lens(CameraDesc camera, float radius, float focus_distance)
{
    camera.lens_radius = radius;
    camera.focus_distance = focus_distance;
    return camera;
}

/// Returns the same view by a parallel projection.
inline CameraDesc in_parallel(CameraDesc camera, float vertical_extent)
{
    camera.projection = Projection::orthographic;
    camera.vertical_extent = vertical_extent;
    return camera;
}

/// Returns a camera that sees the whole of `walls` through the open front.
inline CameraDesc room_camera()
{
    return camera_at({0.0f, 0.0f, 3.4f}, {0.0f, 0.0f, 0.0f}, 0.75f);
}

}  // namespace bdpt::test
