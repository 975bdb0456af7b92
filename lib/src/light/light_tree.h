#pragma once

#include "light/light_samples.h"

#include <bdpt/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace bdpt {

/// All directions within an angle of an axis.
struct DirectionCone {
    Vec3 axis{0.0f, 0.0f, 1.0f};  ///< unit length
    float cos_angle = -1.0f;      ///< -1: all directions

    [[nodiscard]] bool is_whole() const { return cos_angle <= -1.0f; }
};

/// Returns a cone around both, the narrowest up to rounding [Conty Estevez and Kulla 2018,
/// "Importance Sampling of Many Lights with Adaptive Tree Splitting", sec. 4.1].
[[nodiscard]] DirectionCone merged(const DirectionCone& a, const DirectionCone& b);

enum class EmittingSides : std::uint8_t { front, both };

/// Position and direction bounds of one or several lights [Conty Estevez and Kulla 2018,
/// "Importance Sampling of Many Lights with Adaptive Tree Splitting", sec. 4.1]. Light leaves a
/// point of the box at an angle of at most `falloff` from a direction of the cone of normals.
struct LightBounds {
    Vec3 min{0.0f};  ///< bounding box [m]
    Vec3 max{0.0f};
    DirectionCone normals;     ///< cone of normals, or of axes of lights without surface
    float cos_falloff = 0.0f;  ///< cosine of the falloff angle; 0: a hemisphere, as surfaces emit
    EmittingSides sides = EmittingSides::front;  ///< `both`: also in opposite directions
    double intensity = 0.0;                      ///< sum of the maximum luminous intensities [cd]

    [[nodiscard]] Vec3 center() const { return 0.5f * min + 0.5f * max; }
    /// Extends the box to contain `p`.
    void contain(Vec3 p);
};

[[nodiscard]] LightBounds merged(const LightBounds& a, const LightBounds& b);

/// Returns the solid angle into which the lights emit [sr]: the measure M_Omega of sec. 4.4.
[[nodiscard]] float orientation_measure(const LightBounds& bounds);

/// Four groups of lights with their bounding spheres and directions, evaluated together on the way
/// down the tree. A structure of arrays, so that compilers vectorize it.
struct LightQuad {
    static constexpr std::size_t width = 4;
    template <typename T>
    using Four = std::array<T, width>;

    Four<float> x{};  ///< centre
    Four<float> y{};
    Four<float> z{};
    Four<float> radius{1.0f, 1.0f, 1.0f, 1.0f};  ///< > 0
    Four<float> axis_x{};
    Four<float> axis_y{};
    Four<float> axis_z{};
    Four<float> cos_spread{};  ///< cone of normals about the axis
    Four<float> sin_spread{};
    Four<float> cos_falloff{};
    Four<float> intensity{};      ///< fraction of the intensity of all lights; 0: unused
    Four<float> both_sides{};     ///< 1 if they also emit in opposite directions, else 0
    Four<std::uint32_t> group{};  ///< index of the child node, or `single` + index of a light

    static constexpr std::uint32_t single = 0x80000000U;

    /// Returns a rough estimate of the illuminance at the receiver by each group; greater than zero
    /// if any of its lights can illuminate the receiver [Conty Estevez and Kulla 2018, eq. 3].
    [[nodiscard]] Four<double> importance(const LightSampleContext& receiver) const noexcept;
};

/// Chooses one of many lights by estimated contribution to a point: a tree whose nodes bound their
/// lights, traversed from the root by one random number [Conty Estevez and Kulla 2018, "Importance
/// Sampling of Many Lights with Adaptive Tree Splitting", without splitting]. Nodes have many
/// children, for the bounds of small groups are tighter than those of large ones. The path from
/// each light to the root is stored, so its probability costs as much as choosing.
class LightTree {
public:
    struct Choice {
        std::uint32_t light = 0;
        float probability = 0.0f;
    };

    LightTree() = default;
    /// Builds a tree of less than 2^31 lights, whose intensity is finite and positive.
    explicit LightTree(std::span<const LightBounds> lights);

    [[nodiscard]] bool empty() const noexcept { return slots_.empty(); }
    /// Returns the number of lights.
    [[nodiscard]] std::size_t size() const noexcept { return slots_.size(); }

    /// Chooses a light. `u` in [0, 1). nullopt if the traversal finds that none of the lights
    /// illuminates the receiver.
    [[nodiscard]] std::optional<Choice> sample(const LightSampleContext& receiver,
                                               double u) const noexcept;
    /// Returns the probability of choosing `light`; positive if it can illuminate the receiver,
    /// unless its fraction of all light is too small for a float. The sum over all lights is 1
    /// minus the probability that `sample` returns nullopt.
    [[nodiscard]] float probability(std::uint32_t light,
                                    const LightSampleContext& receiver) const noexcept;

private:
    friend class LightTreeBuilder;

    static constexpr std::size_t max_children = 32;
    static constexpr std::uint32_t no_slot = 0xffffffffU;

    struct Node {
        std::uint32_t first_quad = 0;
        std::uint32_t quad_count = 0;
        std::uint32_t parent_slot = no_slot;  ///< slot in the parent: 4 * quad + lane
    };
    /// Importance of a node's children for a receiver.
    struct View {
        std::array<double, max_children> importance;
        double sum = 0.0;
    };
    [[nodiscard]] View look(const Node& node, const LightSampleContext& receiver) const noexcept;

    std::vector<Node> nodes_;  ///< root first
    std::vector<LightQuad> quads_;
    std::vector<std::uint32_t> owners_;  ///< node of each quad
    std::vector<std::uint32_t> slots_;   ///< slot of each light, as `parent_slot`
};

}  // namespace bdpt
