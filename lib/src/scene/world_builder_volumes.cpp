#include "scene/checks/value_checks.h"
#include "scene/world_builder.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

// The part of WorldBuilder that finds nested bodies and measures those that scatter light.

namespace bdpt {

std::vector<std::uint32_t> WorldBuilder::body_instances() const
{
    std::vector<std::uint32_t> instances;
    for (std::uint32_t i = 0; i < world_.placed_.size(); ++i) {
        const Material& material = world_.find_material(i);
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
                              " transmissive bodies are too many to find out which of them are "
                              "nested: all are treated as surrounded by air");
    } else if (!instances.empty()) {
        w.bodies_ = find_bodies(std::move(instances));
        give_surroundings(w.bodies_->around);
    }
}

/// Returns the bodies of `like_`, if they are the same and no ray passes surfaces at random.
std::shared_ptr<const World::Bodies> WorldBuilder::find_bodies(
    std::vector<std::uint32_t> instances) const
{
    const World& w = world_;
    const std::vector<bool>& filtered = w.embree_->filtered();
    const bool stays = like_ != nullptr && like_->bodies_ && w.geometry_ == like_->geometry_ &&
                       like_->bodies_->instances == instances &&
                       std::find(filtered.begin(), filtered.end(), true) == filtered.end();
    if (stays) {
        return like_->bodies_;
    }
    const auto bodies = std::make_shared<World::Bodies>();
    bodies->instances = instances;
    bodies->volumes.emplace(w.placed_, std::move(instances), w.geometry_->spheres, *w.embree_,
                            w.geometry_->contacts.bonds);
    bodies->around = bodies->volumes->around_all();
    return bodies;
}

/// Instances within a body get a material of their own, as their surroundings are constant: no walk
/// needs to keep track of enclosing bodies.
void WorldBuilder::give_surroundings(const std::vector<std::optional<std::uint32_t>>& around)
{
    const SharedList<InstanceDesc>& instances = world_.desc_.instances;
    for (std::size_t i = 0; i < around.size(); ++i) {
        if (around[i]) {
            world_.material_ids_[i] =
                material_within(instances[i].material, instances[*around[i]].material);
        }
    }
}

void WorldBuilder::give_bonds()
{
    const SharedList<InstanceDesc>& instances = world_.desc_.instances;
    for (const Bond& bond : world_.geometry_->contacts.bonds) {
        world_.bond_materials_.push_back(
            material_within(instances[bond.instance].material, instances[bond.partner].material));
    }
}

MaterialId WorldBuilder::material_within(MaterialId own, MaterialId outer)
{
    const auto number = static_cast<std::size_t>(outer);
    const Exterior exterior =
        exterior_within(world_.desc_.materials[number], world_.material_sources_[number].within);
    if (exterior == Exterior{.medium = world_.fog_}) {
        return own;
    }
    const auto [known, is_new] =
        within_.try_emplace({own, outer}, static_cast<MaterialId>(world_.materials_.size()));
    if (is_new) {
        add_material(static_cast<std::size_t>(own), exterior);
    }
    return known->second;
}

void WorldBuilder::measure_bodies()
{
    World& w = world_;
    if (!w.media_.any_scatters()) {
        return;
    }
    for (std::size_t i = 0; i < w.desc_.instances.size(); ++i) {
        const auto material = static_cast<std::size_t>(w.material_ids_[i]);
        const MediumId within = w.material_sources_[material].within;
        const InstanceDesc& instance = w.desc_.instances[i];
        const auto& box = w.geometry_->boxes[static_cast<std::size_t>(instance.mesh)];
        if (!w.media_[within].scatters() || !box) {
            continue;
        }
        const auto edge = [&](int axis) {
            return 2.0f * length(Vec3(instance.world_from_object[axis])) * box->half[axis];
        };
        const float faces = edge(0) * edge(1) + edge(1) * edge(2) + edge(2) * edge(0);
        // The mean chord of a convex body is 4 V / S; that of its bounding box stands for it.
        w.media_.fill_body(within,
                           faces > 0.0f ? 2.0f * edge(0) * edge(1) * edge(2) / faces : 0.0f);
    }
}

void WorldBuilder::warn_of_open_volumes()
{
    const SharedSceneDesc& desc = world_.desc_;
    std::vector<bool> asked(desc.meshes.size());
    for (const InstanceDesc& instance : desc.instances) {
        const auto mesh = static_cast<std::size_t>(instance.mesh);
        const auto material = static_cast<std::size_t>(instance.material);
        if (asked[mesh] || !world_.materials_[material].has_inside()) {
            continue;
        }
        asked[mesh] = true;
        const ShellTable& known = world_.geometry_->shells;
        const auto shells = known.find(mesh);  // none if an edit made this a body
        const std::size_t open = shells != known.end() ? shells->second->open_edges
                                                       : find_shells(desc.meshes[mesh]).open_edges;
        if (open > 0) {
            world_.warnings_.push_back(
                label("mesh", mesh, desc.meshes[mesh].name) + ": " + std::to_string(open) +
                (open == 1 ? " edge is" : " edges are") +
                " open, but its material has a thickness, which needs a closed mesh: light may "
                "leave it without refraction");
        }
    }
}

}  // namespace bdpt
