#pragma once

#include "light/learned/learned_light.h"
#include "light/light.h"
#include "light/light_tree.h"
#include "math/distributions.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace bdpt {

/// Chooses a light for a receiver: lights with a position by a tree, or one of those at infinity.
/// Among the tree and these, half of the probability is proportional to power and half is uniform,
/// for none of them is known to be hidden from the receiver.
class NextEventLights {
public:
    struct Choice {
        LightId id{};
        float probability = 0.0f;
    };

    NextEventLights() = default;
    explicit NextEventLights(std::span<const Light> lights);

    /// Chooses a light. `u` in [0, 1). nullopt if no light can illuminate the receiver.
    [[nodiscard]] std::optional<Choice> choose(const LightSampleContext& receiver,
                                               double u) const noexcept;
    /// Chooses among the lights with a position only.
    [[nodiscard]] std::optional<Choice> choose_placed(const LightSampleContext& receiver,
                                                      double u) const noexcept;
    [[nodiscard]] float probability(LightId id, const LightSampleContext& receiver) const noexcept;

    // Group g is the g-th light at infinity; the last group holds the placed lights, if there are
    // any.

    [[nodiscard]] std::size_t group_count() const noexcept
    {
        return infinite_.size() + (placed_.empty() ? 0U : 1U);
    }
    /// Tests whether the light is in a group.
    [[nodiscard]] bool has_power(LightId id) const noexcept
    {
        return slots_[static_cast<std::size_t>(id)].group != Slot::Group::none;
    }
    /// Returns the group of a light that has power.
    [[nodiscard]] std::size_t group(LightId id) const noexcept
    {
        const Slot slot = slots_[static_cast<std::size_t>(id)];
        return slot.group == Slot::Group::infinite ? slot.number : infinite_.size();
    }
    /// Chooses within a group.
    [[nodiscard]] std::optional<Choice> choose_of_group(std::size_t group,
                                                        const LightSampleContext& receiver,
                                                        double u) const noexcept
    {
        return group < infinite_.size() ? std::optional(Choice{infinite_[group], 1.0f})
                                        : choose_placed(receiver, u);
    }
    /// Overloads with these shares of the groups.
    [[nodiscard]] std::optional<Choice> choose(const LightSampleContext& receiver, double u,
                                               const GroupShares::Shares& shares) const noexcept;
    [[nodiscard]] float probability(LightId id, const LightSampleContext& receiver,
                                    const GroupShares::Shares& shares) const noexcept;

    /// Returns the lights at infinity that have power.
    [[nodiscard]] std::span<const LightId> infinite() const noexcept { return infinite_; }
    /// Returns the number of placed lights that have power.
    [[nodiscard]] std::size_t placed_count() const noexcept { return placed_.size(); }
    /// Tests whether there are both lights with a position and lights at infinity.
    [[nodiscard]] bool has_both_kinds() const noexcept
    {
        return !placed_.empty() && !infinite_.empty();
    }

private:
    /// Location of a light: its index within its group.
    struct Slot {
        enum class Group : std::uint8_t { none, placed, infinite };
        Group group = Group::none;
        std::uint32_t number = 0;
    };

    /// Sets the probabilities of the tree and of each light at infinity.
    void share_out(std::span<const float> infinite_powers, double placed_power);

    std::vector<Slot> slots_;  ///< one per light
    LightTree tree_;
    std::vector<LightId> placed_;    ///< ids of the tree's indices
    std::vector<LightId> infinite_;  ///< ids of the table's indices
    AliasTable infinite_table_;      ///< chooses a light at infinity, if the tree is not chosen
    double placed_share_ = 0.0;      ///< probability of the tree
};

}  // namespace bdpt
