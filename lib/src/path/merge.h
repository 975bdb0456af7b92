#pragma once

#include "path/connect.h"
#include "path/merging.h"

namespace bdpt {

/// Completes a path by merging: the last of at least two light vertices is identified with the last
/// of at least two camera vertices, at most `merging.radius` away. Takes `merging.light_paths`
/// samples per camera path.
[[nodiscard]] std::optional<Contribution> merge(std::span<const PathVertex> light,
                                                std::span<const PathVertex> camera,
                                                const Merging& merging, PathWeigher& weigher);

/// Tests whether camera vertex `z` can merge with light vertices.
[[nodiscard]] inline bool can_merge(const PathVertex& z)
{
    return z.kind == VertexKind::surface && z.connectible;
}

}  // namespace bdpt
