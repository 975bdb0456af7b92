#include "scene/checks/value_checks.h"
#include "scene/open_edges.h"
#include "scene/world_builder.h"

#include <map>
#include <string>
#include <utility>

// The part of WorldBuilder that looks for bodies in bodies.

namespace bdpt {

std::vector<std::uint32_t> WorldBuilder::body_instances() const
{
    std::vector<std::uint32_t> instances;
    for (std::uint32_t i = 0; i < world_.placed_.size(); ++i) {
        const Material& material = world_.material_of(i);
        if (material.has_inside() && material.alpha_mode() == AlphaMode::opaque) {
            instances.push_back(i);
        }
    }
    return instances;
}

void WorldBuilder::find_enclosing_volumes()
{
    World& w = world_;
    warn_of_open_volumes();
    std::vector<std::uint32_t> instances = body_instances();
    if (instances.size() > EnclosingVolumes::most) {
        w.warnings_.push_back(std::to_string(instances.size()) +
                              " bodies that light passes through are too many to find out which of "
                              "them lies in which: all have air around them");
    } else if (!instances.empty()) {
        w.bodies_ = std::make_unique<const EnclosingVolumes>(w.placed_, std::move(instances),
                                                             w.spheres_, *w.embree_);
        give_surroundings(w.bodies_->around_all());
    }
}

/// Instances within a body get a material of their own, for what is around them is a fact of theirs
/// that does not change: no walk needs to remember where it has been.
void WorldBuilder::give_surroundings(const std::vector<std::optional<std::uint32_t>>& around)
{
    SceneDesc& scene = world_.desc_;
    std::map<std::pair<MaterialId, MaterialId>, MaterialId> nested;
    std::vector<MaterialId> result(around.size());
    for (std::size_t i = 0; i < around.size(); ++i) {
        const MaterialId own = scene.instances[i].material;
        result[i] = own;
        if (!around[i]) {
            continue;
        }
        const MaterialId outer = scene.instances[*around[i]].material;
        const MaterialDesc& desc = scene.materials[static_cast<std::size_t>(own)];
        const auto number = static_cast<std::size_t>(outer);
        const Exterior exterior = exterior_within(scene.materials[number], world_.within_[number]);
        if (exterior == Exterior{.medium = world_.fog_}) {
            continue;
        }
        const auto [known, is_new] =
            nested.try_emplace({own, outer}, static_cast<MaterialId>(world_.materials_.size()));
        if (is_new) {
            add_material(desc, exterior);
        }
        result[i] = known->second;
    }
    for (std::size_t i = 0; i < result.size(); ++i) {
        scene.instances[i].material = result[i];
    }
}

void WorldBuilder::warn_of_open_volumes()
{
    const SceneDesc& desc = world_.desc_;
    std::vector<bool> asked(desc.meshes.size());
    for (const InstanceDesc& instance : desc.instances) {
        const auto mesh = static_cast<std::size_t>(instance.mesh);
        const auto material = static_cast<std::size_t>(instance.material);
        if (asked[mesh] || !world_.materials_[material].has_inside()) {
            continue;
        }
        asked[mesh] = true;
        if (const std::size_t open = count_open_edges(desc.meshes[mesh])) {
            world_.warnings_.push_back(
                label("mesh", mesh, desc.meshes[mesh].name) + ": " + std::to_string(open) +
                (open == 1 ? " edge is" : " edges are") +
                " open, but its material has a thickness, which needs a closed "
                "body: light may pass from its inside to its outside unrefracted");
        }
    }
}

}  // namespace bdpt
