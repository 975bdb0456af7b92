#pragma once

#include "light/light.h"
#include "math/alias_table.h"

#include <bdpt/scene_desc.h>

#include <optional>
#include <span>
#include <vector>

namespace bdpt {

/// The spheres that point and spot lights with a radius are, in their order; `lights` must outlive
/// them.
[[nodiscard]] std::vector<Sphere> light_spheres(std::span<const LightDesc> lights);

/// All lights of a scene and how one of them is chosen. Starting a light path and next-event
/// estimation are two choices with two densities: the first knows no receiver, the second does.
class LightSet {
public:
    struct Choice {
        LightId id{};
        float probability = 0.0f;
    };

    /// All arguments belong together and outlive this object: `placed[i]` is `instances[i]`.
    LightSet(std::span<const InstanceDesc> instances, std::span<const PlacedMesh> placed,
             std::span<const Material> materials, std::span<const LightDesc> lights,
             const BoundingSphere& bounds);

    [[nodiscard]] std::size_t size() const { return lights_.size(); }
    [[nodiscard]] const Light& operator[](LightId id) const
    {
        return lights_[static_cast<std::size_t>(id)];
    }

    /// In proportion to power; nothing when no light has any.
    [[nodiscard]] std::optional<Choice> choose_for_emission(Vec2 u) const;
    [[nodiscard]] float emission_probability(LightId id) const;

    [[nodiscard]] std::optional<Choice> choose_for_receiver(Vec3 receiver, Vec2 u) const;
    [[nodiscard]] float receiver_probability(LightId id, Vec3 receiver) const;

    /// The light that rays find which leave the scene.
    [[nodiscard]] std::optional<LightId> environment() const { return environment_; }
    /// The light that a triangle is, if it is one.
    [[nodiscard]] std::optional<LightId> of_triangle(std::uint32_t instance,
                                                     std::uint32_t triangle) const;
    /// The light that sphere `sphere` of `light_spheres` is.
    [[nodiscard]] LightId of_sphere(std::uint32_t sphere) const { return spheres_[sphere]; }

private:
    std::vector<Light> lights_;
    std::vector<std::optional<std::uint32_t>> first_of_instance_;
    std::vector<LightId> spheres_;
    std::optional<LightId> environment_;
    AliasTable by_power_;
};

}  // namespace bdpt
