#include <bdpt/shared_scene_desc.h>

namespace bdpt {

static_assert(std::tuple_size_v<decltype(SharedSceneDesc().members())> ==
              std::tuple_size_v<std::remove_cv_t<decltype(fields<SceneDesc>)>>);

SharedSceneDesc::SharedSceneDesc(SceneDesc desc)
    : images(std::move(desc.images)),
      materials(std::move(desc.materials)),
      meshes(std::move(desc.meshes)),
      instances(std::move(desc.instances)),
      profiles(std::move(desc.profiles)),
      lights(std::move(desc.lights)),
      texture_filter(desc.texture_filter),
      contacts(desc.contacts),
      fog(desc.fog),
      volumes(std::move(desc.volumes)),
      origin(desc.origin)
{}

SceneDesc SharedSceneDesc::copy() const
{
    return {.images = images,
            .materials = materials,
            .meshes = meshes,
            .instances = instances,
            .profiles = profiles,
            .lights = lights,
            .texture_filter = texture_filter,
            .contacts = contacts,
            .fog = fog,
            .volumes = volumes,
            .origin = origin};
}

}  // namespace bdpt
