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
    by_power_ = AliasTable(powers);
    if (by_power_.empty() || tree_.empty()) {
        placed_share_ = tree_.empty() ? 0.0 : 1.0;
        return;
    }
    placed_share_ = 0.25 + 0.5 * placed_power / (placed_power + by_power_.total());
}

std::optional<NextEventLights::Choice> NextEventLights::choose(const LightSampleContext& receiver,
                                                               double u) const noexcept
{
    constexpr double below_one = 1.0 - 0x1p-53;
    if (u < placed_share_) {
        const auto choice = tree_.sample(receiver, std::min(u / placed_share_, below_one));
        if (!choice) {
            return std::nullopt;
        }
        return Choice{.id = placed_[choice->light],
                      .probability = choice->probability * static_cast<float>(placed_share_)};
    }
    if (by_power_.empty()) {
        return std::nullopt;
    }
    const double rest = 1.0 - placed_share_;
    const auto choice = by_power_.sample(std::min((u - placed_share_) / rest, below_one));
    return Choice{.id = infinite_[choice.index],
                  .probability = choice.probability * static_cast<float>(rest)};
}

float NextEventLights::probability(LightId id, const LightSampleContext& receiver) const noexcept
{
    const Slot slot = slots_[static_cast<std::size_t>(id)];
    switch (slot.group) {
        case Slot::Group::placed:
            return tree_.probability(slot.number, receiver) * static_cast<float>(placed_share_);
        case Slot::Group::infinite:
            return by_power_.probability(slot.number) * static_cast<float>(1.0 - placed_share_);
        case Slot::Group::none:
            break;
    }
    return 0.0f;
}

}  // namespace bdpt
