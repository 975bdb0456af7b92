#pragma once

#include "scene_builder.h"

#include <bdpt/motion.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace bdpt::test {

/// Returns `steps` later values of `pose`, a function of the time in [0, 1].
template <typename T>
std::vector<T> make_motion(int steps, const std::function<T(float)>& pose)
{
    std::vector<T> result;
    for (int i = 1; i <= steps; ++i) {
        result.push_back(pose(static_cast<float>(i) / static_cast<float>(steps)));
    }
    return result;
}

inline Mat4 translation(Vec3 v)
{
    return glm::translate(Mat4(1.0f), v);
}

/// Makes the last instance of `builder` move.
inline void move_last(SceneBuilder& builder, int steps, const std::function<Mat4(float)>& pose)
{
    InstanceDesc& instance = builder.desc.instances.back();
    instance.world_from_object = pose(0.0f);
    instance.motion = make_motion<Mat4>(steps, pose);
}

/// Makes a mesh deform: `move` maps a point of its first pose to its position at a time. Normals
/// are unchanged.
inline void deform(MeshDesc& mesh, int steps, const std::function<Vec3(Vec3, float)>& move)
{
    const std::vector<Vec3> rest = mesh.positions;
    const auto moved = [&](float time) {
        std::vector<Vec3> positions;
        for (const Vec3& p : rest) {
            positions.push_back(move(p, time));
        }
        return positions;
    };
    mesh.positions = moved(0.0f);
    mesh.motion = make_motion<MeshPose>(
        steps, [&](float time) { return MeshPose{moved(time), mesh.normals, mesh.tangents}; });
}

/// Returns a scene with one of each: an emitter that moves, turns and grows, a mirrored sphere that
/// shares its mesh with one at rest, a mesh that deforms, and one that deforms, emits and moves.
inline SceneBuilder moving_stage()
{
    const Rgb white(0.7f);
    SceneBuilder builder;
    builder.walls(lambertian(white), lambertian({0.7f, 0.5f, 0.3f}));
    MeshDesc plate;
    plate.positions = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}};
    plate.triangles = {{0, 1, 2}, {0, 2, 3}};  // the front faces down
    builder.place(builder.add_mesh(plate), emitter(Rgb(4.0f, 3.5f, 3.0f)), Mat4(1.0f));
    move_last(builder, 6, [](float t) {
        return glm::scale(glm::rotate(translation({0.5f - t, 0.85f - 0.3f * t, -0.2f + 0.4f * t}),
                                      0.4f + 1.4f * t, Vec3(0.3f, 0.0f, 1.0f)),
                          Vec3(-0.25f - 0.3f * t, 1.0f, 0.5f));
    });
    const MeshId ball = builder.sphere_mesh(24);
    builder.place(ball, plastic({0.6f, 0.1f, 0.1f}, 0.4f),
                  glm::scale(translation({-0.55f, -0.65f, -0.3f}), Vec3(0.3f)));
    builder.place(ball, plastic({0.15f, 0.5f, 0.15f}, 0.5f), Mat4(1.0f));
    move_last(builder, 3, [](float t) {
        return glm::scale(glm::rotate(translation({0.7f - 0.8f * t, -0.5f, 0.1f}), 1.5f * t,
                                      Vec3(0.0f, 0.6f, 0.8f)),
                          Vec3(-0.3f, 0.45f, 0.2f + 0.2f * t));
    });
    MeshDesc flag = plate;
    flag.normals.assign(4, Vec3(0.0f, -1.0f, 0.0f));
    deform(flag, 4, [](Vec3 p, float t) {
        return Vec3(0.4f * p.x - 0.3f, 0.15f + 0.5f * t * p.x * p.z - 0.3f * t,
                    0.4f * p.z + 0.3f * std::sin(3.0f * t));
    });
    builder.place(builder.add_mesh(flag), lambertian(white), Mat4(1.0f));
    MeshDesc ember = plate;
    deform(ember, 2, [](Vec3 p, float t) {
        return Vec3(p.x * (0.1f + 0.2f * t), 0.2f * p.x * p.z * t, p.z * (0.4f - 0.3f * t));
    });
    MaterialDesc both = emitter(Rgb(1.0f, 2.0f, 4.0f));
    both.double_sided = true;
    builder.place(builder.add_mesh(ember), both, Mat4(1.0f));
    move_last(builder, 2, [](float t) {
        return glm::rotate(translation({-0.5f, -0.1f + 0.6f * t, 0.4f}), 0.8f * t,
                           Vec3(1.0f, 0.0f, 0.0f));
    });
    return builder;
}

/// Makes a camera that looks at the room move and turn.
inline CameraDesc moving(CameraDesc camera)
{
    const Mat4 rest = camera.world_from_camera;
    const auto pose = [&](float t) {
        return glm::rotate(translation({0.3f * t, 0.1f - 0.2f * t, 0.0f}) * rest, 0.15f * t,
                           Vec3(0.0f, 0.3f, 1.0f));
    };
    camera.world_from_camera = pose(0.0f);
    camera.motion = make_motion<Mat4>(3, pose);
    return camera;
}

}  // namespace bdpt::test
