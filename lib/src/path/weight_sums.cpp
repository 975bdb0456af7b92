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

}  // namespace

bool WeightSums::applies(const StrategySet& strategies, Heuristic heuristic)
{
    return strategies.is_complete() &&
           (heuristic == Heuristic::balance || heuristic == Heuristic::power);
}

WeightSums::WeightSums(const World& world, const Camera& camera, const StrategySet& strategies,
                       Heuristic heuristic, double merge_weight)
    : world_(world),
      squares_(heuristic == Heuristic::power),
      finite_lens_(camera.has_finite_lens()),
      merge_weight_(merge_weight),
      splats_(raise(strategies.light_paths())),
      joins_(raise(strategies.connections())),
      light_samples_(raise(strategies.light_samples()))
{}

/// What the heuristic makes of a quotient of densities, or of counts.
double WeightSums::raise(double ratio) const
{
    return squares_ ? ratio * ratio : ratio;
}

// Below, every divisor is a density that a walk really sampled, so it is never zero.

/// s >= 2
double WeightSums::camera_term(bool joins, std::size_t t) const
{
    return !joins ? 0.0 : t == 1 ? splats_ : joins_;
}

double WeightSums::merge_term(const PathVertex& vertex, AreaPdf pdf, bool joins) const
{
    return joins && vertex.kind == VertexKind::surface
               ? raise(merge_weight_ * static_cast<double>(vertex.opacity * pdf.value))
               : 0.0;
}

/// t = 0
double WeightSums::lens_term(AreaPdf from_light, const PathVertex& lens) const
{
    return finite_lens_ ? raise(quotient(from_light, lens.pdf_fwd)) * splats_ : 0.0;
}

/// s = 0
double WeightSums::hit_term(AreaPdf from_camera, const PathVertex& x0) const
{
    return world_.lights()[*x0.light].is_delta() ? 0.0 : raise(quotient(from_camera, x0.pdf_fwd));
}

/// t >= 2
double WeightSums::light_term(const PathVertex& x0, bool joins, std::size_t s) const
{
    return !joins   ? 0.0
           : s == 1 ? light_samples_ * raise(quotient(x0.pdf_next_event, x0.pdf_fwd))
                    : joins_;
}

void WeightSums::sum_camera_path(std::span<PathVertex> path) const
{
    // The last two vertices get their densities from the joins.
    for (std::size_t k = 0; k + 2 < path.size(); ++k) {
        PathVertex& z = path[k];
        z.sum = k == 0 ? lens_term(z.pdf_rev, z)
                       : raise(quotient(z.pdf_rev, z.pdf_fwd)) *
                             (camera_term(joinable(z) && joinable(path[k - 1]), k) +
                              merge_term(z, z.pdf_fwd, joinable(z)) + path[k - 1].sum);
    }
}

void WeightSums::sum_light_path(std::span<PathVertex> path) const
{
    for (std::size_t k = 0; k + 2 < path.size(); ++k) {
        PathVertex& y = path[k];
        if (k == 0) {
            y.sum = hit_term(y.pdf_rev, y);
            continue;
        }
        y.sum = raise(quotient(y.pdf_rev, y.pdf_fwd)) *
                (light_term(path[0], joinable(y) && joinable(path[k - 1]), k) +
                 merge_term(y, y.pdf_fwd, joinable(y)) + path[k - 1].sum);
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
    const PathVertex& z = camera[t - 2];
    return raise(quotient(neighbor, z.pdf_fwd)) *
           (camera_term(joinable(z) && joinable(camera[t - 3]), t - 2) +
            merge_term(z, z.pdf_fwd, joinable(z)) + camera[t - 3].sum);
}

double WeightSums::beyond_light_end(std::span<const PathVertex> light, AreaPdf neighbor) const
{
    const std::size_t s = light.size();
    if (s == 2) {
        return hit_term(neighbor, light[0]);
    }
    const PathVertex& y = light[s - 2];
    return raise(quotient(neighbor, y.pdf_fwd)) *
           (light_term(light[0], joinable(y) && joinable(light[s - 3]), s - 2) +
            merge_term(y, y.pdf_fwd, joinable(y)) + light[s - 3].sum);
}

float WeightSums::weight(std::span<const PathVertex> light, std::span<const PathVertex> camera,
                         const JoinDensities& join) const
{
    const std::size_t s = light.size();
    const std::size_t t = camera.size();
    const PathVertex& end = camera.back();
    const double beyond = beyond_camera_end(camera, join.light_at_camera_neighbor);
    if (s == 0) {
        const double next_event =
            joinable(camera[t - 2]) ? light_samples_ * raise(quotient(join.next_event, end.pdf_fwd))
                                    : 0.0;
        const double others =
            next_event + raise(quotient(join.light_at_camera_end, end.pdf_fwd)) * beyond;
        return static_cast<float>(1.0 / (1.0 + others));
    }
    const double camera_side = t == 1 ? lens_term(join.light_at_camera_end, end)
                                      : raise(quotient(join.light_at_camera_end, end.pdf_fwd)) *
                                            (camera_term(joinable(camera[t - 2]), t - 1) +
                                             merge_term(end, end.pdf_fwd, true) + beyond);
    if (s >= 2) {
        const double own = t == 1 ? splats_ : joins_;
        const PathVertex& y = light[s - 1];
        const double light_side =
            raise(quotient(join.camera_at_light_end, y.pdf_fwd)) *
            (light_term(light[0], joinable(light[s - 2]), s - 1) + merge_term(y, y.pdf_fwd, true) +
             beyond_light_end(light, join.camera_at_light_neighbor));
        return static_cast<float>(own / (own + camera_side + light_side));
    }
    const bool delta = world_.lights()[*light[0].light].is_delta();
    const double hit = delta ? 0.0 : raise(quotient(join.camera_at_light_end, join.next_event));
    const double walks = raise(quotient(light[0].pdf_fwd, join.next_event));
    return static_cast<float>(light_samples_ / (light_samples_ + walks * camera_side + hit));
}

float WeightSums::weight_of_merge(std::span<const PathVertex> light,
                                  std::span<const PathVertex> camera,
                                  const JoinDensities& join) const
{
    // Each side is relative to sampling the merged vertex from there alone.
    const std::size_t s = light.size();
    const std::size_t t = camera.size();
    const PathVertex& y = light[s - 1];
    const PathVertex& z = camera[t - 1];
    const double camera_side = camera_term(joinable(camera[t - 2]), t - 1) +
                               beyond_camera_end(camera, join.light_at_camera_neighbor);
    const double light_side = light_term(light[0], joinable(light[s - 2]), s - 1) +
                              beyond_light_end(light, join.camera_at_light_end);
    return static_cast<float>(1.0 / (1.0 + camera_side / merge_term(z, z.pdf_fwd, true) +
                                     light_side / merge_term(z, y.pdf_fwd, true)));
}

}  // namespace bdpt
