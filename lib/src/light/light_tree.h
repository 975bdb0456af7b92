#pragma once

#include "light/light_bounds.h"
#include "light/light_receiver.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace bdpt {

/// A sphere around some lights and where they shine: what one step down the tree looks at.
struct LightTreeNode {
    Vec3 center{0.0f};
    float radius_squared = 0.0f;  ///< > 0
    Vec3 axis{0.0f};
    float cos_spread = -1.0f;  ///< of the cone of normals about the axis
    float sin_spread = 0.0f;
    float cos_falloff = 0.0f;
    float intensity = 0.0f;  ///< share of all lights
    EmittingSides sides = EmittingSides::front;
    bool is_leaf = false;
    std::uint32_t content = 0;  ///< first of two children, or the light

    /// Roughly the illuminance at the receiver; greater than zero if any of the lights can shine
    /// there [Conty Estevez and Kulla 2018, eq. 3].
    [[nodiscard]] double importance(const LightReceiver& receiver) const noexcept;
};

/// Chooses one of many lights by how much it may bring to a point: a binary tree whose nodes bound
/// their lights, walked from the root by one random number [Conty Estevez and Kulla 2018,
/// "Importance Sampling of Many Lights with Adaptive Tree Splitting", without splitting]. The way
/// to each light is kept, so the probability of choosing it takes as long as choosing.
class LightTree {
public:
    struct Choice {
        std::uint32_t light = 0;
        float probability = 0.0f;
    };

    LightTree() = default;
    /// Of lights whose intensity is finite and positive.
    explicit LightTree(std::span<const LightBounds> lights);

    [[nodiscard]] bool empty() const noexcept { return nodes_.empty(); }
    /// How many lights there are.
    [[nodiscard]] std::size_t size() const noexcept { return trails_.size(); }

    /// `u` in [0, 1). None where it turns out on the way that none of the lights shines there.
    [[nodiscard]] std::optional<Choice> sample(const LightReceiver& receiver,
                                               double u) const noexcept;
    /// Of choosing `light`; positive if it can shine there, unless its share of all the light is
    /// too small for a float. The sum over all lights is 1 but for what `sample` ends with nothing.
    [[nodiscard]] float probability(std::uint32_t light,
                                    const LightReceiver& receiver) const noexcept;

private:
    friend class LightTreeBuilder;

    std::vector<LightTreeNode> nodes_;  ///< the root first; children are neighbours
    /// For each light which child leads to it, the root's in the lowest bit: 1 is the second.
    std::vector<std::uint64_t> trails_;
};

}  // namespace bdpt
