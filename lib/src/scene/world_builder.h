#pragma once

#include "scene/world.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace bdpt {

/// Fills in a world whose description is set: everything that is done once, before the first ray.
class WorldBuilder {
public:
    explicit WorldBuilder(World& world) : world_(world) {}

    /// Throws `Error`: invalid_input, or what `EmbreeScene` throws.
    void build(Isa isa);

private:
    void add_materials();
    void place_meshes();
    void add_lights();
    void add_material(const MaterialDesc& desc, const Exterior& exterior);
    [[nodiscard]] Material make_material(const MaterialDesc& desc, const Exterior& exterior,
                                         MediumId within);
    [[nodiscard]] std::vector<MediumId> media_around(const std::vector<LightDesc>& lights) const;
    [[nodiscard]] const SpecularAlbedo& albedo_of(float ior);

    void find_enclosing_volumes();
    /// Those of bodies that light passes through.
    [[nodiscard]] std::vector<std::uint32_t> body_instances() const;
    void warn_of_open_volumes();
    /// `around`: for each instance the one that it lies within, if any.
    void give_surroundings(const std::vector<std::optional<std::uint32_t>>& around);

    World& world_;
};

}  // namespace bdpt
