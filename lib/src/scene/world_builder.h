#pragma once

#include "scene/world.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace bdpt {

/// Fills in a world whose description is set: everything that is done once, before the first ray.
class WorldBuilder {
public:
    /// `like`, if any, is a world from which all is taken over that stays the same.
    WorldBuilder(World& world, const World* like) : world_(world), like_(like) {}

    /// Throws `Error`: invalid_input, or what `EmbreeScene` throws.
    void build(Isa isa);

private:
    /// Is a list that of the world that it is like?
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
    [[nodiscard]] ChannelAlbedos albedos_of(const MaterialDesc& desc, const Exterior& exterior);
    void make_albedos(const Exterior& exterior);
    [[nodiscard]] std::shared_ptr<const SpecularAlbedo> known_albedo(
        const World::AlbedoKey& key) const;
    [[nodiscard]] const SpecularAlbedo& albedo_of(const World::AlbedoKey& key);

    void add_lights();
    [[nodiscard]] bool emission_stays() const;
    [[nodiscard]] std::vector<MediumId> media_around(const SharedList<LightDesc>& lights) const;

    void find_enclosing_volumes();
    /// Those of bodies that light passes through.
    [[nodiscard]] std::vector<std::uint32_t> body_instances() const;
    [[nodiscard]] std::shared_ptr<const World::Bodies> bodies_of(
        std::vector<std::uint32_t> instances) const;
    void warn_of_open_volumes();
    /// `around`: for each instance the one that it lies within, if any.
    void give_surroundings(const std::vector<std::optional<std::uint32_t>>& around);

    World& world_;
    const World* like_;
    std::shared_ptr<SceneGeometry> own_geometry_;  // null as long as it is that of `like_`
    std::vector<bool> is_known_desc_;              // descriptions of materials: as in `like_`
    std::vector<bool> is_kept_;                    // materials: with the same number
};

}  // namespace bdpt
