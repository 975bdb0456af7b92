#include "scene/next_event_lights.h"

#include "math/rgb.h"

#include <algorithm>
#include <cmath>

namespace bdpt {

NextEventLights::NextEventLights(std::span<const Light> lights) : slots_(lights.size())
{
    std::vector<LightBounds> bounds;
    std::vector<float> powers;
    double placed_power = 0.0;
    const auto next = [](const std::vector<LightId>& group) {
        return static_cast<std::uint32_t>(group.size());
    };
    for (std::uint32_t id = 0; id < lights.size(); ++id) {
        const float power = luminance(lights[id].power());
        if (!(std::isfinite(power) && power > 0.0f)) {
            continue;
        }
        if (const auto placed = lights[id].bounds()) {
            slots_[id] = {Slot::Group::placed, next(placed_)};
            placed_.push_back(LightId{id});
            bounds.push_back(*placed);
            placed_power += static_cast<double>(power);
        } else {
            slots_[id] = {Slot::Group::infinite, next(infinite_)};
            infinite_.push_back(LightId{id});
            powers.push_back(power);
        }
    }
    tree_ = LightTree(bounds);
    share_out(powers, tree_.empty() ? 0.0 : placed_power);
}

void NextEventLights::share_out(std::span<const float> infinite_powers, double placed_power)
{
    const double groups =
        static_cast<double>(infinite_powers.size()) + (placed_power > 0.0 ? 1.0 : 0.0);
    double total = placed_power;
    for (const float power : infinite_powers) {
        total += static_cast<double>(power);
    }
    const auto share = [&](double power) { return 0.5 * power / total + 0.5 / groups; };
    std::vector<float> shares;
    for (const float power : infinite_powers) {
        shares.push_back(static_cast<float>(share(static_cast<double>(power))));
    }
    infinite_table_ = AliasTable(shares);
    if (shares.empty()) {
        placed_share_ = placed_power > 0.0 ? 1.0 : 0.0;
    } else {
        placed_share_ = placed_power > 0.0 ? share(placed_power) : 0.0;
    }
}

std::optional<NextEventLights::Choice> NextEventLights::choose(const LightSampleContext& receiver,
                                                               double u) const noexcept
{
    constexpr double below_one = 1.0 - 0x1p-53;
    if (u < placed_share_) {
        auto choice = choose_placed(receiver, std::min(u / placed_share_, below_one));
        if (choice) {
            choice->probability *= static_cast<float>(placed_share_);
        }
        return choice;
    }
    if (infinite_table_.empty()) {
        return std::nullopt;
    }
    const double rest = 1.0 - placed_share_;
    const auto choice = infinite_table_.sample(std::min((u - placed_share_) / rest, below_one));
    return Choice{.id = infinite_[choice.index],
                  .probability = choice.probability * static_cast<float>(rest)};
}

std::optional<NextEventLights::Choice> NextEventLights::choose(
    const LightSampleContext& receiver, double u, const GroupShares::Shares& shares) const noexcept
{
    constexpr double below_one = 1.0 - 0x1p-53;
    const std::size_t last = group_count() - 1;
    std::size_t group = 0;
    // The last group takes what rounding leaves.
    while (group < last && u >= static_cast<double>(shares[group])) {
        u -= static_cast<double>(shares[group++]);
    }
    const double within = std::min(u / static_cast<double>(shares[group]), below_one);
    auto choice = choose_of_group(group, receiver, within);
    if (choice) {
        choice->probability *= shares[group];
    }
    return choice;
}

std::optional<NextEventLights::Choice> NextEventLights::choose_placed(
    const LightSampleContext& receiver, double u) const noexcept
{
    const auto choice = tree_.sample(receiver, u);
    return choice ? std::optional(
                        Choice{.id = placed_[choice->light], .probability = choice->probability})
                  : std::nullopt;
}

float NextEventLights::probability(LightId id, const LightSampleContext& receiver) const noexcept
{
    const Slot slot = slots_[static_cast<std::size_t>(id)];
    switch (slot.group) {
        case Slot::Group::placed:
            return tree_.probability(slot.number, receiver) * static_cast<float>(placed_share_);
        case Slot::Group::infinite:
            return infinite_table_.probability(slot.number) *
                   static_cast<float>(1.0 - placed_share_);
        case Slot::Group::none:
            break;
    }
    return 0.0f;
}

float NextEventLights::probability(LightId id, const LightSampleContext& receiver,
                                   const GroupShares::Shares& shares) const noexcept
{
    const Slot slot = slots_[static_cast<std::size_t>(id)];
    switch (slot.group) {
        case Slot::Group::placed:
            return tree_.probability(slot.number, receiver) * shares[infinite_.size()];
        case Slot::Group::infinite:
            return shares[slot.number];
        case Slot::Group::none:
            break;
    }
    return 0.0f;
}

}  // namespace bdpt
