#pragma once

#include "light/light_samples.h"
#include "math/distributions.h"

#include <optional>
#include <span>

namespace bdpt {

class LightSet;

/// A contribution of one light to the image, after at least one bounce that a light path can
/// replace, as a camera path of a pilot found it.
struct IndirectLight {
    LightId light{};
    float value = 0.0f;  ///< luminance, >= 0 and finite
};

/// Returns the table that chooses the light of each light path, by what a pilot found
/// (docs/decisions/0075-learned-starts.md); nullopt if nothing was found. Each light that has power
/// keeps a part of its probability by power.
[[nodiscard]] std::optional<AliasTable> learn_starts(std::span<const IndirectLight> found,
                                                     const LightSet& lights);

}  // namespace bdpt
