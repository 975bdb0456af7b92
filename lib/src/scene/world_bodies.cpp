#include "scene/open_edges.h"
#include "scene/world.h"

#include <algorithm>
#include <map>
#include <utility>

// The part of World that looks for bodies in bodies.

namespace bdpt {

/// Instances within a body get a material of their own, for what is around them is a fact of theirs
/// that does not change: no walk needs to remember where it has been.
void World::find_bodies()
{
    std::vector<std::uint32_t> instances;
    for (std::uint32_t i = 0; i < placed_.size(); ++i) {
        const Material& material = material_of(i);
        if (material.has_inside() && material.alpha_mode() == AlphaMode::opaque) {
            instances.push_back(i);
        }
    }
    warn_of_open_bodies();
    if (instances.size() > Bodies::most) {
        warnings_.push_back(std::to_string(instances.size()) +
                            " bodies that light passes through are too many to find out which of "
                            "them lies in which: all have air around them");
        return;
    }
    if (instances.empty()) {
        return;
    }
    bodies_ = std::make_unique<const Bodies>(placed_, std::move(instances), spheres_, *embree_);
    const std::vector<std::optional<std::uint32_t>> around = bodies_->around_all();
    std::map<std::pair<MaterialId, MaterialId>, MaterialId> nested;
    std::vector<MaterialId> result(placed_.size());
    for (std::size_t i = 0; i < placed_.size(); ++i) {
        const MaterialId own = desc_.instances[i].material;
        result[i] = own;
        if (!around[i]) {
            continue;
        }
        const MaterialId outer = desc_.instances[*around[i]].material;
        const MaterialDesc& desc = desc_.materials[static_cast<std::size_t>(own)];
        const Exterior exterior = exterior_within(desc_.materials[static_cast<std::size_t>(outer)]);
        if (exterior == Exterior{}) {
            continue;
        }
        const auto [known, is_new] =
            nested.try_emplace({own, outer}, static_cast<MaterialId>(materials_.size()));
        if (is_new) {
            materials_.push_back(make_material(desc, exterior));
        }
        result[i] = known->second;
    }
    for (std::size_t i = 0; i < result.size(); ++i) {
        desc_.instances[i].material = result[i];
    }
}

void World::warn_of_open_bodies()
{
    std::vector<bool> asked(desc_.meshes.size());
    for (const InstanceDesc& instance : desc_.instances) {
        const auto mesh = static_cast<std::size_t>(instance.mesh);
        const auto material = static_cast<std::size_t>(instance.material);
        if (asked[mesh] || !materials_[material].has_inside()) {
            continue;
        }
        asked[mesh] = true;
        if (const std::size_t open = count_open_edges(desc_.meshes[mesh])) {
            const std::string& name = desc_.meshes[mesh].name;
            warnings_.push_back("mesh " + std::to_string(mesh) +
                                (name.empty() ? "" : " \"" + name + "\"") + ": " +
                                std::to_string(open) + (open == 1 ? " edge is" : " edges are") +
                                " open, but its material has a thickness, which needs a closed "
                                "body: light may pass from its inside to its outside unrefracted");
        }
    }
}

}  // namespace bdpt
