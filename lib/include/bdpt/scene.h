#pragma once

/// @file
/// Holds a scene that is ready to trace, and makes edited ones of it.
///
/// @code{.cpp}
/// const bdpt::Scene scene(bdpt::io::load_gltf("room.glb").scene);
/// for (const std::string& warning : scene.warnings()) {
///     std::cerr << warning << '\n';
/// }
/// bdpt::MaterialDesc wall = scene.description().materials[0];
/// wall.base_color = {0.2f, 0.3f, 0.8f, 1.0f};
/// const bdpt::Scene blue = scene.with(bdpt::MaterialId{0}, wall);
/// @endcode

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
    std::size_t triangles = 0;             ///< in meshes, counting each mesh once
    std::size_t instanced_triangles = 0;   ///< counting each instance of a mesh
    std::size_t degenerate_triangles = 0;  ///< without area: skipped
    std::size_t emissive_triangles = 0;
    std::size_t lights = 0;    ///< emissive triangles and all other lights
    std::size_t contacts = 0;  ///< pairs of instances that touch; one of each refracts or emits
    std::size_t bonds = 0;     ///< those of them that share a boundary (`ContactKind::bonded`)
};

/// A scene that is ready to trace: validated, with its Embree BVH built, immutable and safe to
/// share between threads. Copies share everything: a copy takes no time.
class BDPT_EXPORT Scene {
public:
    /// Throws `Error`: invalid_input if an index, a transform or a value in `desc` is invalid, and
    /// the message names the item and the value; usage if this CPU lacks `isa`; out_of_memory or
    /// internal if Embree fails.
    explicit Scene(SharedSceneDesc desc, Isa isa = Isa::native);

    /// Returns the description of the scene. Its lists are shared: a copy takes no time.
    [[nodiscard]] const SharedSceneDesc& description() const;
    /// Returns the scene of another description, traced with the same instruction set,
    /// bit-identical to a scene built from it. Unchanged parts are shared: no BVH is built where
    /// the triangles keep their positions, and lists that are those of `description()` are neither
    /// checked nor hashed. This scene is unchanged and may be destroyed. Throws like the
    /// constructor.
    [[nodiscard]] Scene edited(SharedSceneDesc desc) const;
    /// Returns the scene with one material, instance or list replaced. Also throws `Error`
    /// (invalid_input) if no item or more than one has that number or name.
    [[nodiscard]] Scene with(MaterialId id, MaterialDesc material) const;
    [[nodiscard]] Scene with(std::string_view name, MaterialDesc material) const;
    [[nodiscard]] Scene with(std::string_view name, InstanceDesc instance) const;
    [[nodiscard]] Scene with_lights(std::vector<LightDesc> lights) const;
    /// Replaces the environment, or adds one to the other lights; nullopt removes it.
    [[nodiscard]] Scene with_environment(std::optional<EnvironmentLightDesc> environment) const;

    /// Returns the bounds of all instances in the world; both corners are zero in an empty scene.
    [[nodiscard]] Bounds bounds() const;
    [[nodiscard]] SceneCounts counts() const;
    /// Returns the instruction set of ray tracing; never `native` on x86.
    [[nodiscard]] Isa isa() const;
    /// Returns likely mistakes in the scene, such as bodies that are not closed; one line each.
    [[nodiscard]] const std::vector<std::string>& warnings() const;

    /// Returns the identity of the scene (bdpt/part/identity.h): all inputs that its bits depend
    /// on, including the instruction set and Embree.
    [[nodiscard]] const std::vector<IdentityComponent>& identity() const;

    /// Returns the internal representation, for the library's own use.
    [[nodiscard]] const World& world() const;

private:
    struct State;
    explicit Scene(std::shared_ptr<const State> state);

    std::shared_ptr<const State> state_;
};

}  // namespace bdpt
