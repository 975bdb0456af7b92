#pragma once

#include "path/join_densities.h"
#include "path/mis.h"
#include "path/strategy_set.h"
#include "path/weight_sums.h"

#include <optional>
#include <span>
#include <vector>

namespace bdpt {

class Camera;

/// The densities at a light vertex x_0 as seen from its neighbour x_1, whichever strategy made
/// them.
struct LightDensities {
    AreaPdf emit;     ///< x_0 as the start of a light path (s >= 2)
    AreaPdf to_next;  ///< x_1 sampled from x_0 by a light path
};

/// x_1 as next-event estimation chooses a light for it. The same whichever walk made the vertex:
/// where light cannot pass, both sides of the path that join there are on one side.
[[nodiscard]] LightReceiver light_receiver(const PathVertex& x1);

/// x_0 on light `x0.light`, sampled from x_1 by next-event estimation, at a time of the shutter.
[[nodiscard]] AreaPdf next_event_density(const World& world, const PathVertex& x0,
                                         const PathVertex& x1, NextEventSampling sampling,
                                         float time);

/// `x0` is a vertex on light `x0.light`.
[[nodiscard]] LightDensities light_densities(const World& world, const PathVertex& x0,
                                             const SegmentEnd& x1, float time);

/// Can the strategy s = t = 1, which joins a light point to a lens point, see this light?
[[nodiscard]] bool can_be_seen_directly(const Light& light, const Camera& camera);

/// Gathers the densities of joined paths and weighs their strategies. Holds the arrays, so that a
/// thread allocates them once.
class PathWeigher {
public:
    /// `strategies` and `camera` must outlive this object.
    PathWeigher(const World& world, const Camera& camera, const StrategySet& strategies,
                Heuristic heuristic, int max_vertices);

    /// The time of the paths to come; 0 until it is set.
    void set_time(float time) { time_ = time; }
    [[nodiscard]] float time() const { return time_; }

    /// Sums up once what the weights of all prefixes of a subpath share, where that is possible.
    /// From then on every call of `weight` must be for such prefixes; without, each call gathers
    /// all densities.
    void begin_camera_path(std::span<const PathVertex> path);
    void begin_light_path(std::span<const PathVertex> path);

    /// From now on `shares()` may be called.
    void keep_paths() { keeps_paths_ = true; }

    /// Weight of having joined the first s light vertices to the first t camera vertices. For s = 0
    /// the last camera vertex is x_0.
    [[nodiscard]] float weight(std::span<const PathVertex> light,
                               std::span<const PathVertex> camera, const JoinDensities& join);
    /// Weight of a light walk of n - 1 vertices having hit the lens by chance (t = 0).
    [[nodiscard]] float weight_of_hit(std::span<const PathVertex> light, const PathVertex& lens,
                                      const JoinDensities& join);

    /// The densities behind the last weight(), if no subpath was begun or paths are kept.
    [[nodiscard]] PathDensities last_path() const;
    /// Balance heuristic of all strategies of the last path, by their number of light vertices,
    /// straight from the definition [Veach 1997, eq. 9.8]. Valid until the next path.
    [[nodiscard]] std::span<const float> shares();

    [[nodiscard]] NextEventSampling next_event_sampling() const
    {
        return strategies_.next_event_sampling();
    }

private:
    enum class Joined { yes, no };

    void gather_densities(std::span<const PathVertex> light, std::span<const PathVertex> camera,
                          const JoinDensities& join);
    /// `joined`: the path was made by a join between the two subpaths.
    void gather_sample_counts(std::span<const PathVertex> light, std::span<const PathVertex> camera,
                              Joined joined);

    const World& world_;
    const Camera& camera_;
    const StrategySet& strategies_;
    Heuristic heuristic_;
    std::vector<AreaPdf> from_light_;
    std::vector<AreaPdf> from_camera_;
    std::vector<float> sample_counts_;
    AreaPdf next_event_;
    std::size_t size_ = 0;
    std::optional<WeightSums> sums_;
    bool uses_sums_ = false;
    bool keeps_paths_ = false;
    float time_ = 0.0f;
    std::vector<float> shares_;
};

}  // namespace bdpt
