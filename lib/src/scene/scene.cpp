#include <bdpt/scene.h>

#include "identity/scene_identity.h"
#include "scene/checks/value_checks.h"
#include "scene/world.h"

#include <bdpt/shared_scene_desc.h>

#include <algorithm>
#include <utility>
#include <variant>

namespace bdpt {
namespace {

/// Returns the index of the only item with that name; `kind` is for messages.
template <typename T>
std::size_t find_index(const SharedList<T>& list, std::string_view kind, std::string_view name)
{
    const auto has_name = [name](const T& item) { return item.name == name; };
    const auto count = std::count_if(list.begin(), list.end(), has_name);
    if (count != 1) {
        fail("the scene has ", count, " ", kind, "s with the name \"", name, "\", not one");
    }
    return static_cast<std::size_t>(std::find_if(list.begin(), list.end(), has_name) -
                                    list.begin());
}

template <typename T>
SharedList<T> replaced(const SharedList<T>& list, std::size_t number, T item)
{
    std::vector<T> values = list;
    values[number] = std::move(item);
    return values;
}

}  // namespace

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

// Hidden, or the shared library would export the type of its shared pointer.
struct [[gnu::visibility("hidden")]] Scene::State
{
    State(SharedSceneDesc desc, Isa isa)
        : components(scene_components(desc, {}, {})), world(std::move(desc), isa)
    {
        finish();
    }
    State(SharedSceneDesc desc, const State& like)
        : components(scene_components(desc, like.world.description(), like.components)),
          world(std::move(desc), like.world)
    {
        finish();
    }
    void finish()
    {
        identity = joined(components);
        identity.push_back({.name = "build: instruction set", .value = isa_name(world.isa())});
        identity.push_back({.name = "build: Embree", .value = world.embree_version()});
    }

    SceneComponents components;
    World world;
    std::vector<IdentityComponent> identity;
};

Scene::Scene(SharedSceneDesc desc, Isa isa)
    : state_(std::make_shared<const State>(std::move(desc), isa))
{}
Scene::Scene(std::shared_ptr<const State> state) : state_(std::move(state)) {}

const SharedSceneDesc& Scene::description() const
{
    return state_->world.description();
}

Scene Scene::edited(SharedSceneDesc desc) const
{
    return Scene(std::make_shared<const State>(std::move(desc), *state_));
}

Scene Scene::with(MaterialId id, MaterialDesc material) const
{
    SharedSceneDesc desc = description();
    const auto number = static_cast<std::size_t>(id);
    if (number >= desc.materials.size()) {
        fail("material ", number, ", but the number of materials is ", desc.materials.size());
    }
    desc.materials = replaced(desc.materials, number, std::move(material));
    return edited(std::move(desc));
}

Scene Scene::with(std::string_view name, MaterialDesc material) const
{
    const std::size_t number = find_index(description().materials, "material", name);
    return with(static_cast<MaterialId>(number), std::move(material));
}

Scene Scene::with(std::string_view name, InstanceDesc instance) const
{
    SharedSceneDesc desc = description();
    const std::size_t number = find_index(desc.instances, "instance", name);
    desc.instances = replaced(desc.instances, number, std::move(instance));
    return edited(std::move(desc));
}

Scene Scene::with_lights(std::vector<LightDesc> lights) const
{
    SharedSceneDesc desc = description();
    desc.lights = std::move(lights);
    return edited(std::move(desc));
}

Scene Scene::with_environment(std::optional<EnvironmentLightDesc> environment) const
{
    const auto is_environment = [](const LightDesc& light) {
        return std::holds_alternative<EnvironmentLightDesc>(light);
    };
    std::vector<LightDesc> lights = description().lights;
    const auto old = std::find_if(lights.begin(), lights.end(), is_environment);
    if (environment && old != lights.end()) {
        *old = *std::move(environment);
    } else if (environment) {
        lights.emplace_back(*std::move(environment));
    } else if (old != lights.end()) {
        lights.erase(old);
    }
    return with_lights(std::move(lights));
}

const std::vector<IdentityComponent>& Scene::identity() const
{
    return state_->identity;
}

const World& Scene::world() const
{
    return state_->world;
}

Bounds Scene::bounds() const
{
    return state_->world.bounds();
}

SceneCounts Scene::counts() const
{
    return state_->world.counts();
}

const std::vector<std::string>& Scene::warnings() const
{
    return state_->world.warnings();
}

Isa Scene::isa() const
{
    return state_->world.isa();
}

}  // namespace bdpt
