#pragma once

#include <bdpt/export.h>
#include <bdpt/isa.h>
#include <bdpt/part/identity.h>
#include <bdpt/scene_desc.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace bdpt {

class World;

/// Axis-aligned box [m].
struct Bounds {
    Vec3 min{0.0f};
    Vec3 max{0.0f};
};

/// What a scene holds, for reports.
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
    explicit Scene(SceneDesc desc, Isa isa = Isa::native);
    Scene(Scene&&) noexcept;
    Scene& operator=(Scene&&) noexcept;
    ~Scene();

    /// Of all instances; both corners are zero in an empty scene.
    [[nodiscard]] Bounds bounds() const;
    [[nodiscard]] SceneCounts counts() const;
    /// What rays are traced with; never `native` on x86.
    [[nodiscard]] Isa isa() const;
    /// What is likely not meant, such as bodies that are not closed; one line each.
    [[nodiscard]] const std::vector<std::string>& warnings() const;

    /// What its bits depend on (bdpt/part/identity.h), the instruction set and Embree included.
    [[nodiscard]] const std::vector<IdentityComponent>& identity() const { return identity_; }

    /// For the library itself.
    [[nodiscard]] const World& world() const { return *world_; }

private:
    std::vector<IdentityComponent> identity_;
    std::unique_ptr<const World> world_;  // after the identity, as it takes the description
};

}  // namespace bdpt
