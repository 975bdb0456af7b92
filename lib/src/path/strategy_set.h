#pragma once

#include "light/light_samples.h"

#include <bdpt/render_options.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

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
    /// Number of parts of the set, a power of two: each is traced and used by its pixels before the
    /// next one, so that only one is in memory. A merged set is kept whole.
    std::int64_t batches = 1;
};

/// The strategies (s, t) that a render uses, and the number of samples that each takes per camera
/// path.
class StrategySet {
public:
    /// `options` have been checked. The integrator is bdpt, lt or vcm.
    explicit StrategySet(const RenderOptions& options, const LearnedLight* learned = nullptr);

    /// Returns N_s of the strategy; 0 if it is not used.
    [[nodiscard]] float count(int s, int t) const
    {
        const bool used = allows(s + t - 1, s, t) &&
                          (disabled_.empty() || std::find(disabled_.begin(), disabled_.end(),
                                                          Strategy{s, t}) == disabled_.end());
        return used ? count_of_kind(s, t) : 0.0f;
    }
    [[nodiscard]] bool uses(int s, int t) const { return count(s, t) > 0.0f; }
    /// Tests whether the last of s light vertices is merged with the last of t camera vertices.
    [[nodiscard]] bool merges(int s, int t) const
    {
        return merges_ && s >= 2 && t >= 2 && allows(s + t - 2, s, t);
    }

    /// Tests whether every strategy that can sample a path of two edges or more is used. For each
    /// camera path those with s = 0 take one sample, s = 1 `light_samples` at each vertex and
    /// `visible_light_samples` at the lens, the others `light_paths` where t <= 1 and `connections`
    /// where t >= 2.
    [[nodiscard]] bool is_complete() const { return complete_; }
    [[nodiscard]] double light_paths() const { return light_paths_.per_camera_path; }
    [[nodiscard]] double light_samples() const { return next_event_sampling_.samples; }
    [[nodiscard]] double connections() const { return light_paths_.connections; }

    /// Returns the light sampling of s = 1: environments as requested if s = 0 can sample every
    /// path that it can.
    [[nodiscard]] NextEventSampling next_event_sampling() const { return next_event_sampling_; }

    /// Returns the number of vertices of the longest subpaths that any strategy needs, including
    /// the lens or the light.
    [[nodiscard]] int camera_vertices() const { return camera_vertices_; }
    [[nodiscard]] int light_vertices() const { return light_vertices_; }

private:
    /// Tests the lengths of the path and of its two subpaths.
    [[nodiscard]] bool allows(int edges, int s, int t) const
    {
        return edges >= min_depth_ && edges <= max_depth_ && t - 1 <= max_camera_depth_ &&
               s - 1 <= max_light_depth_;
    }

    /// Returns N_s of the strategy if nothing forbids it.
    [[nodiscard]] float count_of_kind(int s, int t) const
    {
        return counts_[static_cast<std::size_t>(std::min(s, 2))]
                      [static_cast<std::size_t>(std::min(t, 2))];
    }
    /// Returns the largest t of the strategies used.
    [[nodiscard]] int find_camera_vertices() const;
    [[nodiscard]] int find_light_vertices() const;

    int min_depth_;
    int max_depth_;
    int max_camera_depth_;
    int max_light_depth_;
    std::vector<Strategy> disabled_;
    LightPathCounts light_paths_;
    bool complete_;
    bool merges_;
    double visible_light_samples_;
    int camera_vertices_ = 1;
    int light_vertices_ = 0;
    NextEventSampling next_event_sampling_;
    std::array<std::array<float, 3>, 3> counts_{};  // by s and t; 2 stands for all from 2
};

}  // namespace bdpt
