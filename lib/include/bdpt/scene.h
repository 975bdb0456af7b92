#pragma once

#include <bdpt/export.h>
#include <bdpt/isa.h>
#include <bdpt/part/identity.h>
#include <bdpt/shared_scene_desc.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bdpt {

class World;

/// Axis-aligned box [m].
struct Bounds {
    Vec3 min{0.0f};
    Vec3 max{0.0f};
};

/// The counts of a scene, for reports.
struct SceneCounts {
    std::size_t triangles = 0;             ///< in meshes, each mesh once
    std::size_t instanced_triangles = 0;   ///< as rays see them
    std::size_t degenerate_triangles = 0;  ///< without area: skipped
    std::size_t emissive_triangles = 0;
    std::size_t lights = 0;  ///< emissive triangles and all others
};

/// A scene that is ready to trace: validated, its Embree BVH built, immutable and safe to share
/// between threads.
class BDPT_EXPORT Scene {
public:
    /// Throws `Error`: invalid_input when an index, a transform or a value in `desc` is invalid,
    /// and the message names the item and the value; usage when this CPU lacks `isa`; out_of_memory
    /// or internal when Embree fails.
    explicit Scene(SharedSceneDesc desc, Isa isa = Isa::native);
    Scene(Scene&&) noexcept;
    Scene& operator=(Scene&&) noexcept;
    ~Scene();

    /// The description of the scene. Its lists are shared: a copy takes no time.
    [[nodiscard]] const SharedSceneDesc& description() const;
    /// The scene of another description, traced with the same instruction set, as if built from it:
    /// the same bits. What stays the same is shared: where triangles keep their places no tree is
    /// built, and where lists are those of `description()` nothing is checked or hashed. This scene
    /// stays as it is, and may go. Throws as a new one.
    [[nodiscard]] Scene edited(SharedSceneDesc desc) const;
    /// The same with one material, instance or list in place of another. Throws `Error`
    /// (invalid_input), too, when nothing or more than one thing has that number or name.
    [[nodiscard]] Scene with(MaterialId id, MaterialDesc material) const;
    [[nodiscard]] Scene with(std::string_view name, MaterialDesc material) const;
    [[nodiscard]] Scene with(std::string_view name, InstanceDesc instance) const;
    [[nodiscard]] Scene with_lights(std::vector<LightDesc> lights) const;
    /// Instead of the one that there is, or besides all other lights; none: without one.
    [[nodiscard]] Scene with_environment(std::optional<EnvironmentLightDesc> environment) const;

    /// The bounds of all instances; both corners are zero in an empty scene.
    [[nodiscard]] Bounds bounds() const;
    [[nodiscard]] SceneCounts counts() const;
    /// The instruction set for tracing rays; never `native` on x86.
    [[nodiscard]] Isa isa() const;
    /// Likely mistakes in the scene, such as bodies that are not closed; one line each.
    [[nodiscard]] const std::vector<std::string>& warnings() const;

    /// The identity of the scene (bdpt/part/identity.h): all inputs that its bits depend on, the
    /// instruction set and Embree included.
    [[nodiscard]] const std::vector<IdentityComponent>& identity() const;

    /// For the library itself.
    [[nodiscard]] const World& world() const;

private:
    struct State;
    explicit Scene(std::unique_ptr<const State> state);

    std::unique_ptr<const State> state_;
};

}  // namespace bdpt
