#pragma once

#include "light/light.h"
#include "light/tree/light_tree.h"
#include "math/alias_table.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace bdpt {

/// One of all lights, for a receiver: those at a place by a tree, and beside it each one at
/// infinity. Between these, half of the choice is by power and half is even, for none of them can
/// be told to be hidden from the receiver.
class NextEventLights {
public:
    struct Choice {
        LightId id{};
        float probability = 0.0f;
    };

    NextEventLights() = default;
    explicit NextEventLights(std::span<const Light> lights);

    /// `u` in [0, 1). Nothing where no light can shine.
    [[nodiscard]] std::optional<Choice> choose(const LightSampleContext& receiver,
                                               double u) const noexcept;
    /// The same of those at a place alone.
    [[nodiscard]] std::optional<Choice> choose_placed(const LightSampleContext& receiver,
                                                      double u) const noexcept;
    [[nodiscard]] float probability(LightId id, const LightSampleContext& receiver) const noexcept;

    /// Lights that have a place and power.
    [[nodiscard]] std::size_t placed_count() const noexcept { return placed_.size(); }
    /// Are there lights at infinity beside them?
    [[nodiscard]] bool has_both_kinds() const noexcept
    {
        return !placed_.empty() && !infinite_.empty();
    }

private:
    /// Where a light is found: its number among those of its group.
    struct Slot {
        enum class Group : std::uint8_t { none, placed, infinite };
        Group group = Group::none;
        std::uint32_t number = 0;
    };

    /// Sets the probabilities of the tree and of each light at infinity.
    void share_out(std::span<const float> infinite_powers, double placed_power);

    std::vector<Slot> slots_;  ///< of each light
    LightTree tree_;
    std::vector<LightId> placed_;    ///< of the tree's numbers
    std::vector<LightId> infinite_;  ///< of the table's numbers
    AliasTable infinite_table_;      ///< one of those, if it is not the tree
    double placed_share_ = 0.0;      ///< probability of the tree
};

}  // namespace bdpt
