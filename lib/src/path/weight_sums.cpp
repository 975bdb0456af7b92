#include "path/weight_sums.h"

#include "camera/camera.h"

#include <cmath>

namespace bdpt {
namespace {

/// In double, for the products over a long path leave the range of float.
double quotient(AreaPdf a, AreaPdf b)
{
    return static_cast<double>(a.value) / static_cast<double>(b.value);
}

double if_joined(bool joins, double sum)
{
    return joins ? sum : 0.0;
}

}  // namespace

bool WeightSums::applies(const StrategySet& strategies, Heuristic heuristic)
{
    return strategies.is_complete() &&
           (heuristic == Heuristic::balance || heuristic == Heuristic::power);
}

WeightSums::WeightSums(const World& world, const Camera& camera, const StrategySet& strategies,
                       Heuristic heuristic)
    : world_(world),
      squares_(heuristic == Heuristic::power),
      finite_lens_(camera.has_finite_lens()),
      light_paths_(static_cast<double>(strategies.light_paths())),
      camera_sums_(static_cast<std::size_t>(strategies.camera_vertices())),
      light_sums_(static_cast<std::size_t>(strategies.light_vertices()))
{}

/// The heuristic's measure of one strategy against another.
double WeightSums::raise(double ratio) const
{
    return squares_ ? ratio * ratio : ratio;
}

// Below, every divisor is a density that a walk really sampled, so it is never zero.

/// t = 0
double WeightSums::lens_term(AreaPdf from_light, const PathVertex& lens) const
{
    return finite_lens_ ? raise(quotient(from_light, lens.pdf_fwd)) : 0.0;
}

/// s = 0 against s >= 2.
double WeightSums::hit_term(AreaPdf from_camera, const PathVertex& x0) const
{
    return world_.lights()[*x0.light].is_delta()
               ? 0.0
               : raise(quotient(from_camera, x0.pdf_fwd) / light_paths_);
}

void WeightSums::begin_camera_path(std::span<const PathVertex> path)
{
    // The last two vertices get their densities from the joins.
    for (std::size_t k = 0; k + 2 < path.size(); ++k) {
        camera_sums_[k] = k == 0 ? lens_term(path[0].pdf_rev, path[0])
                                 : raise(quotient(path[k].pdf_rev, path[k].pdf_fwd)) *
                                       (if_joined(joinable(path[k]) && joinable(path[k - 1]), 1.0) +
                                        camera_sums_[k - 1]);
    }
}

void WeightSums::begin_light_path(std::span<const PathVertex> path)
{
    if (path.size() < 2) {
        return;
    }
    next_event_term_ = raise(quotient(path[0].pdf_next_event, path[0].pdf_fwd) / light_paths_);
    for (std::size_t k = 0; k + 2 < path.size(); ++k) {
        light_sums_[k] = k == 0 ? hit_term(path[0].pdf_rev, path[0])
                                : raise(quotient(path[k].pdf_rev, path[k].pdf_fwd)) *
                                      (if_joined(joinable(path[k]) && joinable(path[k - 1]),
                                                 k == 1 ? next_event_term_ : 1.0) +
                                       light_sums_[k - 1]);
    }
}

double WeightSums::beyond_camera_end(std::span<const PathVertex> camera, AreaPdf neighbor) const
{
    const std::size_t t = camera.size();
    if (t == 1) {
        return 0.0;
    }
    if (t == 2) {
        return lens_term(neighbor, camera[0]);
    }
    return raise(quotient(neighbor, camera[t - 2].pdf_fwd)) *
           (if_joined(joinable(camera[t - 2]) && joinable(camera[t - 3]), 1.0) +
            camera_sums_[t - 3]);
}

/// s >= 2
double WeightSums::light_side(std::span<const PathVertex> light, const JoinDensities& join) const
{
    const std::size_t s = light.size();
    const double beyond =
        s == 2 ? hit_term(join.camera_at_light_neighbor, light[0])
               : raise(quotient(join.camera_at_light_neighbor, light[s - 2].pdf_fwd)) *
                     (if_joined(joinable(light[s - 2]) && joinable(light[s - 3]),
                                s == 3 ? next_event_term_ : 1.0) +
                      light_sums_[s - 3]);
    return raise(quotient(join.camera_at_light_end, light[s - 1].pdf_fwd)) *
           (if_joined(joinable(light[s - 2]), s == 2 ? next_event_term_ : 1.0) + beyond);
}

float WeightSums::weight(std::span<const PathVertex> light, std::span<const PathVertex> camera,
                         const JoinDensities& join) const
{
    const std::size_t s = light.size();
    const std::size_t t = camera.size();
    const PathVertex& end = camera.back();
    const double beyond = beyond_camera_end(camera, join.light_at_camera_neighbor);
    if (s == 0) {
        const double others =
            if_joined(joinable(camera[t - 2]), raise(quotient(join.next_event, end.pdf_fwd))) +
            raise(quotient(join.light_at_camera_end, end.pdf_fwd) * light_paths_) * beyond;
        return static_cast<float>(1.0 / (1.0 + others));
    }
    const double camera_side = t == 1 ? lens_term(join.light_at_camera_end, end)
                                      : raise(quotient(join.light_at_camera_end, end.pdf_fwd)) *
                                            (if_joined(joinable(camera[t - 2]), 1.0) + beyond);
    if (s >= 2) {
        return static_cast<float>(1.0 / (1.0 + camera_side + light_side(light, join)));
    }
    const bool delta = world_.lights()[*light[0].light].is_delta();
    const double hit = delta ? 0.0 : raise(quotient(join.camera_at_light_end, join.next_event));
    const double walks = raise(quotient(light[0].pdf_fwd, join.next_event) * light_paths_);
    return static_cast<float>(1.0 / (1.0 + walks * camera_side + hit));
}

}  // namespace bdpt
