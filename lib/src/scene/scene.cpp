#include <bdpt/scene.h>

#include "scene/world.h"

#include <utility>

namespace bdpt {

Scene::Scene(SceneDesc desc) : world_(std::make_unique<const World>(std::move(desc))) {}
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

}  // namespace bdpt
