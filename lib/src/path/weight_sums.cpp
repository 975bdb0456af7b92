#include "path/weight_sums.h"

#include "camera/camera.h"

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

/// Applies the heuristic's function to a density, to a ratio of densities, or to a count.
double WeightSums::raise(double value) const
{
    return squares_ ? value * value : value;
}

double WeightSums::raise(AreaPdf pdf) const
{
    return raise(static_cast<double>(pdf.value));
}

// Every divisor below is a density with which a walk sampled, so it is never zero.

/// Returns the term of the strategies that connect light paths (s >= 2), which end at `next`, to
/// the camera path.
double WeightSums::camera_term(std::span<const PathVertex> camera, const PathVertex& next) const
{
    return !joinable(camera.back()) ? 0.0
           : camera.size() == 1     ? splats_
                                    : connection_term(camera.back(), next);
}

/// Returns the term of the strategies that connect camera paths (t >= 2), which end at `next`, to
/// the light path.
double WeightSums::light_term(std::span<const PathVertex> light, const PathVertex& next) const
{
    return !joinable(light.back()) ? 0.0
           : light.size() == 1
               ? light_samples_ * raise(quotient(light[0].pdf_next_event, light[0].pdf_fwd))
               : connection_term(light.back(), next);
}

/// Returns the term of merging at `vertex`, relative to sampling it once with the density `pdf`.
double WeightSums::merge_term(const PathVertex& vertex, AreaPdf pdf) const
{
    return vertex.kind == VertexKind::surface
               ? raise(merge_weight_ * static_cast<double>(vertex.opacity * pdf.value))
               : 0.0;
}

/// Returns the sum of a lens vertex (t = 0), sampled from the other side with density `pdf_rev`.
double WeightSums::lens_sum(const PathVertex& lens, AreaPdf pdf_rev) const
{
    return finite_lens_ ? splats_ * raise(quotient(pdf_rev, lens.pdf_fwd)) : 0.0;
}

void WeightSums::store_sums(std::span<PathVertex> path, std::size_t k, double term) const
{
    PathVertex& vertex = path[k];
    const double scale = raise(1.0 / static_cast<double>(vertex.pdf_fwd.value));
    vertex.sum_of_one = scale * term;
    vertex.sum_of_more = 0.0;
    if (k > 0) {
        const PathVertex& before = path[k - 1];
        double sum = joinable(before) ? before.sum_of_one : 0.0;
        if (k > 1) {
            sum += raise(path[k - 2].pdf_rev) * before.sum_of_more;
        }
        vertex.sum_of_more = scale * sum;
    }
}

void WeightSums::sum_camera_path(std::span<PathVertex> path) const
{
    store_sums(path, 0, finite_lens_ ? splats_ : 0.0);
    for (std::size_t k = 1; k < path.size(); ++k) {
        store_sums(path, k,
                   camera_term(path.first(k), path[k]) + merge_term(path[k], path[k].pdf_fwd));
    }
}

void WeightSums::sum_light_path(std::span<PathVertex> path) const
{
    if (path.empty()) {
        return;
    }
    // Walks do not hit a delta light (s = 0).
    store_sums(path, 0, world_.lights()[*path[0].light].is_delta() ? 0.0 : 1.0);
    for (std::size_t k = 1; k < path.size(); ++k) {
        store_sums(path, k,
                   light_term(path.first(k), path[k]) + merge_term(path[k], path[k].pdf_fwd));
    }
}

float WeightSums::weight(std::span<const PathVertex> light, std::span<const PathVertex> camera,
                         const JoinDensities& join) const
{
    const std::size_t s = light.size();
    const std::size_t t = camera.size();
    const PathVertex& z = camera.back();
    const double more = raise(join.light_at_camera_neighbor) * z.sum_of_more;
    if (s == 0) {
        const double next_event = joinable(camera[t - 2])
                                      ? light_samples_ * raise(quotient(join.next_event, z.pdf_fwd))
                                      : 0.0;
        const double others = next_event + raise(join.light_at_camera_end) * more;
        return static_cast<float>(1.0 / (1.0 + others));
    }
    const double camera_side = t == 1 ? lens_sum(z, join.light_at_camera_end)
                                      : raise(join.light_at_camera_end) * (z.sum_of_one + more);
    const PathVertex& y = light.back();
    if (s >= 2) {
        const double own = t == 1 ? splats_ : connection_term(y, z);
        const double light_side =
            raise(join.camera_at_light_end) *
            (y.sum_of_one + raise(join.camera_at_light_neighbor) * y.sum_of_more);
        return static_cast<float>(own / (own + camera_side + light_side));
    }
    const bool delta = world_.lights()[*y.light].is_delta();
    const double hit = delta ? 0.0 : raise(quotient(join.camera_at_light_end, join.next_event));
    const double walks = raise(quotient(y.pdf_fwd, join.next_event));
    return static_cast<float>(light_samples_ / (light_samples_ + walks * camera_side + hit));
}

float WeightSums::weight_of_merge(std::span<const PathVertex> light,
                                  std::span<const PathVertex> camera,
                                  const JoinDensities& join) const
{
    // Each side is relative to sampling the merged vertex from that side alone.
    const PathVertex& y = light.back();
    const PathVertex& z = camera.back();
    const double camera_side =
        camera_term(camera.first(camera.size() - 1), z) +
        raise(z.pdf_fwd) * raise(join.light_at_camera_neighbor) * z.sum_of_more;
    const double light_side = light_term(light.first(light.size() - 1), y) +
                              raise(y.pdf_fwd) * raise(join.camera_at_light_end) * y.sum_of_more;
    return static_cast<float>(1.0 / (1.0 + camera_side / merge_term(z, z.pdf_fwd) +
                                     light_side / merge_term(z, y.pdf_fwd)));
}

}  // namespace bdpt
