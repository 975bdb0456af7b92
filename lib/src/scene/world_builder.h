#pragma once

#include "scene/world.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace bdpt {

/// Builds a world whose description is set: everything that happens once, before the first ray.
class WorldBuilder {
public:
    /// Reuses the unchanged parts of `like`, if it is not null.
    WorldBuilder(World& world, const World* like) : world_(world), like_(like) {}

    /// Throws `Error`: invalid_input, or errors of `EmbreeScene`.
    void build(Isa isa);

private:
    /// Tests whether `like_` shares this list of the description.
    template <typename T>
    [[nodiscard]] bool is_shared(SharedList<T> SharedSceneDesc::*list) const
    {
        return like_ != nullptr && (world_.desc_.*list).is_shared_with(like_->desc_.*list);
    }
    void build_trees(Isa isa);

    void add_materials();
    [[nodiscard]] bool is_known(std::size_t material) const;
    void add_material(std::size_t number, const Exterior& exterior);
    [[nodiscard]] Material make_material(const MaterialDesc& desc, const ChannelAlbedos& albedos,
                                         const Exterior& exterior, MediumId within);
    [[nodiscard]] ChannelAlbedos find_albedos(const MaterialDesc& desc, const Exterior& exterior);
    [[nodiscard]] const SpecularAlbedo& find_albedo(float ior);

    void add_lights();
    [[nodiscard]] bool emission_stays() const;
    [[nodiscard]] std::vector<MediumId> media_around(const SharedList<LightDesc>& lights) const;

    void find_enclosing_volumes();
    /// Returns the instances of transparent bodies.
    [[nodiscard]] std::vector<std::uint32_t> body_instances() const;
    [[nodiscard]] std::shared_ptr<const World::Bodies> find_bodies(
        std::vector<std::uint32_t> instances) const;
    void warn_of_open_volumes();
    /// Adds materials by their surroundings. `around` holds for each instance the one that contains
    /// it, if any.
    void give_surroundings(const std::vector<std::optional<std::uint32_t>>& around);
    /// Adds materials for triangles whose outside is a body that is bonded to theirs.
    void give_bonds();
    /// Returns the material `own` with the inside of `outer` around it; adds it if it is new.
    [[nodiscard]] MaterialId material_within(MaterialId own, MaterialId outer);
    /// Tells the media how large the bodies are that they fill; after materials know their
    /// surroundings.
    void measure_bodies();

    World& world_;
    std::map<std::pair<MaterialId, MaterialId>, MaterialId> within_;  // by `own` and `outer`
    const World* like_;
    std::shared_ptr<SceneGeometry> own_geometry_;  // null if the geometry is that of `like_`
    std::vector<bool> is_known_desc_;              // by material description: unchanged since
                                                   // `like_`
    std::vector<bool> is_kept_;                    // by material: unchanged, with the same index
};

}  // namespace bdpt
