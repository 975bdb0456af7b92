#include <bdpt/scene.h>

#include "identity/scene_identity.h"
#include "scene/world.h"

#include <utility>

namespace bdpt {

Scene::Scene(SceneDesc desc, Isa isa)
    : identity_(identity_components(desc)),
      world_(std::make_unique<const World>(std::move(desc), isa))
{
    identity_.push_back({.name = "build: instruction set", .value = isa_name(world_->isa())});
    identity_.push_back({.name = "build: Embree", .value = world_->embree_version()});
}
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

Bounds Scene::bounds() const
{
    return world_->bounds();
}

SceneCounts Scene::counts() const
{
    return world_->counts();
}

const std::vector<std::string>& Scene::warnings() const
{
    return world_->warnings();
}

Isa Scene::isa() const
{
    return world_->isa();
}

}  // namespace bdpt
