#pragma once

/// @file
/// Builds scenes in code.
///
/// @code{.cpp}
/// bdpt::SceneBuilder builder;
/// const bdpt::MaterialId white = builder.add(bdpt::MaterialDesc{});
/// builder.place(builder.add(bdpt::sphere_mesh(0.5f)), white).name = "ball";
/// builder.place(builder.add(bdpt::box_mesh({-2, -1, -2}, {2, -0.5f, 2})), white).name = "floor";
/// builder.add(bdpt::default_environment());
/// const bdpt::Scene scene(builder.take());
/// const bdpt::CameraDesc camera = bdpt::look_at({2, 1, 3}, {0, 0, 0});
/// @endcode

#include <bdpt/export.h>
#include <bdpt/scene_desc.h>

namespace bdpt {

/// Returns a quad of two triangles. Corners are counter-clockwise as seen from the front;
/// TEXCOORD_0 is (0, 1) at the first, (1, 1) at the second, (1, 0) at the third.
[[nodiscard]] BDPT_EXPORT MeshDesc quad_mesh(Vec3 a, Vec3 b, Vec3 c, Vec3 d);
/// Returns the closed surface of an axis-aligned box [m], with flat faces whose fronts are outside.
[[nodiscard]] BDPT_EXPORT MeshDesc box_mesh(Vec3 min, Vec3 max);
/// Returns a sphere around the origin with smooth normals and TEXCOORD_0: `segments` around its
/// axis, y, and half as many from pole to pole. Bit-identical on all machines. Throws `Error`
/// (usage) unless `radius` is above 0 and `segments` is in [4, 4096].
[[nodiscard]] BDPT_EXPORT MeshDesc sphere_mesh(float radius, unsigned segments = 64);
/// Returns a camera at `from` that looks at `to`, upright unless it looks straight up or down.
/// `vertical_fov` is in (0, pi) [rad]. Throws `Error` (usage) if both points are the same.
[[nodiscard]] BDPT_EXPORT CameraDesc look_at(Vec3 from, Vec3 to, float vertical_fov = 0.7853982f);

/// Builds the description of a scene with consistent indices.
///
///     bdpt::SceneBuilder builder;
///     const bdpt::MaterialId grey = builder.add(bdpt::MaterialDesc{});
///     builder.place(builder.add(bdpt::sphere_mesh(0.5f)), grey);
///     builder.place(builder.add(bdpt::box_mesh({-2, -1, -2}, {2, -0.5f, 2})), grey);
///     builder.add(bdpt::default_environment());
///     const bdpt::Scene scene(builder.take());
class BDPT_EXPORT SceneBuilder {
public:
    /// Adds a material, mesh or image and returns its index.
    [[nodiscard]] MaterialId add(MaterialDesc material);
    [[nodiscard]] MeshId add(MeshDesc mesh);
    [[nodiscard]] ImageId add(TexelImage image);
    void add(LightDesc light);
    /// Adds an instance of a mesh. Returns its description, to be named or moved; it stays valid
    /// until the next call. Throws `Error` (usage) for an index that `add` has not returned.
    InstanceDesc& place(MeshId mesh, MaterialId material,
                        const Mat4& world_from_object = Mat4(1.0f));

    /// Returns the description so far.
    [[nodiscard]] const SceneDesc& desc() const { return desc_; }
    /// Moves the description out; the builder is empty afterwards.
    [[nodiscard]] SceneDesc take();

private:
    SceneDesc desc_;
};

}  // namespace bdpt
