#include "path/weight_sums.h"

#include "camera/camera.h"

#include <cmath>

namespace bdpt {
namespace {

/// Divides in double, because the products over a long path exceed the range of float.
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

/// Applies the heuristic's function to a ratio of densities, or to a count.
double WeightSums::raise(double ratio) const
{
    return squares_ ? ratio * ratio : ratio;
}

// Every divisor below is a density with which a walk sampled, so it is never zero.

/// Returns the term of the strategies that connect light paths (s >= 2), which end at `next`, to
/// the camera path.
double WeightSums::camera_term(std::span<const PathVertex> camera, const PathVertex& next,
                               bool joins) const
{
    return !joins ? 0.0 : camera.size() == 1 ? splats_ : connection_term(camera.back(), next);
}

/// Returns the term of the strategies that connect camera paths (t >= 2), which end at `next`, to
/// the light path.
double WeightSums::light_term(std::span<const PathVertex> light, const PathVertex& next,
                              bool joins) const
{
    return !joins ? 0.0
           : light.size() == 1
               ? light_samples_ * raise(quotient(light[0].pdf_next_event, light[0].pdf_fwd))
               : connection_term(light.back(), next);
}

/// Returns the term of merging at `vertex`, relative to sampling it once with the density `pdf`.
double WeightSums::merge_term(const PathVertex& vertex, AreaPdf pdf, bool joins) const
{
    return joins && vertex.kind == VertexKind::surface
               ? raise(merge_weight_ * static_cast<double>(vertex.opacity * pdf.value))
               : 0.0;
}

double WeightSums::camera_sum(std::span<const PathVertex> camera, std::size_t k, AreaPdf pdf_rev,
                              bool joins, double before) const
{
    const PathVertex& z = camera[k];
    const double ratio = raise(quotient(pdf_rev, z.pdf_fwd));
    if (k == 0) {  // t = 0
        return finite_lens_ ? ratio * splats_ : 0.0;
    }
    return ratio * (camera_term(camera.first(k), z, joins && joinable(camera[k - 1])) +
                    merge_term(z, z.pdf_fwd, joins) + before);
}

double WeightSums::light_sum(std::span<const PathVertex> light, std::size_t k, AreaPdf pdf_rev,
                             bool joins, double before) const
{
    const PathVertex& y = light[k];
    const double ratio = raise(quotient(pdf_rev, y.pdf_fwd));
    if (k == 0) {  // s = 0
        return world_.lights()[*y.light].is_delta() ? 0.0 : ratio;
    }
    return ratio * (light_term(light.first(k), y, joins && joinable(light[k - 1])) +
                    merge_term(y, y.pdf_fwd, joins) + before);
}

void WeightSums::sum_camera_path(std::span<PathVertex> path) const
{
    // The densities of the last two vertices depend on the connection.
    double before = 0.0;
    for (std::size_t k = 0; k + 2 < path.size(); ++k) {
        before = camera_sum(path, k, path[k].pdf_rev, joinable(path[k]), before);
        path[k].sum = before;
    }
}

void WeightSums::sum_light_path(std::span<PathVertex> path) const
{
    double before = 0.0;
    for (std::size_t k = 0; k + 2 < path.size(); ++k) {
        before = light_sum(path, k, path[k].pdf_rev, joinable(path[k]), before);
        path[k].sum = before;
    }
}

double WeightSums::beyond_camera_end(std::span<const PathVertex> camera, AreaPdf pdf_rev) const
{
    const std::size_t t = camera.size();
    return t < 2 ? 0.0
                 : camera_sum(camera, t - 2, pdf_rev, joinable(camera[t - 2]),
                              t > 2 ? camera[t - 3].sum : 0.0);
}

double WeightSums::beyond_light_end(std::span<const PathVertex> light, AreaPdf pdf_rev) const
{
    const std::size_t s = light.size();
    return s < 2 ? 0.0
                 : light_sum(light, s - 2, pdf_rev, joinable(light[s - 2]),
                             s > 2 ? light[s - 3].sum : 0.0);
}

float WeightSums::weight(std::span<const PathVertex> light, std::span<const PathVertex> camera,
                         const JoinDensities& join) const
{
    const std::size_t s = light.size();
    const std::size_t t = camera.size();
    const double beyond = beyond_camera_end(camera, join.light_at_camera_neighbor);
    if (s == 0) {
        const PathVertex& x0 = camera.back();
        const double next_event =
            joinable(camera[t - 2]) ? light_samples_ * raise(quotient(join.next_event, x0.pdf_fwd))
                                    : 0.0;
        const double others =
            next_event + raise(quotient(join.light_at_camera_end, x0.pdf_fwd)) * beyond;
        return static_cast<float>(1.0 / (1.0 + others));
    }
    const double camera_side = camera_sum(camera, t - 1, join.light_at_camera_end, true, beyond);
    if (s >= 2) {
        const double own = t == 1 ? splats_ : connection_term(light.back(), camera.back());
        const double light_side = light_sum(light, s - 1, join.camera_at_light_end, true,
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
    // Each side is relative to sampling the merged vertex from that side alone.
    const std::size_t s = light.size();
    const std::size_t t = camera.size();
    const PathVertex& y = light[s - 1];
    const PathVertex& z = camera[t - 1];
    const double camera_side = camera_term(camera.first(t - 1), z, joinable(camera[t - 2])) +
                               beyond_camera_end(camera, join.light_at_camera_neighbor);
    const double light_side = light_term(light.first(s - 1), y, joinable(light[s - 2])) +
                              beyond_light_end(light, join.camera_at_light_end);
    return static_cast<float>(1.0 / (1.0 + camera_side / merge_term(z, z.pdf_fwd, true) +
                                     light_side / merge_term(z, y.pdf_fwd, true)));
}

}  // namespace bdpt
