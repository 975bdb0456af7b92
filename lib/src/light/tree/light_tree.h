#pragma once

#include "light/light_sample_context.h"
#include "light/tree/light_bounds.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace bdpt {

/// Four groups of lights, each a sphere around them and where they shine: what one look of a walk
/// down the tree sees. Number by number, so that compilers look at all four at once.
struct LightQuad {
    static constexpr std::size_t width = 4;
    template <typename T>
    using Four = std::array<T, width>;

    Four<float> x{};  ///< of the centre
    Four<float> y{};
    Four<float> z{};
    Four<float> radius{1.0f, 1.0f, 1.0f, 1.0f};  ///< > 0
    Four<float> axis_x{};
    Four<float> axis_y{};
    Four<float> axis_z{};
    Four<float> cos_spread{};  ///< of the cone of normals about the axis
    Four<float> sin_spread{};
    Four<float> cos_falloff{};
    Four<float> intensity{};      ///< share of all lights; 0: nobody is here
    Four<float> both_sides{};     ///< 1 if they shine the other way round as well, else 0
    Four<std::uint32_t> group{};  ///< the node that it is, or for a single light `single` + light

    static constexpr std::uint32_t single = 0x80000000U;

    /// Roughly the illuminance at the receiver by each; greater than zero if any of its lights can
    /// shine there [Conty Estevez and Kulla 2018, eq. 3].
    [[nodiscard]] Four<double> importance(const LightSampleContext& receiver) const noexcept;
};

/// Chooses one of many lights by how much it may bring to a point: a tree whose nodes bound their
/// lights, walked from the root by one random number [Conty Estevez and Kulla 2018, "Importance
/// Sampling of Many Lights with Adaptive Tree Splitting", without splitting]. Nodes have many
/// children, for the bounds of small groups say more than those of large ones. The way up from each
/// light is known, so the probability of choosing it takes as long as choosing.
class LightTree {
public:
    struct Choice {
        std::uint32_t light = 0;
        float probability = 0.0f;
    };

    LightTree() = default;
    /// Of less than 2^31 lights, whose intensity is finite and positive.
    explicit LightTree(std::span<const LightBounds> lights);

    [[nodiscard]] bool empty() const noexcept { return slots_.empty(); }
    /// How many lights there are.
    [[nodiscard]] std::size_t size() const noexcept { return slots_.size(); }

    /// `u` in [0, 1). None where it turns out on the way that none of the lights shines there.
    [[nodiscard]] std::optional<Choice> sample(const LightSampleContext& receiver,
                                               double u) const noexcept;
    /// Of choosing `light`; positive if it can shine there, unless its share of all the light is
    /// too small for a float. The sum over all lights is 1 but for what `sample` ends with nothing.
    [[nodiscard]] float probability(std::uint32_t light,
                                    const LightSampleContext& receiver) const noexcept;

private:
    friend class LightTreeBuilder;

    static constexpr std::size_t max_children = 32;
    static constexpr std::size_t max_quads = max_children / LightQuad::width;
    static constexpr std::uint32_t no_slot = 0xffffffffU;

    struct Node {
        std::uint32_t first_quad = 0;
        std::uint32_t quad_count = 0;
        std::uint32_t parent_slot = no_slot;  ///< where its parent has it: 4 * quad + place
    };
    /// What a receiver sees of the children of a node.
    struct View {
        std::array<double, max_children> importance;
        double sum = 0.0;
    };
    [[nodiscard]] View look(const Node& node, const LightSampleContext& receiver) const noexcept;

    std::vector<Node> nodes_;  ///< the root first
    std::vector<LightQuad> quads_;
    std::vector<std::uint32_t> owners_;  ///< the node of each quad
    std::vector<std::uint32_t> slots_;   ///< where each light is, as `parent_slot`
};

}  // namespace bdpt
