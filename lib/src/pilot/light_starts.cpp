#include "pilot/light_starts.h"

#include "scene/light_set.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt {
namespace {

/// Parts of the probability that the pilot does not determine, so that light paths also start at
/// lights whose light it missed: behind glass, or far away.
constexpr double power_part = 0.1;  // in proportion to power
constexpr double even_part = 0.1;   // equal for all groups of lights
/// Each light of a group counts as found so many more times, with values in proportion to power:
/// there may be more lights than the pilot has paths.
constexpr double prior_findings = 16.0;

/// Lights that next-event estimation treats as one: all with a position, or one at infinity.
struct Group {
    std::size_t lights = 0;
    double power = 0.0;  ///< probability by power
    double found = 0.0;
    std::size_t findings = 0;

    [[nodiscard]] double mean() const { return found / static_cast<double>(findings); }
};

}  // namespace

std::optional<AliasTable> learn_starts(std::span<const IndirectLight> found, const LightSet& lights)
{
    const NextEventLights& of_groups = lights.next_event_lights();
    std::vector<Group> groups(of_groups.group_count());
    std::vector<double> values(lights.size());
    double total = 0.0;
    for (const IndirectLight& finding : found) {
        const auto value = static_cast<double>(finding.value);
        Group& group = groups[of_groups.group(finding.light)];
        group.found += value;
        ++group.findings;
        values[static_cast<std::size_t>(finding.light)] += value;
        total += value;
    }
    if (!(total > 0.0)) {
        return std::nullopt;
    }
    for (std::uint32_t id = 0; id < lights.size(); ++id) {
        if (of_groups.has_power(LightId{id})) {
            Group& group = groups[of_groups.group(LightId{id})];
            ++group.lights;
            group.power += static_cast<double>(lights.emission_probability(LightId{id}));
        }
    }
    std::vector<float> probabilities(lights.size());
    for (std::uint32_t id = 0; id < lights.size(); ++id) {
        const auto power = static_cast<double>(lights.emission_probability(LightId{id}));
        if (!of_groups.has_power(LightId{id}) || !(power > 0.0)) {
            continue;
        }
        const Group& group = groups[of_groups.group(LightId{id})];
        const double by_power = power / group.power;
        double by_value = by_power;
        if (group.found > 0.0) {
            const double prior = prior_findings * static_cast<double>(group.lights) * group.mean();
            by_value = (values[id] + prior * by_power) / (group.found + prior);
        }
        const double of_group = (1.0 - power_part - even_part) * group.found / total +
                                even_part / static_cast<double>(groups.size());
        const double within = (1.0 - power_part) * by_value + power_part * by_power;
        probabilities[id] = static_cast<float>(of_group * within + power_part * power);
    }
    return AliasTable(probabilities);
}

}  // namespace bdpt
