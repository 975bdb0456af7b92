#pragma once

#include "path/connect.h"
#include "path/merging.h"

namespace bdpt {

/// One more way to complete a path than those of connect.h: the last of at least two light
/// vertices counts as the last of at least two camera vertices, which is not farther away than
/// `merging.radius`. For each camera path `merging.light_paths` samples are taken. Begins in
/// Phase::connect and ends in Phase::weigh if it finds something.
[[nodiscard]] std::optional<Contribution> merge(const SampleContext& sample,
                                                std::span<const PathVertex> light,
                                                std::span<const PathVertex> camera,
                                                const Merging& merging, PathWeigher& weigher);

/// Can camera vertex `z` merge with light vertices?
[[nodiscard]] inline bool can_merge(const PathVertex& z)
{
    return z.kind == VertexKind::surface && z.connectible;
}

}  // namespace bdpt
