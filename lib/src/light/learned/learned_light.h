#pragma once

#include "light/environment/environment_visibility.h"
#include "light/learned/entries.h"
#include "light/learned/group_shares.h"
#include "light/light_samples.h"
#include "math/distributions.h"

#include <optional>
#include <vector>

namespace bdpt {

/// Where the parallel light of a sun enters the scene.
struct SunEntries {
    LightId sun{};
    EntryWindow window;
};

/// The directions and lights from which light arrives, by position, as learned by a pilot.
/// Light sampling follows them; they cannot bias an image, whatever they say.
struct LearnedLight {
    /// Visibility of the environment; nullopt if it is equally visible everywhere, or nowhere.
    std::optional<EnvironmentVisibility> visibility{};
    /// Shares of groups of lights; nullopt if there is only one group, or no light was found.
    std::optional<GroupShares> groups{};
    /// Chooses the light of each light path; nullopt if there is one lamp only, or no indirect
    /// light was found.
    std::optional<AliasTable> starts{};
    /// Where light of the environment enters the scene; nullopt without `visibility`.
    std::optional<EnvironmentEntries> entries{};
    /// Of directional lights, of which some light was found.
    std::vector<SunEntries> suns{};
};

}  // namespace bdpt
