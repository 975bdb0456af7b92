#pragma once

#include <bdpt/render_stats.h>

#include <array>

namespace bdpt {

/// Candidate numbers of light paths, connections, and connection rays per camera path, see
/// `BidirectionalOptions`; and the factor of `SamplingOptions::light_samples`.
/// The first is next-event estimation without light paths.
struct Candidate {
    double light_paths = 0.0;
    double connections = 0.0;
    double connection_rays = 0.0;
    double light_samples = 1.0;  ///< a whole number

    [[nodiscard]] bool operator==(const Candidate&) const = default;
};

/// All candidates. With fewer than 1/16 light paths, sharing them would show in correlated errors
/// of neighbouring pixels. Without connections, light paths only splat, and are cheap, as none is
/// stored. More than one is worth its time only without connections, where light comes out of wax.
/// Caustics would be smoother, too, but light paths take time from camera paths, whose brightest
/// contributions, such as caustics seen in mirrors, are too rare for a pilot to notice. Two light
/// samples are worth it beside chosen connections, whose rays leave direct light the noisiest.
inline constexpr std::array candidates{
    Candidate{0.0, 0.0},           Candidate{0.0625, 0.0},        Candidate{0.0625, 1.0},
    Candidate{0.0625, 2.0},        Candidate{0.0625, 8.0, 4.0},   Candidate{0.0625, 8.0, 8.0},
    Candidate{0.0625, 8.0, 12.0},  Candidate{0.0625, 16.0, 12.0}, Candidate{0.25, 0.25},
    Candidate{0.25, 2.0},          Candidate{0.25, 8.0, 4.0},     Candidate{0.5, 0.0},
    Candidate{0.5, 0.25},          Candidate{0.5, 8.0, 8.0},      Candidate{1.0, 1.0},
    Candidate{2.0, 0.0},           Candidate{4.0, 0.0},           Candidate{0.0625, 8.0, 4.0, 2.0},
    Candidate{0.25, 8.0, 4.0, 2.0}};

template <typename T>
using PerCandidate = std::array<T, candidates.size()>;

/// Returns the number of connections that cast a shadow ray, for each camera path of the candidate.
/// `pilot` are the counts of a pilot, in a part of the image where camera paths are alike; it
/// connected each of them to `PathShares::pilot_connections` light paths.
[[nodiscard]] double connection_rays(const Candidate& candidate, const RenderStats& pilot);

/// Returns the cost of a sample of the candidate [ns], from the counts of a pilot, a number of
/// connections, and fixed cost factors, so that every machine makes the same choice. `background`
/// is the fraction of the pilot's camera paths that leave the scene at once.
[[nodiscard]] double sample_cost(const Candidate& candidate, const RenderStats& pilot,
                                 double connection_rays, double background);

}  // namespace bdpt
