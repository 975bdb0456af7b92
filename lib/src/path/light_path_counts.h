#pragma once

#include <bdpt/render_options.h>

#include <cstdint>

namespace bdpt {

/// Number of light paths that a render traces, and of those that each camera path is connected to.
struct LightPathCounts {
    /// Computes the counts from valid `options`.
    explicit LightPathCounts(const RenderOptions& options);

    /// Light paths per camera path; a whole number of them for the whole image.
    double per_camera_path;
    double connections;  ///< mean number of light paths that a camera path is connected to
    double rays;         ///< mean number of chosen connections per camera path; 0: all are made
    bool merged;         ///< each camera path merges with the whole set (vcm)
    /// True if all camera paths of a sample index share one set of light paths; otherwise each has
    /// its own, `connections` in number.
    bool shared;
    /// Tests whether vertices of the set are needed after their splats.
    [[nodiscard]] bool kept() const { return shared && (merged || connections > 0.0); }
    /// Size of a bundle of the set: adjacent light paths with one time and one wavelength, so that
    /// a camera path can be connected to all of them.
    int bundle = 1;
    std::int64_t bundles = 0;  ///< number of bundles in the set
};

}  // namespace bdpt
