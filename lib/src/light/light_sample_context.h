#pragma once

#include <bdpt/types.h>

#include <optional>

namespace bdpt {

/// A point that next-event estimation chooses a light for. Whoever evaluates the choice for a
/// certain light has to state the same receiver as whoever makes it.
struct LightSampleContext {
    Vec3 p{0.0f};
    /// Unit; light from below it brings nothing. None: light from all around does.
    std::optional<Vec3> normal{};
};

}  // namespace bdpt
