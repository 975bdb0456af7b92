#pragma once

#include <bdpt/render_options.h>

#include <cstdint>

namespace bdpt {

/// How many light paths a render traces, and how many of them each camera path is joined to.
struct LightPathCounts {
    /// `options` have been checked.
    explicit LightPathCounts(const RenderOptions& options);

    double per_camera_path;  ///< light paths; a whole number of them for the whole image
    double connections;      ///< mean number of light paths that a camera path is joined to
    bool merged;             ///< each camera path merges with all of the set (vcm)
    /// All camera paths of a sample index take their light paths from one set; else each has its
    /// own, which are as many as `connections`.
    bool shared;
    /// Vertices of the set are wanted after their splats.
    [[nodiscard]] bool kept() const { return shared && (merged || connections > 0.0); }
    /// Size of a bundle of the set: neighbouring light paths with one time and one wavelength, so
    /// that a camera path can be joined to all of them.
    int bundle = 1;
    std::int64_t bundles = 0;  ///< in the set
};

}  // namespace bdpt
